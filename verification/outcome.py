"""A case run to its end and judged: whatever happens there becomes an outcome with a reason."""

import math
import time
import traceback
from dataclasses import dataclass

from geometry.blocks import GeometryError
from masonry.errors import SceneError, Stopped
from verification.case import Case, Check, Findings, RequiredFeature

IMBALANCE = 1e-10
"""Of the external work: the most that a ledger of a case may be off at any row."""
EXPECTED = (SceneError, GeometryError, Stopped, MemoryError)
"""Errors that say themselves what is wrong; of any other one the place in the code is told as well."""
Answer = tuple[Findings, str, str, float]
"""Findings, status, reason and seconds: an outcome but for its case."""


@dataclass
class CaseOutcome:
    """A case that was run: PASS, FAIL, NOT BUILT or ERROR, and why."""

    case: Case
    findings: Findings
    status: str
    reason: str = ""
    seconds: float = math.nan

    @property
    def holds(self) -> bool:
        """A case that is not built is no failure, and no proof either."""
        return self.status in ("PASS", "NOT BUILT")

    @property
    def worst(self) -> Check | None:
        """The check that is nearest to its tolerance, or furthest beyond it."""
        return max(self.findings.checks, key=lambda c: c.used, default=None)

    @property
    def proves(self) -> bool:
        return self.status == "PASS"

    @property
    def too_loose(self) -> list[Check]:
        return [check for check in self.findings.checks if check.too_loose]

    @property
    def ill_set(self) -> list[Check]:
        return [check for check in self.findings.checks if check.ill_set]

    @property
    def worse(self) -> list[Check]:
        return [check for check in self.findings.checks if check.worse]


def off(check: Check) -> str:
    """A check that does not hold, in a sentence."""
    unit = f" {check.unit}" if check.unit not in ("", "1") else ""
    tolerance = check.tolerance
    why = tolerance.reason.rstrip(".")
    if check.is_bound:
        return f"{check.quantity} is {check.value:.8g}{unit}, but may be at most {check.reference:.8g}{unit} ({why})"
    return (
        f"{check.quantity} is {check.value:.8g}{unit}, but the {tolerance.kind} gives {check.reference:.8g}{unit}: "
        f"error {check.error:+.2e}, tolerance {tolerance.limit:.0e} ({why})"
    )


def shortcomings(findings: Findings) -> list[str]:
    """The checks and ledgers that do not hold, each in a sentence."""
    sentences = [off(check) for check in findings.checks if not check.holds]
    sentences += [
        f"the energy ledger of {run} is open by {imbalance:.1e} of the external work, more than {IMBALANCE:.0e}"
        for run, imbalance in findings.imbalance.items()
        if not imbalance <= IMBALANCE
    ]
    return sentences if findings.checks else [*sentences, "no check was made"]


def judge(findings: Findings) -> tuple[str, str]:
    """PASS, or FAIL with what does not hold."""
    wrong = shortcomings(findings)
    return ("FAIL", "; ".join(wrong)) if wrong else ("PASS", "")


def run_case(case: Case) -> CaseOutcome:
    """The outcome of a case; raises nothing but KeyboardInterrupt."""
    return CaseOutcome(case, *answer(case))


def answer(case: Case) -> Answer:
    """Answer of a process that runs the case: the case itself stays where it is."""
    begun = time.perf_counter()
    findings = Findings()
    try:
        findings = case.run()
        status, reason = judge(findings)
    except RequiredFeature as lacking:
        status, reason = "NOT BUILT", f"needs {str(lacking) or 'a feature'}"
    except EXPECTED as error:
        status, reason = "ERROR", f"{type(error).__name__}: {error}"
    except Exception as error:
        last = traceback.extract_tb(error.__traceback__)[-1]
        status, reason = "ERROR", f"{type(error).__name__}: {error} ({last.filename}, line {last.lineno})"
    return findings, status, reason, time.perf_counter() - begun

"""What came of a case that was run, and how that is judged."""

import math
from dataclasses import dataclass

from verification.case import Case, Check, Findings

IMBALANCE = 1e-10
"""Of the external work: the most that a ledger of a case may be off at any row."""


@dataclass
class Outcome:
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


def judge(findings: Findings) -> tuple[str, str]:
    """PASS, or FAIL with the checks and ledgers that do not hold."""
    wrong = [_missed(c) for c in findings.checks if not c.holds]
    wrong += [
        f"energy ledger of {name}: residual {r:.2e} of the external work > {IMBALANCE:.0e}"
        for name, r in findings.imbalance.items()
        if not r <= IMBALANCE
    ]
    if not findings.checks:
        wrong.append("no check was made")
    return ("FAIL", "; ".join(wrong)) if wrong else ("PASS", "")


def _missed(check: Check) -> str:
    value = f"{check.quantity}: {check.value:.6g} {check.unit}"
    if check.is_bound:
        return f"{value}, at most {check.reference:.6g}"
    return f"{value} against {check.reference:.6g}, error {check.error:.2e} > {check.tolerance:.0e}"

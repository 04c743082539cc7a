"""What a verification case is: numbers held against references, each with a tolerance and its reason."""

import math
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from masonry.results import Result

KINDS = ("closed form", "limit analysis", "same discretisation", "refined model", "converged run", "invariance")
"""What a reference can be; an experiment is validation, not verification, and is not among them."""
ROUNDING = 1e-14
LOOSE = 100.0
"""A check that passes with this factor to spare has a tolerance that would let a mistake through."""
IMBALANCE = 1e-10
"""Of the external work: the most that a ledger of a case may be off at any row."""
MEASURES = {
    "steps": "steps",
    "kinetic_over_internal": "kinetic_over_internal_max",
    "unbalanced": "unbalanced_after_settling",
}
"""What a record keeps of a run, and its key in the summary."""


class RequiredFeature(Exception):
    """The case needs something that the solver does not have: the row says "not built"."""


@dataclass(frozen=True)
class Check:
    """One number (or the largest of many) held against its reference.

    tolerance  on |value - reference| / scale
    expected   the error that the method should have here (same scale): the order of the scheme, rounding, ...
    reason     why the tolerance is what it is, in a sentence
    scale      what errors are relative to; the reference itself where none is given
    """

    quantity: str
    unit: str
    value: float
    reference: float
    kind: str
    tolerance: float
    expected: float
    reason: str
    scale: float | None = None

    @property
    def error(self) -> float:
        """Signed, relative to the scale."""
        size = abs(self.reference if self.scale is None else self.scale)
        gap = self.value - self.reference
        return gap / size if size else (0.0 if gap == 0.0 else math.copysign(math.inf, gap))

    @property
    def holds(self) -> bool:
        return abs(self.error) <= self.tolerance  # False for NaN too

    @property
    def used(self) -> float:
        """Share of the tolerance that the error takes up; infinite for NaN."""
        if math.isnan(self.error):
            return math.inf
        return abs(self.error) / self.tolerance if self.tolerance else 0.0 if self.error == 0.0 else math.inf

    @property
    def too_loose(self) -> bool:
        """Passes by more than LOOSE times; what rounding alone decides is not asked for more."""
        return self.holds and self.tolerance > LOOSE * max(abs(self.error), ROUNDING)


@dataclass(frozen=True)
class Line:
    """A line of a plot; `style` "line", "points" or "dashed" (references are dashed)."""

    label: str
    x: np.ndarray
    y: np.ndarray
    style: str = "line"


@dataclass(frozen=True)
class Plot:
    """A picture of the case's page; axis labels carry their units."""

    title: str
    x_label: str
    y_label: str
    lines: tuple[Line, ...]
    log: bool = False


@dataclass
class Findings:
    """What a case found: checks, plots, remarks, and the ledgers of the runs it made.

    imbalance  name of a run -> largest |energy residual| over external work of all its rows
    seconds    name of a run -> seconds of stepping
    measures   name of a run -> its steps, kinetic over internal energy, and unbalanced force after settling
    """

    checks: list[Check] = field(default_factory=list)
    plots: list[Plot] = field(default_factory=list)
    remarks: list[str] = field(default_factory=list)
    imbalance: dict[str, float] = field(default_factory=dict)
    seconds: dict[str, float] = field(default_factory=dict)
    measures: dict[str, dict[str, float | None]] = field(default_factory=dict)

    def note(self, name: str, result: Result) -> Result:
        """Keep the ledger and the time of a run of the solver; every run of a case goes through here."""
        self.imbalance[name] = float(result.summary["energy_imbalance"])
        self.seconds[name] = float(result.summary["seconds_run"])
        self.measures[name] = {words: result.summary.get(key) for words, key in MEASURES.items()}
        return result


@dataclass(frozen=True)
class Case:
    """A case of the catalogue; its formula or sketch is the docstring of its module.

    name   as the command line knows it, lower case with hyphens
    row    of the catalogue: "2.1", "A6", ...
    area   of the report's first page: "Contact laws", "Elastic assemblies", "Fracture", "Friction and stability",
           "Dynamics", "Invariance", "Quasi-static loading"
    quick  whether the three-minute run has it
    scene  the scene as text (TOML) where there is one, shown on the page
    """

    name: str
    row: str
    title: str
    area: str
    run: Callable[[], Findings]
    quick: bool = False
    scene: str = ""


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
    def too_loose(self) -> list[Check]:
        return [check for check in self.findings.checks if check.too_loose]


def judge(findings: Findings) -> tuple[str, str]:
    """PASS, or FAIL with the checks and ledgers that do not hold."""
    wrong = [
        f"{c.quantity}: {c.value:.6g} {c.unit} against {c.reference:.6g}, error {c.error:.2e} > {c.tolerance:.0e}"
        for c in findings.checks
        if not c.holds
    ]
    wrong += [
        f"energy ledger of {name}: residual {r:.2e} of the external work > {IMBALANCE:.0e}"
        for name, r in findings.imbalance.items()
        if not r <= IMBALANCE
    ]
    if not findings.checks:
        wrong.append("no check was made")
    return ("FAIL", "; ".join(wrong)) if wrong else ("PASS", "")

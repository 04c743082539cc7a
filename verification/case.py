"""Verification case: numbers held against references, each with a tolerance and its reason."""

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import SupportsFloat

import numpy as np

from masonry.errors import SceneError
from masonry.laboratory.result import Result
from verification.scene_runs import SceneRun, judge

KINDS = ("closed form", "limit analysis", "same discretisation", "refined model", "converged run", "invariance")
"""What a reference can be; an experiment is validation, not verification, and is not among them."""
BOUND = "bound"
"""The kind of a check that the value is no larger than its reference: it holds or not, and is never near or loose."""
LOOSE = 100.0
"""A check that passes with this factor to spare has a tolerance that would let a mistake through."""
REST = 1e-8
"""Of what rounding, and the motion that is left at rest, decide: they differ from processor to processor, so that a
tolerance as tight as this may be passed by any factor."""
SPREAD = 10.0
"""How many times the expected error a tolerance may be; what rounding alone decides, up to ROUNDS, may be more."""
ROUNDS = 1e-11
UNEXPECTED = 3.0
"""An error that is so many times the expected one, and holds, is worse than expected."""
MEASURES = {
    "steps": "steps",
    "kinetic_over_internal": "kinetic_over_internal_max",
    "unbalanced": "unbalanced_after_settling",
}
"""What a record keeps of a run, and its key in the summary."""


class RequiredFeature(Exception):
    """The case needs something that the solver does not have: the row says "not built"."""


@dataclass(frozen=True)
class Tolerance:
    """Largest error that a check may have, and why.

    limit     on |value - reference| / scale
    expected  the error that the method should have here (same scale): the order of the scheme, rounding, ...
    reason    why the limit is what it is, in a sentence
    kind      of the reference, one of KINDS
    """

    limit: float
    expected: float
    reason: str
    kind: str = "closed form"


@dataclass(frozen=True)
class Check:
    """One number (or the largest of many) held against its reference; `Findings.at_most` makes one against a bound.

    scale  what errors are relative to; the reference itself where none is given
    """

    quantity: str
    unit: str
    value: float
    reference: float
    tolerance: Tolerance
    scale: float | None = None

    @property
    def error(self) -> float:
        """Signed, relative to the scale."""
        size = abs(self.reference if self.scale is None else self.scale)
        gap = self.value - self.reference
        return gap / size if size else (0.0 if gap == 0.0 else math.copysign(math.inf, gap))

    @property
    def is_bound(self) -> bool:
        return self.tolerance.kind == BOUND

    @property
    def holds(self) -> bool:
        """False for NaN too."""
        return self.value <= self.reference if self.is_bound else abs(self.error) <= self.tolerance.limit

    @property
    def used(self) -> float:
        """Share of the tolerance that the error takes up; infinite for NaN, and for a bound that does not hold."""
        if self.is_bound:
            return 0.0 if self.holds else math.inf
        if math.isnan(self.error):
            return math.inf
        limit = self.tolerance.limit
        return abs(self.error) / limit if limit else 0.0 if self.error == 0.0 else math.inf

    @property
    def too_loose(self) -> bool:
        """Passes by more than LOOSE times; what rounding or rest decide is not asked for more."""
        return not self.is_bound and self.holds and self.tolerance.limit > max(LOOSE * abs(self.error), REST)

    @property
    def ill_set(self) -> bool:
        """The tolerance does not follow from the expected error: below it, or more than SPREAD times as much."""
        if self.is_bound:
            return False
        limit, expected = self.tolerance.limit, self.tolerance.expected
        return limit < expected or limit > max(SPREAD * (1 + 1e-9) * expected, ROUNDS)

    @property
    def worse(self) -> bool:
        """Holds, but by an error that is more than UNEXPECTED times the expected one: the method is not what it was."""
        if self.is_bound or not self.holds:
            return False
        return abs(self.error) > UNEXPECTED * (1 + 1e-9) * max(self.tolerance.expected, ROUNDS)


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
    """Findings of a case: checks, plots, remarks, and the ledgers of the runs it made.

    imbalance  name of a run -> largest |energy residual| over external work of all its rows, added up by `balance`
    seconds    name of a run -> seconds of stepping
    measures   name of a run -> its steps, kinetic over internal energy, and unbalanced force after settling
    """

    checks: list[Check] = field(default_factory=list)
    plots: list[Plot] = field(default_factory=list)
    remarks: list[str] = field(default_factory=list)
    imbalance: dict[str, float] = field(default_factory=dict)
    seconds: dict[str, float] = field(default_factory=dict)
    measures: dict[str, dict[str, float | None]] = field(default_factory=dict)

    def note(self, name: str, run: SceneRun | Result) -> Result:
        """Keep the ledger and the time of a run of the solver; every run of a case goes through here.

        Raises SceneError for a run that was refused.
        """
        one = run if isinstance(run, SceneRun) else judge(run)
        if one.result is None:
            raise SceneError(one.reason)
        self.imbalance[name] = one.imbalance
        self.seconds[name] = one.seconds
        self.measures[name] = {words: one.summary.get(key) for words, key in MEASURES.items()}
        return one.result

    def check(
        self,
        quantity: str,
        unit: str,
        value: SupportsFloat,
        reference: SupportsFloat,
        tolerance: Tolerance,
        *,
        scale: SupportsFloat | None = None,
    ) -> None:
        """Add a `Check`."""
        relative_to = None if scale is None else float(scale)
        self.checks.append(Check(quantity, unit, float(value), float(reference), tolerance, relative_to))

    def at_most(self, quantity: str, unit: str, value: SupportsFloat, most: SupportsFloat, reason: str) -> None:
        """Add a bound, such as what a run must have done to be worth anything: "the weakest joint has cracked"."""
        self.check(quantity, unit, value, most, Tolerance(0.0, 0.0, reason, BOUND))

    def plot(self, title: str, x_label: str, y_label: str, *lines: Line, log: bool = False) -> None:
        """Add a `Plot` of some lines."""
        self.plots.append(Plot(title, x_label, y_label, lines, log))


@dataclass(frozen=True)
class Case:
    """A case of the catalogue; its formula or sketch is the docstring of its module.

    name        as the command line knows it, lower case with hyphens
    row         of the catalogue: "2.1", "A6", ...
    area        of the report's first page: "Contact laws", "Elastic assemblies", "Fracture", "Friction and stability",
                "Dynamics", "Invariance", "Quasi-static loading"
    quick       whether the three-minute run has it
    scene       name of a scene of the verification or a packaged one, shown on the page; or its text
    problems    names of the problems (`verification.problem`) whose errors against run time stand for the case
    no_problems  or why there are none: in a word, why nothing is left to choose
    """

    name: str
    row: str
    title: str
    area: str
    run: Callable[[], Findings]
    quick: bool = False
    scene: str = ""
    problems: tuple[str, ...] = ()
    no_problems: str = ""

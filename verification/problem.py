"""Convergence problems: one knob refined, from coarse to fine, to see which error a setting has and what it costs.

A module of `verification.convergence`, or the module of a case, holds PROBLEMS: tuples of `Problem`.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple

from verification.scene_runs import SceneRun
from verification.timed_run import THREADS

Refinement = dict[str, dict[str, Any]]
"""Settings of a knob: label -> the keys of the scene that it sets; the finest last."""
RATE, ACCURACY, MODEL = "constant rate", "accuracy", "model"
SHIPPED = "1 %"
"""The setting of ACCURACY that a user gets who asks for nothing."""


@dataclass(frozen=True)
class Reference:
    """A value, what kind it is, and how far it may be off (same unit)."""

    value: float
    kind: str
    uncertainty: float = 0.0

    def doubted(self, by: float) -> "Reference":
        """The same, off by at least so much."""
        return replace(self, uncertainty=max(self.uncertainty, by))


def stress_and_energy(one: SceneRun) -> dict[str, float]:
    """Quantities measured by most problems: peak stress and stress at the end (Pa), and dissipated energy (J)."""
    return {
        "peak stress": one.value("peak"),
        "end stress": one.value("final"),
        "dissipated energy": one.value("dissipated"),
    }


OVER = {"end stress": "peak stress"}
"""Quantity -> the one that its error is relative to, as it may be next to nothing; all others are relative to
themselves."""


@dataclass(frozen=True)
class Problem:
    """A scene, what is measured in it, what that should be, and the knobs that are refined.

    name       lower case with hyphens
    scene      name of a scene of the verification or of a packaged one
    knobs      knob -> its settings; one whose name starts with "model" changes what is solved, and need not go to zero
    base       keys that every run sets
    measure    what a run gives: quantity -> value
    exact      what these should be, from a run (of which only the scene is looked at); None: the finest three of
               `converged`, extrapolated
    theory     what knobs that start with "model" are held against where `exact` is None; None: as all others
    converged  the knob whose settings converge, each twice as fine as the one before
    units      quantity -> unit
    shipped    knob and setting that a user gets who asks for nothing
    dear       left out of a quick report: it takes long, or another one shows nearly the same
    """

    name: str
    title: str
    scene: str
    knobs: dict[str, Refinement]
    base: dict[str, Any] = field(default_factory=dict)
    measure: Callable[[SceneRun], dict[str, float]] = stress_and_energy
    exact: Callable[[SceneRun], dict[str, float]] | None = None
    theory: Callable[[SceneRun], dict[str, float]] | None = None
    converged: str = RATE
    units: Mapping[str, str] = field(
        default_factory=lambda: {"peak stress": "Pa", "end stress": "Pa", "dissipated energy": "J"}
    )
    shipped: tuple[str, str] = (ACCURACY, SHIPPED)
    kind: str = "closed form"
    dear: bool = False

    def of_the_loading(self) -> "Problem":
        """The same with two knobs alone: the one that converges, and the one that is shipped."""
        needed = {self.converged, self.shipped[0]}
        return replace(self, knobs={k: v for k, v in self.knobs.items() if k in needed} or self.knobs)


def changes_model(knob: str) -> bool:
    """Whether the settings of a knob are other models, not other ways to solve the same one."""
    return knob.startswith(MODEL)


def is_setting(knob: str) -> bool:
    """Whether its settings solve the same model at the same cost of machine: more threads are more machine."""
    return not changes_model(knob) and knob != THREADS


class Point(NamedTuple):
    """A setting that came through: its largest error over all quantities, and what it took."""

    knob: str
    label: str
    seconds: float
    steps: int
    error: float


def accuracies(*percents: float) -> Refinement:
    """Settings of a drive that is paced by its error."""
    return {f"{p:g} %": {"drive.accuracy": f"{p:g} %"} for p in percents or (5.0, 2.0, 1.0, 0.5, 0.2)}


def steps(*counts: int) -> Refinement:
    """Settings of a drive in a number of steps."""
    return {f"{n:,} steps": {"drive.steps": n} for n in counts}


FEW_ROWS = {"solver.rows": 100}
"""For small problems, whose thousand rows would cost more than their steps."""


def fractions(extra: dict[str, Any], *step_fractions: float) -> Refinement:
    """Settings of the time step, as fractions of the proven bound."""
    return {f"{f:g}": {"solver.step_fraction": f, **extra} for f in step_fractions or (1.0, 0.9, 0.6, 0.3)}


def dampings(extra: dict[str, Any], *damping_factors: float) -> Refinement:
    """Settings of the local damping at a constant rate; 0.8 is the default."""
    return {f"{xi:g}": {"solver.damping": xi, **extra} for xi in damping_factors or (0.8, 0.5, 0.2)}


def laws(extra: dict[str, Any], *names: str) -> Refinement:
    """Another law is another model: settings of a knob whose name starts with "model"."""
    return {name: {"law": name, **extra} for name in names or ("exponential", "linear", "brittle")}


def threads(extra: dict[str, Any], *counts: int) -> Refinement:
    """Settings of the number of threads, which must change seconds and nothing else: of few steps, for on cores that
    are busy with other things threads wait for one another at each.
    """
    return {f"{n} thread" + "s" * (n > 1): {THREADS: n, **extra} for n in counts or (1, 2)}


def pace(fine: int, count: int = 5) -> dict[str, Refinement]:
    """The knobs of the loading alone: accuracy, numbers of steps halved from `fine`, step fraction, damping."""
    counts = [max(fine >> k, 2) for k in reversed(range(count))]
    usual = {"drive.steps": counts[-2]}
    return {
        RATE: steps(*counts),
        ACCURACY: accuracies(),
        "step fraction": fractions(usual),
        "damping": dampings(usual),
    }


def richardson(values: list[float]) -> Reference:
    """The finest of at least three values (each twice as fine), with 1.25 times its extrapolated error.

    The observed order is held between 0.5 and 2, so that two values that agree by luck do not promise too much. Where
    fewer came to their end, the finest is doubted as a whole.
    """
    if len(values) < 3:
        finest = values[-1] if values else math.nan
        return Reference(finest, "converged run", abs(finest))
    coarse, middle, fine = values[-3:]
    step = abs(middle - fine)
    order = math.log2(abs(coarse - middle) / step) if step and coarse != middle else 2.0
    return Reference(fine, "converged run", 1.25 * step / (2.0 ** min(max(order, 0.5), 2.0) - 1.0))


def time_to(points: list[tuple[float, float, str]], target: float) -> tuple[float, str] | None:
    """Least seconds, and the label, of a setting that is within the target as are all finer ones: no lucky crossing."""
    good = []
    for point in reversed(points):
        if not abs(point[1]) <= target:
            break
        good.append(point)
    return min((seconds, label) for seconds, _, label in good) if good else None


def front(points: list[Point]) -> list[Point]:
    """The settings that no other one beats in both time and error, the quickest first."""
    nondominated: list[Point] = []
    for point in sorted(points, key=lambda p: (p.seconds, p.error)):
        if not nondominated or point.error < nondominated[-1].error:
            nondominated.append(point)
    return nondominated

"""Settings by which the numbers of a scene have no larger error than asked for, and which cost no more than needed."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from masonry.errors import SceneError
from masonry.scene import Scene, changed
from masonry.scene.tables.loads_and_supports import accuracy_share
from masonry.sweeps.convergence.campaign import Campaign, Refinement, merged
from masonry.sweeps.convergence.numerical_errors import NumericalError
from masonry.sweeps.convergence.resolutions import FINEST_ACCURACY
from masonry.sweeps.run_store import Row

FILE = "converged.toml"
ROUNDS = 5
"""Refinements one after the other, at most."""
SHORT = 0.5
"""Seconds of a run of which no ratio is told: it would be noise."""
COUNTS, IDLE = 0.25, 0.02
"""Fractions of the error asked for: a part above the first is made smaller, what makes a part below the second may be
coarser."""

Measured = tuple[list[NumericalError], list[tuple[Refinement, Row]]]


@dataclass(frozen=True)
class ChosenSettings:
    """Settings by dotted key.

    error    the largest relative error that the bars allow with them
    to       the one asked for
    seconds  of processor of a run with them, and of the scene as it is
    verdict  of a run with them, and its doubts
    """

    settings: dict[str, Any]
    reasons: dict[str, str]
    error: float
    to: float
    seconds: tuple[float, float]
    verdict: str

    @property
    def words(self) -> str:
        """A sentence."""
        ratio = self.seconds[0] / max(self.seconds[1], 1e-3)
        what = "The scene as it is" if not self.settings else f"{FILE}"
        took = f", for {ratio:.2g} times the time" if self.settings and min(self.seconds) > SHORT else ""
        request = f"{100 * self.to:g} % were asked for"
        if self.error > self.to:
            request += ", and not reached: what is left is scatter, or converges too slowly"
        judged = f"; its run is {self.verdict}" if self.verdict else ""
        return f"{what} has its numbers within {100 * self.error:.2g} % ({request}){took}{judged}."

    def as_toml(self, scene: str) -> str:
        """A scene file that stands beside that of the scene as it is."""
        lines = [f"# {self.words}", f'base = "{scene}"']
        tables: dict[str, list[str]] = {}
        for key, value in self.settings.items():
            table, _, name = key.rpartition(".")
            tables.setdefault(table, []).append(f"{name} = {_toml(value)}  # {self.reasons[key]}")
        for table, entries in tables.items():
            lines += ["", f"[{table}]", *entries]
        return "\n".join(lines) + "\n"


def _toml(value: Any) -> str:
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key} = {part}" for key, part in value.items()) + "}"
    return f'"{value}"' if isinstance(value, str) else repr(value)


def fraction(text: Any) -> float:
    """An error as a person gives it, "1 %" or 0.01. Raises SceneError."""
    try:
        return float(accuracy_share(text))
    except ValueError:
        raise SceneError(f"--to {text!s:.40}: an error from '0.01 %' to '20 %', such as '1 %'") from None


def choose(
    scene: Scene,
    errors: list[NumericalError],
    to: float,
    measure: Callable[[Scene], Measured],
    plan: Callable[[Scene], Campaign] = Campaign,
) -> ChosenSettings:
    """Refine what makes up the errors of a scene until none is larger than asked for, then make coarser what makes up
    next to nothing of them.

    measure  errors and runs of another scene        plan  its runs
    """
    settings: dict[str, Any] = {}
    reasons: dict[str, str] = {}
    first = seconds = 0.0
    for _ in range(ROUNDS):
        now = changed(scene, settings)
        errors, runs = measure(now)
        seconds = runs[0][1]["seconds_processor_run"]
        first = first or seconds
        finer = {} if largest(errors) <= to else _refined(errors, plan(now), to)
        if not finer:
            break
        reasons |= dict.fromkeys(finer, f"finer: numbers within {100 * largest(errors):.2g} % before")
        settings = merged(settings, finer)
    coarser = _coarser(errors, plan(changed(scene, settings)), to) if largest(errors) <= to else {}
    if coarser:
        fewer, runs = measure(changed(scene, merged(settings, coarser)))
        if largest(fewer) <= to and fewer and runs[0][1]["seconds_processor_run"] < seconds:
            reasons |= dict.fromkeys(coarser, "coarser: it buys nothing")
            settings, errors, seconds = merged(settings, coarser), fewer, runs[0][1]["seconds_processor_run"]
    return ChosenSettings(settings, reasons, largest(errors), to, (seconds, first), _judged(runs[0][1]))


def _judged(row: Row) -> str:
    """The verdict of a run, and its doubts where it has some; "" where a verdict is not asked for."""
    if row["verdict"] is None:
        return ""
    return f"{row['verdict']} ({row['doubts']})" if row["doubts"] else str(row["verdict"])


def largest(errors: Sequence[NumericalError]) -> float:
    """The largest relative error of a number that the bars allow."""
    return max((error.at_most / abs(error.value) for error in errors if error.value), default=0.0)


def _refined(errors: Sequence[NumericalError], campaign: Campaign, to: float) -> dict[str, Any]:
    """Settings that make finer what makes up most of the errors; empty where nothing does."""
    resolutions = campaign.resolutions
    parts = {resolution.name: _part(errors, resolution.name) for resolution in resolutions}
    counts = min(COUNTS * to, 0.5 * max(parts.values(), default=0.0))
    settings: dict[str, Any] = {}
    for resolution in resolutions:
        if parts[resolution.name] > counts:
            finer = campaign.trial(resolution, next(factor for factor in resolution.factors if factor > 1.0))
            settings = merged(settings, finer.settings if finer is not None else {})
    return settings | _narrower(campaign.scene, to)


def _narrower(scene: Scene, to: float) -> dict[str, Any]:
    """The interval of a load factor, where half of it alone is near the error asked for."""
    accuracy = scene.limit.accuracy if scene.limit is not None else None
    is_wide = isinstance(accuracy, float) and accuracy > COUNTS * to
    return {"limit.accuracy": max(COUNTS * to, FINEST_ACCURACY)} if is_wide else {}


def _coarser(errors: Sequence[NumericalError], campaign: Campaign, to: float) -> dict[str, Any]:
    """Settings that make coarser by two what makes up next to nothing of the errors."""
    settings: dict[str, Any] = {}
    for resolution in campaign.resolutions:
        fewer = campaign.trial(resolution, 0.5) if _part(errors, resolution.name) <= IDLE * to else None
        settings |= fewer.settings if fewer is not None else {}
    return settings


def _part(errors: Sequence[NumericalError], name: str) -> float:
    """The largest relative part of a resolution in any of the errors, what it may not have seen among it."""
    parts = [(error, max(abs(error.parts.get(name, 0.0)), error.unseen.get(name, 0.0))) for error in errors]
    return max((part / abs(error.value) for error, part in parts if error.value), default=0.0)

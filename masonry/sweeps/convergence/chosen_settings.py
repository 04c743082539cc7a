"""Settings by which the numbers of a scene have no larger error than asked for, and which cost no more than needed."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from masonry.scene import Scene, changed
from masonry.scene.tables.loads_and_supports import accuracy_share
from masonry.sweeps.convergence.campaign import Campaign, Refinement, merged
from masonry.sweeps.convergence.numerical_errors import NumericalError
from masonry.sweeps.convergence.resolutions import FINEST_ACCURACY
from masonry.sweeps.run_store import Row

FILE = "converged.toml"
ROUNDS = 5
"""Refinements one after the other, at most."""
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
    """

    settings: dict[str, Any]
    reasons: dict[str, str]
    error: float
    to: float
    seconds: tuple[float, float]

    @property
    def words(self) -> str:
        """A sentence."""
        ratio = self.seconds[0] / max(self.seconds[1], 1e-3)
        what = "The scene as it is" if not self.settings else f"{FILE}"
        took = f", for {ratio:.2g} times the time" if self.settings else ""
        if self.error <= self.to:
            return f"{what} has its numbers within {100 * self.error:.2g} % ({100 * self.to:g} % were asked for){took}."
        return (
            f"{what} has its numbers within {100 * self.error:.2g} %{took}; the {100 * self.to:g} % asked for were not "
            "reached: what is left is scatter, or converges too slowly."
        )

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
    """An error as a person gives it, "1 %" or 0.01. Raises ValueError."""
    return float(accuracy_share(text))


def choose(
    scene: Scene, errors: list[NumericalError], to: float, measure: Callable[[Scene], Measured]
) -> ChosenSettings:
    """Refine what makes up the errors of a scene until none is larger than asked for, then make coarser what makes up
    next to nothing of them.

    measure  errors and runs of another scene
    """
    settings: dict[str, Any] = {}
    reasons: dict[str, str] = {}
    first = seconds = 0.0
    for _ in range(ROUNDS):
        now = changed(scene, settings)
        errors, runs = measure(now)
        seconds = runs[0][1]["seconds_processor_run"]
        first = first or seconds
        finer = {} if largest(errors) <= to else _refined(errors, now, to)
        if not finer:
            break
        reasons |= dict.fromkeys(finer, f"finer: numbers within {100 * largest(errors):.2g} % before")
        settings = merged(settings, finer)
    coarser = _coarser(errors, changed(scene, settings), to) if largest(errors) <= to else {}
    if coarser:
        fewer, runs = measure(changed(scene, merged(settings, coarser)))
        if largest(fewer) <= to and fewer and runs[0][1]["seconds_processor_run"] < seconds:
            reasons |= dict.fromkeys(coarser, "coarser: it buys nothing")
            return ChosenSettings(
                merged(settings, coarser), reasons, largest(fewer), to, (runs[0][1]["seconds_processor_run"], first)
            )
    return ChosenSettings(settings, reasons, largest(errors), to, (seconds, first))


def largest(errors: Sequence[NumericalError]) -> float:
    """The largest relative error of a number that the bars allow."""
    return max((error.at_most / abs(error.value) for error in errors if error.value), default=0.0)


def _refined(errors: Sequence[NumericalError], scene: Scene, to: float) -> dict[str, Any]:
    """Settings that make finer what makes up most of the errors; empty where nothing does."""
    resolutions = Campaign(scene).resolutions
    parts = {resolution.name: _part(errors, resolution.name) for resolution in resolutions}
    counts = min(COUNTS * to, 0.5 * max(parts.values(), default=0.0))
    settings: dict[str, Any] = {}
    for resolution in resolutions:
        if parts[resolution.name] > counts:
            factor = next(factor for factor in resolution.factors if factor > 1.0)
            settings = merged(settings, resolution.settings(factor) or {})
    return settings | _narrower(scene, to)


def _narrower(scene: Scene, to: float) -> dict[str, Any]:
    """The interval of a load factor, where half of it alone is near the error asked for."""
    accuracy = scene.limit.accuracy if scene.limit is not None else None
    is_wide = isinstance(accuracy, float) and accuracy > COUNTS * to
    return {"limit.accuracy": max(COUNTS * to, FINEST_ACCURACY)} if is_wide else {}


def _coarser(errors: Sequence[NumericalError], scene: Scene, to: float) -> dict[str, Any]:
    """Settings that make coarser by two what makes up next to nothing of the errors."""
    settings: dict[str, Any] = {}
    for resolution in Campaign(scene).resolutions:
        if _part(errors, resolution.name) <= IDLE * to:
            settings |= resolution.settings(0.5) or {}
    return settings


def _part(errors: Sequence[NumericalError], name: str) -> float:
    """The largest relative part of a resolution in any of the errors."""
    return max((abs(error.parts.get(name, 0.0) / error.value) for error in errors if error.value), default=0.0)

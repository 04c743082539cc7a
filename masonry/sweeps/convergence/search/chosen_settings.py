"""Settings by which the numbers of a scene have no larger error than asked for, and which cost no more than needed."""

import textwrap
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

from masonry.errors import SceneError
from masonry.runtime.tables import WIDTH
from masonry.scene.tables.loads_and_supports import accuracy_share
from masonry.sweeps.convergence.refinement.campaign import Refinement
from masonry.sweeps.convergence.refinement.numerical_errors import NumericalError
from masonry.sweeps.run_store import Row

FILE = "converged.toml"
SHORT = 0.5
"""Seconds of a run of which no ratio is told, and which is not made coarser: it would be noise."""
VERDICTS = ("sound", "with care")
"""The better first."""

Runs = list[tuple[Refinement, Row]]
Measured = tuple[list[NumericalError], Runs]


@dataclass(frozen=True)
class Settings:
    """Settings by dotted key, what was measured with them, and by key and resolution why they were chosen."""

    settings: dict[str, Any]
    errors: list[NumericalError]
    runs: Runs
    reasons: dict[str, dict[str, str]] = field(default_factory=dict)

    @property
    def seconds(self) -> float:
        """Of processor."""
        return float(self.runs[0][1]["seconds_processor_run"])

    def largest(self, but: Sequence[str] = ()) -> float:
        """The largest relative error that the bars allow, some numbers apart."""
        return max(
            (relative(error) for error in self.errors if error.value and error.answer.key not in but), default=0.0
        )

    @property
    def verdict(self) -> str:
        """Of a run with them, and its doubts; "" where a verdict is not asked for."""
        row = self.runs[0][1]
        return f"{row['verdict']} ({row['doubts']})" if row["doubts"] else str(row["verdict"] or "")

    @property
    def rank(self) -> int:
        """Of the verdict, 0 the best."""
        verdict = self.runs[0][1]["verdict"]
        return VERDICTS.index(verdict) if verdict in VERDICTS else len(VERDICTS)


@dataclass(frozen=True)
class ChosenSettings:
    """The settings that were chosen.

    best     they, and what was measured with them
    tried    all, the scene as it is first
    to       the error asked for
    unreached  by key of a number that does not become as good as asked for, why
    """

    best: Settings
    tried: list[Settings]
    to: float
    unreached: dict[str, str]

    @property
    def settings(self) -> dict[str, Any]:
        """By dotted key."""
        return self.best.settings

    @property
    def error(self) -> float:
        """The largest relative error of a number within reach; of all, where none is."""
        return self.best.largest(self._apart)

    @property
    def _apart(self) -> list[str]:
        """Numbers that are not within reach, where others are."""
        keys = {error.answer.key for error in self.best.errors if error.value}
        return [key for key in self.unreached if key in keys] if keys - set(self.unreached) else []

    @property
    def words(self) -> str:
        """A sentence on what they buy, and one for each number that is not within reach."""
        seconds, first = self.best.seconds, self.tried[0].seconds
        what = FILE if self.settings else "The scene as it is"
        took = f", for {seconds / first:.2g} times the time" if self.settings and min(seconds, first) > SHORT else ""
        numbers = "its numbers" if not self._apart else "its other numbers"
        reached = f"{what} has {numbers} within {percent(self.error)} ({100 * self.to:g} % were asked for){took}"
        judged = f"; its run is {self.best.verdict}" if self.best.verdict else ""
        missed = [
            f"The {error.answer.words} is within {percent(relative(error))}: {self.unreached[error.answer.key]}."
            for error in self.best.errors
            if error.answer.key in self.unreached
        ]
        return " ".join([*missed, f"{reached}{judged}."])

    def as_toml(self, scene: str) -> str:
        """A scene file that stands beside that of the scene as it is."""
        numbers = [
            f"{error.answer.words} within {percent(relative(error))}" for error in self.best.errors if error.value
        ]
        said = [*textwrap.wrap(self.words, WIDTH), *textwrap.wrap(", ".join(numbers), WIDTH)]
        lines = [*(f"# {line}" for line in said), f'base = "{scene}"']
        tables: dict[str, list[str]] = {}
        for key, value in self.settings.items():
            table, _, name = key.rpartition(".")
            reasons = "; ".join(self.best.reasons[key].values())
            tables.setdefault(table, []).append(f"{name} = {toml_of(value)}  # {reasons}")
        for table, entries in tables.items():
            lines += ["", f"[{table}]", *entries]
        return "\n".join(lines) + "\n"


def toml_of(value: Any) -> str:
    """A value as a scene file gives it."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key} = {part}" for key, part in value.items()) + "}"
    return f'"{value}"' if isinstance(value, str) else repr(value)


def percent(fraction: float) -> str:
    """Two digits of a fraction, in per cent; no less than a thousandth of one."""
    fraction = max(fraction, 1e-5)
    return f"{100 * fraction:.2g} %" if fraction < 1.0 else f"{100 * fraction:.0f} %"


def relative(error: NumericalError) -> float:
    """The largest error that a bar allows, over the number."""
    return error.at_most / abs(error.value)


def fraction(text: Any) -> float:
    """An error as a person gives it, "1 %" or 0.01. Raises SceneError."""
    try:
        return float(accuracy_share(text))
    except ValueError:
        raise SceneError(f"--to {text!s:.40}: an error from '0.01 %' to '20 %', such as '1 %'") from None

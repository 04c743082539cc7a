"""Grid of the stability map, and the possible outcomes of each of its cells."""

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from verification.scene_runs import SceneRun

GOOD, POOR = 0.01, 0.05
"""Errors up to which a cell is right, and beyond which one that says nothing is wrong."""
KINDS = ("ok", "warn", "stop", "bad")
STATUSES = ("OK", "WARNED", "REFUSED", "STOPPED", "WRONG", "NOT FINITE")
"""WARNED: a result, and the program's own word against it. The last two must not occur."""


class Exact(NamedTuple):
    """A value to hold a run against, and what the error is relative to (itself where that is 0)."""

    value: float
    reference: float
    scale: float = 0.0

    @property
    def error(self) -> float:
        """Unsigned."""
        size = abs(self.scale or self.reference)
        return abs(self.value - self.reference) / size if size else math.inf


Compare = Callable[[SceneRun], dict[str, Exact]]
Make = Callable[[], SceneRun]


@dataclass(frozen=True)
class MapCell:
    """One run.

    scene    name of a scene of the verification or of a packaged one
    compare  what the result is held against
    must     statuses that the cell must end in, where not any will do
    make     in place of the scene's run: what makes the run
    """

    scene: str
    knobs: dict[str, Any]
    compare: Compare
    must: tuple[str, ...] = ()
    make: Make | None = None


@dataclass(frozen=True)
class Grid:
    """A map of cells: (row, column) -> cell; a place without a cell stays empty.

    against  what the references are; with "." left out
    """

    title: str
    row_title: str
    column_title: str
    cells: dict[tuple[str, str], MapCell]
    against: str = "closed form"
    note: str = ""

    @property
    def rows(self) -> list[str]:
        return list(dict.fromkeys(row for row, _ in self.cells))

    @property
    def columns(self) -> list[str]:
        return list(dict.fromkeys(column for _, column in self.cells))


@dataclass
class CellOutcome:
    """Outcome of a cell: status, reason (the program's own words), largest error, kind of KINDS, records."""

    row: str
    column: str
    status: str
    reason: str
    error: float
    kind: str
    records: list[dict[str, Any]] = field(default_factory=list)

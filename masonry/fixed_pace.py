"""How a run advances, chunk by chunk: a program that is fixed beforehand."""

from dataclasses import dataclass

import numpy as np

from masonry.loads import Program
from masonry.remember import State

LONGEST_CHUNK = 200
"""Steps between two looks at the motion: an instability then cannot grow into infinities unseen."""


@dataclass(frozen=True)
class Chunk:
    """Some steps: share of the dead load (n + 1,) and speed of the drive (n + 1,) m/s, before and after each step.

    row    whether a row of the history is due after it
    place  m, signed: where the drive is after it, if that is known better than the sum of the speeds
    """

    dead_load: np.ndarray
    speed: np.ndarray
    row: bool
    place: float | None = None

    @property
    def steps(self) -> int:
        return len(self.speed) - 1


class FixedPace:
    """The chunks of a program, with a row every so many steps, and after each step that the program marks."""

    def __init__(self, program: Program, rows: int) -> None:
        self.program, self.done = program, 0
        self.every = max(1, program.steps // rows)

    def next(self) -> Chunk | None:
        """The next chunk; None at the end."""
        steps = self.program.steps
        if self.done >= steps:
            return None
        due = self.row_due()
        first, self.done = self.done, min(due, self.done + LONGEST_CHUNK)
        part = slice(first, self.done + 1)
        return Chunk(self.program.dead_load[part], self.program.speed[part], self.done == due)

    def row_due(self) -> int:
        """The next step after which a row is due."""
        marks = self.program.marks
        k = int(np.searchsorted(marks, self.done, side="right"))
        regular = min((self.done // self.every + 1) * self.every, self.program.steps)
        return min(regular, int(marks[k])) if k < len(marks) else regular

    def look(self, force: float, support: float, seen: np.ndarray, terms: dict[str, float]) -> None:
        """A fixed program does not care."""

    def progress(self) -> tuple[int, int]:
        """Steps done, and all of them."""
        return self.done, self.program.steps

    def report(self) -> dict[str, float]:
        """Nothing was asked, and nothing achieved."""
        return {}

    def state(self) -> State:
        """How far it is."""
        return {"done": self.done}

    def restore(self, state: State) -> None:
        """Go on from there."""
        self.done = state["done"]

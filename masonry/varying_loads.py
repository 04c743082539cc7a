"""Loads that vary, each by a history of its own: straight from chunk to chunk, by one array of changes for all."""

import numpy as np

from masonry.fixed_pace import LONGEST_CHUNK, Chunk, FixedPace
from masonry.loads import Program
from masonry.model import Model


class VaryingPace(FixedPace):
    """A fixed program in which the loads pass from their shares at the start of a chunk to those at its end.

    Within a chunk of at most 200 steps each load changes in proportion to the steps, so the step itself needs no more
    than the loads at the start and their change, however many histories there are.
    """

    def __init__(self, model: Model, program: Program, shares: np.ndarray, rows: int) -> None:
        super().__init__(program, rows)
        self.shares = shares
        self.parts = []
        for kind, body in zip(("rigid", "affine", "tets"), model.bodies, strict=True):
            if body is not None and body.change is not None:
                each = [np.zeros(body.load.shape) if one[kind] is None else one[kind] for one in model.varying]
                self.parts.append((body, body.load.copy(), np.array(each)))

    def next(self) -> Chunk | None:
        """The next chunk; it sets the loads of the bodies for its steps. None at the end."""
        steps, settle = self.program.steps, self.program.settle
        if self.done >= steps:
            return None
        due = self.row_due()
        first, self.done = self.done, min(due, self.done + LONGEST_CHUNK, settle if self.done < settle else steps)
        part = slice(first, self.done + 1)
        begin, end = self.shares[:, first], self.shares[:, self.done]
        for body, rest, each in self.parts:
            body.load[...] = rest + np.tensordot(begin, each, 1)
            body.change[...] = np.tensordot(end - begin, each, 1)
        dead_load = self.program.dead_load[part]
        if first >= settle:
            dead_load = dead_load + np.linspace(0.0, 1.0, self.done - first + 1)
        return Chunk(dead_load, self.program.speed[part], self.done == due)

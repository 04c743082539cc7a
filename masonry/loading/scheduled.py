"""How a run advances, chunk by chunk: a program that is fixed beforehand."""

from dataclasses import replace

import numpy as np

from masonry.configuration.chunk import Chunk
from masonry.configuration.energy import Seen
from masonry.loading.plans import Program
from masonry.loading.sudden_cracks import Rest
from masonry.loading.varying_loads import VaryingLoads
from masonry.model.model import Model
from masonry.monitors.unrest import left_of_motion
from masonry.rows.rest_criterion import LONE
from masonry.runtime.state import State, attributes, load_attributes

LONGEST_CHUNK = 100
"""Steps between two looks at the motion: an instability cannot grow into infinities unseen, nor a sudden crack far."""
STILL, STILL_ROWS = 1e-8, 20
"""All is at rest when the kinetic energy was below this share of its largest in so many rows, and that of each block
(monitors/unrest.py): what turns round in the air is still for less than a row."""


class ScheduledLoading:
    """The chunks of a program, with a row every so many steps, and after each step that the program marks."""

    def __init__(self, model: Model, program: Program, rows: int, rest: Rest | None = None) -> None:
        self.model, self.program, self.done, self.rest, self.speed = model, program, 0, rest, 0.0
        load_factors, rises = program.load_factors, program.layers is None
        self.loads = None
        if load_factors is not None:
            self.loads = VaryingLoads(model, load_factors, program.settle if rises else 0, program.straight)
        self.events = None if rest is None else rest.events
        self.every = max(1, program.steps // rows)
        self.last, self.still, self.most = program.steps, 0, 0.0

    def next(self) -> Chunk | None:
        """The next chunk; None at the end."""
        if self.done >= self.last:
            return None
        if self.rest is not None and self.rest.held:
            return self.hold(self.rest.steps)
        due = self.row_due()
        first, latest = self.done, self.done + LONGEST_CHUNK if self.loads is None else self.loads.latest(self.done)
        self.done = min(due, latest)
        part = slice(first, self.done + 1)
        dead_load = self.program.dead_load[part]
        if self.loads is not None:
            dead_load = self.loads.apply(first, self.done, dead_load)
        return self.going_on(Chunk(dead_load, self.program.speed[part], self.done == due))

    def hold(self, steps: int) -> Chunk:
        """Some steps in which the drive rests, and the dead loads stay; the move that was due next is still made."""
        return self.going_on(Chunk(np.full(steps + 1, self.program.dead_load[self.done]), np.zeros(steps + 1), False))

    def going_on(self, chunk: Chunk) -> Chunk:
        """The chunk, beginning with the speed that the one before it ended with."""
        if chunk.speed[0] != self.speed:
            chunk = replace(chunk, speed=np.concatenate([[self.speed], chunk.speed[1:]]))
        self.speed = float(chunk.speed[-1])
        return chunk

    def row_due(self) -> int:
        """The next step after which a row is due."""
        marks = self.program.marks
        k = int(np.searchsorted(marks, self.done, side="right"))
        regular = min((self.done // self.every + 1) * self.every, self.last)
        return min(regular, int(marks[k])) if k < len(marks) else regular

    def feel(self, step: int, before: list[np.ndarray]) -> None:
        """The drive is held where the specimen moves by itself; `before`: velocities one step before this one."""
        if self.rest is not None and self.done > self.program.settle:
            self.rest.look(step, self.speed, before)

    def look(self, force: float, support: float, seen: Seen, terms: dict[str, float]) -> None:
        """The drive is held by what the specimen stores. At rest, the next row may be the last."""
        if self.rest is not None:
            self.rest.see(terms["elastic_blocks"] + terms["elastic_contacts"])
        if self.program.rest_from is not None:
            self.most = max(self.most, terms["kinetic"])
            self.still = self.still + 1 if terms["kinetic"] <= STILL * self.most and self.each_rests() else 0
            if self.done >= self.program.rest_from and self.still >= STILL_ROWS and self.most > 0.0:
                self.last = self.row_due()

    def each_rests(self) -> bool:
        """Whether each block is at rest, where the sum over all is."""
        return bool((left_of_motion(self.model, self.most) <= LONE**2 * STILL).all())

    def load_factors(self) -> np.ndarray:
        """(H,) of the loads that vary, now."""
        return np.zeros(0) if self.loads is None else self.loads.load_factors[:, self.done]

    def columns(self) -> dict[str, float]:
        """Nothing more for a row to say."""
        return {}

    def progress(self) -> tuple[int, int]:
        """Steps done, and all of them."""
        return self.done, self.last

    def report(self) -> dict[str, float]:
        """Nothing was asked, and nothing achieved."""
        return {}

    def state(self) -> State:
        """How far it is."""
        own = attributes(self, ("done", "speed", "last", "still", "most"))
        return {**own, "rest": None if self.rest is None else self.rest.state()}

    def restore(self, state: State) -> None:
        """Go on from there."""
        load_attributes(self, ("done", "speed", "last", "still", "most"), state)
        if self.rest is not None:
            self.rest.restore(state["rest"])

"""A program that is fixed beforehand, step by step: the plan, and how a run advances along it."""

from dataclasses import dataclass, field, replace
from math import sqrt

import numpy as np

from masonry.configuration.chunk import Chunk
from masonry.configuration.energy import Seen
from masonry.loading.crack_watch import CrackWatch
from masonry.loading.loading import Expected, Loading
from masonry.loading.varying_loads import VaryingLoads
from masonry.model.damping import Damping
from masonry.model.gauges import Gauge
from masonry.model.model import Model
from masonry.monitors.events import Event
from masonry.monitors.unrest import left_of_motion
from masonry.rows.columns import stored_in
from masonry.rows.rest_criterion import ENDED
from masonry.runtime.progress import Effort

LONGEST_CHUNK, WATCHED = 200, 100
"""Steps between two looks at the motion: an instability cannot grow into infinities unseen; and where sudden cracks are
looked for, these cannot grow far."""
SOONEST = 6
"""Of all steps of a run that ends at rest: in which part of them that is taken to be possible at the earliest, where
nothing else says so. Walls that fall and rubble that is heaped up took 0.3 to 0.9 of them."""


@dataclass(frozen=True)
class Program:
    """Loading at each step 0..n: share of the dead load, velocity of the drive (m/s) after the step.

    settle  steps before the drive starts     ramp  steps over which the drive's velocity rises
    varying (H, n + 1) share of each load that varies, at each step; None without any
    marks   steps, rising, after which a row is due besides the regular ones
    layers  (L, settle + 1) share of each load that comes on in layers, until the end of the settling; None without any
    every   steps from one row to the next, so that rows are equally spaced in time from the end of the settling on;
            None where their number over all steps says it
    straight   of its largest share: how far a history may leave the straight line that the loading takes for it
    base       (n + 1, C) m/s, velocities of supports that move, after each step; None without any
    kinks      steps, rising, between which loads that vary exactly straight do so
    rest_from  step from which on the run may end as soon as all is at rest; None where it goes on to the last step
    """

    dead_load: np.ndarray
    speed: np.ndarray
    settle: int
    ramp: int
    varying: np.ndarray | None = None
    marks: np.ndarray = field(default_factory=lambda: np.zeros(0, dtype=np.int64))
    straight: float = 1e-3
    rest_from: int | None = None
    layers: np.ndarray | None = None
    kinks: np.ndarray = field(default_factory=lambda: np.zeros(0, dtype=np.int64))
    every: int | None = None
    base: np.ndarray | None = None

    hurries_while_elastic = False

    @property
    def steps(self) -> int:
        return len(self.speed) - 1

    @property
    def load_factors(self) -> np.ndarray | None:
        """(L + H, n + 1) factor of each load that does not simply rise with the others, at each step."""
        if self.layers is None:
            return self.varying
        stay = np.pad(self.layers, ((0, 0), (0, self.steps - self.settle)), mode="edge")
        return stay if self.varying is None else np.concatenate([stay, self.varying])

    @property
    def moves_at_once(self) -> bool:
        """Whether all moves from the first step on, as nothing has to settle."""
        return self.steps > self.settle == 0

    def factors_at(self, steps: np.ndarray) -> np.ndarray | None:
        """(L + H, n) factors of the loads that vary, at some steps (n,); None without any."""
        load_factors = self.load_factors
        return None if load_factors is None else load_factors[:, steps.astype(np.int64)]

    def ends_before(self, steps: int) -> bool:
        """Whether so many steps are fewer than it has: a run that ends at rest takes no more."""
        return steps < self.steps

    def expected(self, model: Model, rows: int, axis: int | None) -> Expected:
        """Its steps; a row every so many of them, and one at each mark. Of one that may end at rest, the mean of the
        fewest and the most, as factors."""
        fewest = self.steps if self.rest_from is None else max(self.rest_from, self.steps // SOONEST)
        share = sqrt(fewest / max(self.steps, 1))
        rows = rows if self.every is None else self.steps // self.every
        steps, count = round(share * self.steps), round(share * min(rows, self.steps))
        chunks = max(count, steps / LONGEST_CHUNK) + len(self.kinks)
        return Expected(steps, count + len(self.marks), chunks, least=share, most=1.0 / max(share, 1e-9))

    def settling(self) -> "Program":
        """The dead loads alone, as long as they settle; what varies stays as it begins."""
        count = self.settle + 1
        varying = None if self.varying is None else self.varying[:, :count]
        return Program(self.dead_load[:count], np.zeros(count), self.settle, 0, varying, layers=self.layers)

    def settling_damping(self, damping: Damping) -> Damping:
        """The damping of a model, while its dead loads are tried."""
        return damping

    def loading(self, model: Model, rows: int, gauges: tuple[Gauge, ...] = ()) -> "ScheduledLoading":
        """Sudden cracks are waited for where masses are scaled and no load varies, once all has settled."""
        goes_on = self.steps > self.settle
        waits = goes_on and self.varying is None and model.scaled and model.damping is not None
        return ScheduledLoading(model, self, rows, CrackWatch(model) if waits else None)


class ScheduledLoading(Loading):
    """The chunks of a program, with a row every so many steps, and after each step that the program marks."""

    REMEMBERED = ("done", "speed", "last", "still", "most")

    def __init__(self, model: Model, program: Program, rows: int, watch: CrackWatch | None = None) -> None:
        """Cracks  has the drive wait where one is sudden"""
        self.model, self.program, self.watch = model, program, watch
        self.done, self.speed = 0, 0.0
        load_factors, rises = program.load_factors, program.layers is None
        self.loads = None
        if load_factors is not None:
            self.loads = VaryingLoads(
                model, load_factors, program.settle if rises else 0, program.straight, program.kinks
            )
        self.every = program.every or max(1, program.steps // rows)
        self.last, self.still, self.most = program.steps, 0, 0.0

    def next(self) -> Chunk | None:
        """The next chunk; None at the end."""
        if self.done >= self.last:
            return None
        if self.watch is not None and self.watch.pause:
            return self.hold(self.watch.steps)
        due = self.row_due()
        first, latest = self.done, self.latest()
        self.done = min(due, latest)
        part = slice(first, self.done + 1)
        dead_load = self.program.dead_load[part]
        if self.loads is not None:
            dead_load = self.loads.apply(first, self.done, dead_load)
        base = None if self.program.base is None else self.program.base[part]
        return self.going_on(Chunk(dead_load, self.program.speed[part], self.done == due, base=base))

    def latest(self) -> int:
        """The step at which the next chunk ends at the latest."""
        if self.loads is not None:
            return self.loads.latest(self.done)
        return self.done + (LONGEST_CHUNK if self.watch is None else WATCHED)

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
        begin = 0 if self.program.every is None else self.program.settle
        regular = min(begin + ((self.done - begin) // self.every + 1) * self.every, self.last)
        return min(regular, int(marks[k])) if k < len(marks) else regular

    def feel(self, step: int, before: list[np.ndarray]) -> None:
        """The drive is held where the specimen moves by itself; `before`: velocities one step before this one."""
        if self.watch is not None and self.done > self.program.settle:
            self.watch.look(step, self.speed, before)

    def look(self, force: float, support: float, seen: Seen, terms: dict[str, float]) -> None:
        """The drive is held by what the specimen stores. At rest, the next row may be the last."""
        if self.watch is not None:
            self.watch.see(stored_in(terms))
        if self.program.rest_from is not None:
            self.most = max(self.most, terms["kinetic"])
            still = terms["kinetic"] <= ENDED.energy * self.most and self.each_rests()
            self.still = self.still + 1 if still and self.done > self.program.rest_from else 0
            if self.still >= ENDED.looks and self.most > 0.0:
                self.last = self.row_due()

    def each_rests(self) -> bool:
        """Whether each block is at rest, where the sum over all is."""
        return bool((left_of_motion(self.model, self.most) <= ENDED.of_block.energy).all())

    def load_factors(self) -> np.ndarray:
        """(H,) of the loads that vary, now."""
        return np.zeros(0) if self.loads is None else self.loads.load_factors[:, self.done]

    def progress(self) -> tuple[int, int]:
        """Steps done, and all of them."""
        return self.done, self.last

    def effort(self) -> Effort:
        """In steps; a run that may end at rest may do so from some step on."""
        left, rest_from = self.last - self.done, self.program.rest_from
        if rest_from is None or self.last < self.program.steps:
            return Effort(self.done, left, left)
        return Effort(self.done, max(rest_from - self.done, 0), left)

    @property
    def events(self) -> list[Event]:
        """The sudden cracks so far."""
        return [] if self.watch is None else self.watch.cracks.events

    def parts(self) -> dict[str, CrackWatch]:
        """Watch for sudden cracks, where there is one."""
        return {} if self.watch is None else {"watch": self.watch}

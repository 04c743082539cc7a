"""How a run advances, chunk by chunk: a fixed program, or a drive that is paced by its error."""

from dataclasses import dataclass

import numpy as np

from masonry.guide import Guide
from masonry.loads import Controlled, Program, smooth
from masonry.model import Model
from masonry.utilisation import utilisation

LONGEST_CHUNK = 200
"""Steps between two looks at the motion: an instability then cannot grow into infinities unseen."""


@dataclass(frozen=True)
class Chunk:
    """Some steps: share of the dead load (n + 1,) and speed of the drive (n + 1,) m/s, before and after each step.

    row  whether a row of the history is due after it
    """

    dead_load: np.ndarray
    speed: np.ndarray
    row: bool

    @property
    def steps(self) -> int:
        return len(self.speed) - 1


class FixedPace:
    """The chunks of a program, with a row every so many steps."""

    def __init__(self, program: Program, rows: int) -> None:
        self.program, self.done = program, 0
        self.every = max(1, program.steps // rows)

    def next(self) -> Chunk | None:
        """The next chunk; None at the end."""
        steps = self.program.steps
        if self.done >= steps:
            return None
        due = min((self.done // self.every + 1) * self.every, steps)
        first, self.done = self.done, min(due, self.done + LONGEST_CHUNK)
        part = slice(first, self.done + 1)
        return Chunk(self.program.dead_load[part], self.program.speed[part], self.done == due)

    def look(self, force: float, seen: np.ndarray, terms: dict[str, float]) -> None:
        """A fixed program does not care."""

    def progress(self) -> tuple[int, int]:
        """Steps done, and all of them."""
        return self.done, self.program.steps

    def report(self) -> dict[str, float]:
        """Nothing was asked, and nothing achieved."""
        return {}


STEPS = 50
"""Steps of an increment."""
COARSEST, FINEST = 60, 40_000
"""Increments in which the whole displacement is made, at least and at most."""
FIRST = 1e-4
"""Share of the displacement that the first increment makes."""
FASTER, SLOWER = 1.3, 0.6
"""Most and least change of the speed from one increment to the next."""
INTACT = 1e-6
"""Nothing counts as damaged while fracture has taken less than this share of the stored energy."""
STRIDE = 0.15
"""Share by which an increment may lengthen the way of the drive while nothing is damaged."""
CHANGE, MOTION = 2.0, 5.0
"""What an increment may bring, in accuracies: change of the stored energy, or energy spent on fracture, over the most
that was stored; and kinetic over stored energy."""


class ControlledPace:
    """Smooth increments of the drive, as large as the accuracy allows.

    Between two increments the speed changes by a quintic. How fast it becomes follows from what the last increment
    brought: larger increments while elastic, smaller ones while cracking.
    """

    def __init__(self, model: Model, plan: Controlled, rows: int) -> None:
        self.model, self.dt, self.plan, self.guide = model, model.dt, plan, Guide(model)
        self.settling = FixedPace(Program(plan.dead_load, np.zeros(len(plan.dead_load)), plan.settle, 0), rows)
        self.goal = abs(plan.displacement)
        self.sign = -1.0 if plan.displacement < 0 else 1.0
        whole = self.goal / (STEPS * model.dt)
        self.slowest, self.fastest, self.target = whole / FINEST, whole / COARSEST, whole * FIRST
        self.speed = self.moved = 0.0
        self.most_stored = self.stored = self.broken = 0.0
        self.increments = 0
        self.worst = 0.0

    def next(self) -> Chunk | None:
        """The next increment; None when the displacement is made."""
        waiting = self.settling.next()
        if waiting is not None:
            return waiting
        left = self.goal - self.moved
        if left <= 1e-12 * self.goal:
            return None
        rise = smooth(np.arange(1, STEPS + 1) / STEPS)
        speed = np.concatenate([[self.speed], self.speed + (self.target - self.speed) * rise])
        first, whole = speed[0] * self.dt, speed[:-1].sum() * self.dt
        if left < 1.5 * whole:
            speed[1:] *= (left - first) / (whole - first)
            whole = left
        self.moved += whole
        self.speed = float(speed[-1])
        self.increments += 1
        return Chunk(np.full(STEPS + 1, self.plan.dead_load[-1]), self.sign * speed, True)

    def look(self, force: float, seen: np.ndarray, terms: dict[str, float]) -> None:
        """Choose the next speed by the force of the drive (N), what contacts show, and the ledger (J; see energy.py).

        Where nothing is damaged, the next increment goes half of the way to damage at most, or as far as the accuracy
        lets it.
        """
        stored = terms["elastic_blocks"] + terms["elastic_contacts"]
        broken = terms["fracture_mode_1"] + terms["fracture_mode_2"]
        if self.increments == 0:
            self.stored = self.most_stored = stored
            self.guide.settle()
            return
        self.most_stored = max(self.most_stored, stored, 1e-300)
        allowed = CHANGE * self.plan.accuracy
        change = abs(stored - self.stored) / self.most_stored
        if broken <= INTACT * self.most_stored:
            used = max(utilisation(self.model, seen), 1e-9)
            excess = change / (2.0 * np.clip(0.5 * (1.0 / used - 1.0), allowed, STRIDE))
        else:
            fracture = (broken - self.broken) / self.most_stored
            excess = max(change / allowed, fracture / allowed)
            self.worst = max(self.worst, excess)
            excess = max(excess, terms["kinetic"] / max(stored, 1e-300) / (MOTION * self.plan.accuracy))
        self.stored, self.broken = stored, broken
        factor = np.clip(1.0 / np.sqrt(max(excess, 1e-12)), SLOWER, FASTER)
        self.target = float(np.clip(self.target * factor, self.slowest, self.fastest))
        self.guide.learn(self.sign * self.moved, self.sign * self.speed, force)

    def progress(self) -> tuple[int, int]:
        """How far the displacement is made, in millionths."""
        return int(1e6 * min(self.moved / self.goal, 1.0) + 1e-3), 1_000_000

    def report(self) -> dict[str, float]:
        """What was asked and achieved: the most that one increment changed after the first damage, in accuracies."""
        return {"accuracy": self.plan.accuracy, "increments": self.increments, "largest_change": CHANGE * self.worst}


Pace = FixedPace | ControlledPace


def pace_of(model: Model, plan: Program | Controlled, rows: int) -> Pace:
    """The pace that a plan asks for."""
    return FixedPace(plan, rows) if isinstance(plan, Program) else ControlledPace(model, plan, rows)

"""A drive that turns back, paced by its error: one leg after the other, at rest at each turn."""

from dataclasses import replace

import numpy as np

from masonry.cycling import Cyclic
from masonry.fixed_pace import Chunk
from masonry.loads import Controlled, smooth
from masonry.model import Model
from masonry.pace import COARSEST, FEW, FINEST, FIRST, STEPS, ControlledPace
from masonry.remember import State, attributes, put_back

RESTART = 0.25
"""Speed after a turn over the speed at which the drive came to it."""
BRAKE = 0.2
"""Least change of the speed from one increment to the next: contacts that close make a soft specimen stiff at once."""
CURVED = 100
"""Increments of a leg, at least, where all that moves is prescribed: they are cheap, and show the corners."""
LEG = ("goal", "sign", "slowest", "leg", "passed", "farthest", "cruise", "place", "force")
"""What changes from increment to increment: besides what any paced drive remembers."""


class CyclicPace(ControlledPace):
    """Increments as those of a drive that goes one way, leg by leg, with a stop at the end of each.

    What is measured against the way or the force of the test there is measured against the largest so far here: the
    force may pass through zero, and the drive through its start.
    """

    slower = BRAKE

    def __init__(self, model: Model, plan: Cyclic, rows: int) -> None:
        super().__init__(model, Controlled(plan.dead_load, plan.turns[0], plan.accuracy), rows)
        self.turns = plan.turns
        self.ways = np.abs(np.diff([0.0, *plan.turns]))
        self.leg = 0
        self.passed = self.farthest = self.cruise = self.place = self.force = 0.0

    def next(self) -> Chunk | None:
        """The next increment; None when the last place is reached."""
        waiting = self.settling.next()
        if waiting is not None:
            return waiting
        if self.goal - self.moved <= 1e-12 * self.goal and not self.turn():
            return None
        left, cruise = self.goal - self.moved, self.steps * self.dt
        if self.speed > 0.0 and left < (0.5 * (self.speed + self.target) + 0.5 * self.target) * cruise:
            return self.stop(left)
        self.cruise = self.target
        return self.made_of(self.speed + (self.target - self.speed) * smooth(np.arange(self.steps + 1) / self.steps))

    def stop(self, left: float) -> Chunk:
        """The last increment of a leg: as many steps as bring the speed down to rest at its end."""
        steps = max(2, round(2.0 * left / (self.speed * self.dt)))
        speed = self.speed * (1.0 - smooth(np.arange(steps + 1) / steps))
        first, whole = speed[0] * self.dt, float(speed[:-1].sum()) * self.dt
        speed[1:] *= (left - first) / (whole - first)
        chunk = self.made_of(speed)
        self.moved = self.goal
        return replace(chunk, place=self.turns[self.leg])

    def made_of(self, speed: np.ndarray) -> Chunk:
        """Book an increment of these speeds (n + 1,) m/s along the leg."""
        self.made = float(speed[:-1].sum()) * self.dt
        self.moved += self.made
        self.speed = float(speed[-1])
        self.increments += 1
        return Chunk(np.full(len(speed), self.plan.dead_load[-1]), self.sign * speed, True)

    def turn(self) -> bool:
        """Set out for the next place, slowly; False where there is none."""
        if self.leg + 1 >= len(self.turns):
            return False
        self.passed += self.goal
        begin, end = self.turns[self.leg : self.leg + 2]
        self.leg += 1
        self.goal, self.sign, self.moved = abs(end - begin), -1.0 if end < begin else 1.0, 0.0
        whole = self.goal / (self.steps * self.dt)
        self.slowest = self.goal / (STEPS * self.dt) / FINEST
        self.target = float(np.clip(RESTART * self.cruise, whole * FIRST, min(whole / COARSEST, self.leap)))
        return True

    def look(self, force: float, support: float, seen: np.ndarray, terms: dict[str, float]) -> None:
        """Choose the next speed as for one way."""
        if self.increments == 0:
            self.force = force
        super().look(force, support, seen, terms)
        if self.steps == FEW:
            self.target = min(self.target, self.goal / (CURVED * self.steps * self.dt))

    def learn(self, force: float) -> None:
        """The stiffness of the last increment: that of all the way may be anything, as both ends pass through zero."""
        begin = self.turns[self.leg - 1] if self.leg else 0.0
        place, before, force_before = begin + self.sign * self.moved, self.place, self.force
        self.place, self.force = place, force
        self.farthest = max(self.farthest, abs(place))
        stiffness = max(abs((force - force_before) / (place - before)), self.most_force / self.farthest)
        self.guide.learn(place, self.sign * self.speed, force, stiffness)

    def towards_damage(self, used: float) -> float:
        """On the way back the share of the strength falls before it grows: as fast, at most, as it fell."""
        fell = self.used - used
        if fell > 0.0:
            self.used = used - fell
        return super().towards_damage(used)

    def progress(self) -> tuple[int, int]:
        """How far all legs are made, in millionths."""
        whole = float(self.ways.sum())
        return int(1e6 * min((self.passed + self.moved) / whole, 1.0) + 1e-3), 1_000_000

    def state(self) -> State:
        """All that the next speed depends on."""
        return {**super().state(), **attributes(self, LEG)}

    def restore(self, state: State) -> None:
        """Go on from there."""
        super().restore(state)
        put_back(self, LEG, state)

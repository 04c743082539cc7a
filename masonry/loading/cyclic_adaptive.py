"""A drive that turns back, paced by its error: one leg after the other, at rest at each turn."""

import numpy as np

from masonry.loading.adaptive import AdaptiveLoading
from masonry.loading.schedule import Cyclic
from masonry.model.loads import Controlled
from masonry.model.model import Model
from masonry.monitors.energy import Seen
from masonry.runtime.state import State, attributes, put_back

RESTART = 0.25
"""Speed after a turn over the speed at which the drive came to it."""
CURVED = 100
"""Increments of a leg, at least, where all that moves is prescribed: they are cheap, and show the corners."""
LEG = ("goal", "sign", "slowest", "leg", "passed", "farthest", "begin", "end", "place", "force")
"""What changes from increment to increment: besides what any paced drive remembers."""


class CyclicLoading(AdaptiveLoading):
    """Increments as those of a drive that goes one way, leg by leg, with a stop at the end of each.

    What is measured against the way or the force of the test there is measured against the largest so far here: the
    force may pass through zero, and the drive through its start.
    """

    def __init__(self, model: Model, plan: Cyclic, rows: int) -> None:
        super().__init__(model, Controlled(plan.dead_load, plan.turns[0], plan.accuracy), rows)
        self.turns = plan.turns
        self.ways = np.abs(np.diff([0.0, *plan.turns]))
        self.leg = 0
        self.passed = self.farthest = self.place = self.force = 0.0

    def turn(self) -> bool:
        """Set out for the next place, slowly; False where there is none."""
        if self.leg + 1 >= len(self.turns):
            return False
        self.passed += self.goal
        self.begin, self.end = self.turns[self.leg : self.leg + 2]
        self.leg += 1
        self.goal, self.sign, self.moved = abs(self.end - self.begin), -1.0 if self.end < self.begin else 1.0, 0.0
        whole = self.goal / (self.steps * self.dt)
        self.slowest = self.goal / (self.settings.steps * self.dt) / self.settings.finest
        self.target = float(
            np.clip(RESTART * self.cruise, whole * self.settings.first, min(whole / self.settings.coarsest, self.leap))
        )
        return True

    def look(self, force: float, support: float, seen: Seen, terms: dict[str, float]) -> None:
        """Choose the next speed as for one way."""
        if self.increments == 0:
            self.force = force
        super().look(force, support, seen, terms)
        if self.steps == self.settings.few_steps:
            self.target = min(self.target, self.goal / (CURVED * self.steps * self.dt))

    def learn(self, force: float) -> None:
        """The stiffness of the last increment: that of all the way may be anything, as both ends pass through zero."""
        place, before, force_before = self.begin + self.sign * self.moved, self.place, self.force
        self.place, self.force = place, force
        self.farthest = max(self.farthest, abs(place))
        stiffness = max(abs((force - force_before) / (place - before)), self.most_force / self.farthest)
        self.guide.learn(place, self.sign * self.speed, force, stiffness)

    def settle(self, force: float) -> None:
        """The next stiffness is that from here on."""
        self.place, self.force = self.begin + self.sign * self.moved, force
        self.guide.settle(self.place)

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

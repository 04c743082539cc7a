"""The speed of a drive between its increments, and the steps of one."""

from functools import cache
from math import ceil

import numpy as np

from masonry.configuration.small import LEAP
from masonry.loading.drive.adaptive_settings import AdaptiveSettings
from masonry.loading.programs import smooth
from masonry.model.model import Model
from masonry.monitors.stability import smallest_block
from masonry.runtime.state_file import Remembering


class DriveSpeed(Remembering):
    """How fast a drive goes, m/s.

    now     at the end of the last increment     target  at the end of the next
    cruise  the target of the last increment that did not stop
    steps   of an increment
    leap    the fastest that no block is flung by
    pending     (n + 1,) m/s, at each step of what is left of an increment
    arrives_at  m/s, at the end of the piece that was made last
    """

    REMEMBERED = ("now", "target", "cruise", "steps", "pending", "arrives_at")

    def __init__(self, model: Model, settings: AdaptiveSettings) -> None:
        self.dt, self.settings, self.steps = model.dt, settings, settings.steps
        self.leap = 0.5 * LEAP * smallest_block(model) / model.dt
        self.now = self.target = self.cruise = self.arrives_at = 0.0
        self.pending = np.zeros(0)

    @property
    def duration(self) -> float:
        """s, of an increment."""
        return self.steps * self.dt

    @property
    def takes_few_steps(self) -> bool:
        """Whether all that moves is prescribed, so that few steps are enough."""
        return self.steps == self.settings.few_steps

    def to_target(self) -> np.ndarray:
        """(n + 1,) m/s, at each step of an increment that goes on."""
        self.cruise = self.target
        return self.now + (self.target - self.now) * passage(self.steps)

    def to_rest(self) -> np.ndarray:
        """(n + 1,) m/s, at each step of one in which the drive comes to rest, or stays there."""
        return self.now * (1.0 - passage(self.steps))

    def piece(self, many: int) -> np.ndarray:
        """(n + 1,) m/s, at each step of the next piece of an increment that is made in so many."""
        whole = len(self.pending) - 1
        steps = whole if many == 1 else min(whole, ceil(self.steps / many))
        piece, self.pending = self.pending[: steps + 1], self.pending[steps:] if steps < whole else np.zeros(0)
        self.arrives_at = float(piece[-1])
        return piece

    def must_stop(self, left: float) -> bool:
        """Whether another increment would leave too little of the path (m) to come to rest on."""
        return self.now > 0.0 and left < (0.5 * (self.now + self.target) + 0.5 * self.target) * self.duration

    def to_stop(self, left: float) -> np.ndarray:
        """(n + 1,) m/s, at each step of the last increment of a path: as many as bring the drive to rest at its end."""
        steps = max(2, round(2.0 * left / (self.now * self.dt)))
        speed = self.now * (1.0 - smooth(np.arange(steps + 1) / steps))
        first, whole = speed[0] * self.dt, float(speed[:-1].sum()) * self.dt
        speed[1:] *= (left - first) / (whole - first)
        return speed

    def change(self, factor: float, slowest: float, goal: float) -> None:
        """Change the target by a factor, within bounds; goal: m, of the leg."""
        fastest = min(goal / (self.settings.coarsest * self.steps * self.dt), self.leap)
        self.target = float(min(max(self.target * factor, slowest), fastest))


@cache
def passage(steps: int) -> np.ndarray:
    """(steps + 1,) the quintic rise from 0 to 1 in so many steps."""
    return smooth(np.arange(steps + 1) / steps)

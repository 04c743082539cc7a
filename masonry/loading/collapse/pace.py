"""How slowly a load that goes to and fro is brought on: so that damping takes hardly any of its work."""

import numpy as np

from masonry.loading.collapse.growing_settings import GrowingSettings
from masonry.runtime.state_file import Remembering


class Pace(Remembering):
    """Times by which increments take longer than they would, from what damping took of those before: that falls as they
    take longer."""

    REMEMBERED = ("slower", "work", "increments")

    def __init__(self, accuracy: float, settings: GrowingSettings) -> None:
        self.accuracy, self.settings = accuracy, settings
        self.slower, self.work, self.increments = 1.0, 0.0, 0

    def learn(self, work: float, damped: float) -> None:
        """Of an increment after which the specimen rests: the work of all loads and what damping took (J)."""
        self.work, self.increments = self.work + abs(work), self.increments + 1
        aim = self.settings.damped * self.accuracy * self.work / self.increments
        change = np.clip(damped / max(aim, 1e-300), self.settings.hastens, self.settings.slows)
        self.slower = float(np.clip(self.slower * change, 1.0, self.settings.slowest))

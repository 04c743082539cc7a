"""The servo that leads a gauge: it gives the factor by which the gauge goes on at a steady acceleration."""

from math import sqrt

import numpy as np

from masonry.loading.collapse.growing_settings import FallingSettings
from masonry.loading.collapse.led_gauge import LedGauge
from masonry.runtime.state_file import Remembering


class Servo(Remembering):
    """The factor of the load, look by look (branch.py has the equations).

    aim       share of the collapse factor that the motion may take     most  the greatest factor that the scene allows
    gain      m/s2, of the gauge for each unit of the factor     rate  1/s, of the servo     scale  the collapse factor
    speed     m/s, of the gauge     target, pace  m and m/s, where it is led now
    balance   the factor of equilibrium, as far as it is known     factor, earlier  at the end of the next look, and now
    leaping   whether the specimen leaps ahead     leaps  how often it did
    """

    REMEMBERED = (
        *("gain", "rate", "scale", "speed", "target", "pace"),
        *("balance", "factor", "earlier", "leaping", "leaps"),
    )

    def __init__(self, aim: float, most: float, settings: FallingSettings) -> None:
        self.aim, self.most, self.settings = aim, most, settings
        self.gain = self.rate = self.scale = self.speed = self.target = self.pace = 0.0
        self.balance = self.factor = self.earlier = 0.0
        self.leaping, self.leaps = False, 0

    @property
    def runs_away(self) -> bool:
        """Whether the gauge is faster than it is led."""
        return self.speed > self.settings.runs * self.pace

    def begin(self, stands: float, falls: float) -> None:
        """Set out from the greatest factor that was borne, below the least that was not."""
        self.scale, self.balance, self.factor, self.earlier = falls, stands, stands, stands

    def steer(self, gauge: LedGauge, rises: float, passed: float, off: float) -> None:
        """The factor at the end of the next look. `rises`: how much faster the gauge became (m/s2) in the time (s) that
        has `passed`, by which the factor was more than equilibrium needs; off: share of the collapse factor that motion
        took. Where the specimen leaps ahead, the gauge is led on from there."""
        settings, row, travel = self.settings, gauge.span / self.settings.rows, gauge.travel
        most = min(self.aim * self.scale * self.gain, 2.0 * gauge.span * (self.rate / settings.least) ** 2)
        faster = most * float(np.clip(settings.rough - off / self.aim, -1.0, 1.0))
        self.pace = max(self.pace + faster * passed, min(self.pace, sqrt(most * row)))
        self.target += self.pace * passed
        leaping = travel > self.target + row and self.runs_away
        self.leaps += leaping and not self.leaping
        if leaping:
            self.target = travel - row
        self.leaping = leaping
        lags = self.rate**2 * (self.target - travel)
        balance = 0.5 * (self.factor + self.earlier) + (settings.integral * lags - rises) / self.gain
        self.balance += self.rate * passed * (balance - self.balance)
        pushes = faster + 2.0 * self.rate * (self.pace - self.speed) + lags
        self.earlier = self.factor
        self.factor = float(np.clip(self.balance + pushes / self.gain, 0.0, self.most))

"""Where drives go: legs between turning points, and places over steps."""

from math import ceil

import numpy as np

from masonry.errors import SceneError
from masonry.loading.plans import Program, rise, smooth

FASTEST = 1.875
"""The greatest slope of the quintic passage between two turning points, over its mean."""
STILL = 1e-12
"""Of the farthest place: a drive that moves by less in a step stands still."""


class Path:
    """The way of a drive that is paced by its error, leg by leg: to its displacement, or from turn to turn (m, signed).

    begin, end, sign  of the leg that the drive is on; goal: its length, and `moved`, how much of it is made (m)
    """

    REMEMBERED = ("leg", "passed", "goal", "moved", "begin", "end", "sign")

    def __init__(self, places: tuple[float, ...]) -> None:
        self.places = places
        self.whole = float(np.abs(np.diff(places, prepend=0.0)).sum())
        self.leg, self.passed, self.goal, self.end = -1, 0.0, 0.0, 0.0
        self.turn()

    def turn(self) -> bool:
        """Set out for the next place; False where there is none."""
        if self.leg + 1 >= len(self.places):
            return False
        self.leg += 1
        self.passed += self.goal
        self.begin, self.end, self.moved = self.end, self.places[self.leg], 0.0
        self.goal, self.sign = abs(self.end - self.begin), -1.0 if self.end < self.begin else 1.0
        return True

    @property
    def left(self) -> float:
        """Of this leg, m."""
        return self.goal - self.moved

    @property
    def place(self) -> float:
        """Where the drive is, m, signed."""
        return self.begin + self.sign * self.moved

    @property
    def progress(self) -> float:
        """Share of the whole way."""
        return min((self.passed + self.moved) / self.whole, 1.0)


def followed(dt: float, settle: int, places: np.ndarray, varying: np.ndarray | None = None) -> Program:
    """Dead loads rise over the first half of `settle`; then the drive comes to places (n,) m, signed, one a step.

    varying  (H, settle + n + 1) share of each varying load, at each step
    The first step starts at rest and moves nothing, so `places` begins with 0.
    """
    count = len(places)
    speed = np.zeros(settle + count + 1)
    speed[settle + 1 : -1] = np.diff(places) / dt
    return Program(rise(settle, settle + count), speed, settle, 0, varying, settle + 1 + landmarks(places))


def landmarks(places: np.ndarray) -> np.ndarray:
    """Which of places (n,) rows must not miss: those where the drive turns, and both between which it crosses its
    start. Changes that are rounding count for nothing."""
    made = np.diff(places)
    moving = np.flatnonzero(np.abs(made) > STILL * float(np.abs(places).max()))
    reversal = np.flatnonzero(made[moving[1:]] * made[moving[:-1]] < 0.0)
    crossed = np.flatnonzero((places[1:] > 0.0) != (places[:-1] > 0.0))
    return np.unique(np.concatenate([moving[reversal + 1], moving[reversal] + 1, crossed, crossed + 1]))


def passage(reversals: tuple[float, ...], steps: int) -> np.ndarray:
    """(steps,) m: from 0 through the turning points, at rest at each, by quintics; steps shared out by the lengths."""
    stops = np.array([0.0, *reversals])
    lengths = np.abs(np.diff(stops))
    at = np.round(np.concatenate([[0.0], np.cumsum(lengths)]) / lengths.sum() * (steps - 1))
    if np.any(np.diff(at) < 1.0):
        raise SceneError(
            f"drive: {steps} steps are too few for {len(reversals)} turning points; give more, or a lower rate"
        )
    k = np.arange(steps)
    leg = np.minimum(np.searchsorted(at, k, side="right"), len(lengths)) - 1
    fraction = smooth((k - at[leg]) / (at[leg + 1] - at[leg]))
    places: np.ndarray = (1.0 - fraction) * stops[leg] + fraction * stops[leg + 1]
    return places


def steps_at(rate: float, dt: float, reversals: tuple[float, ...]) -> int:
    """Steps of a passage whose greatest velocity is `rate` (m/s)."""
    travel = float(np.abs(np.diff(reversals, prepend=0.0)).sum())
    return 1 + ceil(min(FASTEST * travel / (rate * dt), 1e18))

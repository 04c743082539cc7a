"""The path of a load's factor, leg by leg."""

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import NamedTuple

import numpy as np


class Leg(NamedTuple):
    """A part of the path of a load's factor, from one value to another."""

    start: float
    end: float

    @property
    def length(self) -> float:
        return abs(self.end - self.start)

    def at(self, passed: float) -> float:
        """The factor behind so much of the leg."""
        if passed >= self.length:
            return self.end
        return self.start + (passed if self.end > self.start else -passed)


@dataclass(frozen=True)
class FactorPath:
    """Where the factor of a load goes, to an accuracy: up to `most`, or to turns one after the other.

    reversals  factors to which the load goes, in place of growing up to `most`
    tilts      whether the factor is the tangent of the angle by which gravity turns: two loads, see `load_factors`
    """

    accuracy: float
    most: float
    reversals: tuple[float, ...] = ()
    tilts: bool = False

    @cached_property
    def legs(self) -> tuple[Leg, ...]:
        """From turn to turn."""
        return tuple(Leg(start, end) for start, end in pairwise((0.0, *(self.reversals or (self.most,)))))

    @property
    def length(self) -> float:
        """The length of all legs."""
        return sum(leg.length for leg in self.legs)

    @property
    def span(self) -> float:
        """From the least factor on the path to the greatest."""
        return float(np.ptp([0.0, *(leg.end for leg in self.legs)]))

    def load_factors(self, factor: float) -> np.ndarray:
        """(H,) factors of the loads that vary; of a tilt those of the weight less 1, and of it turned by 90 degrees."""
        if not self.tilts:
            return np.array([factor])
        whole = float(np.hypot(1.0, factor))
        return np.array([1.0 / whole - 1.0, factor / whole])

    def slope(self, factor: float) -> np.ndarray:
        """(H,) by how much the load factors change per unit of the factor."""
        whole = float(np.hypot(1.0, factor))
        return np.array([-factor, 1.0]) / whole**3 if self.tilts else np.ones(1)

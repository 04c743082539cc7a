"""The spectra to which records are made: of Eurocode 8, of a table, and the power spectra of Kanai and Tajimi and of
Clough and Penzien."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np


@dataclass(frozen=True)
class Eurocode8:
    """The horizontal elastic spectrum of EN 1998-1:2004, 3.2.2.2.

    kind          1 or 2 (surface-wave magnitude above or below 5.5)
    soil          ground type A to E, tables 3.2 and 3.3
    acceleration  m/s^2, a_g, of rock (type A)
    damping       share of the critical damping
    """

    kind: int
    soil: str
    acceleration: float
    damping: float = 0.05

    PARAMETERS: ClassVar[dict[int, dict[str, tuple[float, float, float, float]]]] = {
        1: {
            "A": (1.0, 0.15, 0.4, 2.0),
            "B": (1.2, 0.15, 0.5, 2.0),
            "C": (1.15, 0.2, 0.6, 2.0),
            "D": (1.35, 0.2, 0.8, 2.0),
            "E": (1.4, 0.15, 0.5, 2.0),
        },
        2: {
            "A": (1.0, 0.05, 0.25, 1.2),
            "B": (1.35, 0.05, 0.25, 1.2),
            "C": (1.5, 0.1, 0.25, 1.2),
            "D": (1.8, 0.1, 0.3, 1.2),
            "E": (1.6, 0.05, 0.25, 1.2),
        },
    }
    """Soil factor S, and the periods T_B, T_C, T_D (s)."""

    def at(self, periods: np.ndarray) -> np.ndarray:
        """(n,) m/s^2, pseudo-accelerations at periods (n,) s; beyond 4 s, where the code ends, as before."""
        factor, first, second, third = self.PARAMETERS[self.kind][self.soil]
        top = 2.5 * max(0.55, float(np.sqrt(10.0 / (5.0 + 100.0 * self.damping))))
        rising = 1.0 + periods / first * (top - 1.0)
        with np.errstate(divide="ignore"):
            falling = top * second / periods * np.minimum(1.0, third / periods)
        shape = np.where(periods < first, rising, np.where(periods <= second, top, falling))
        spectrum: np.ndarray = self.acceleration * factor * shape
        return spectrum


@dataclass(frozen=True)
class TableSpectrum:
    """Periods (s, growing, above 0) and pseudo-accelerations (m/s^2), straight between them where both are logarithms;
    before the first and after the last the acceleration of that one."""

    periods: Sequence[float]
    accelerations: Sequence[float]
    damping: float = 0.05

    def at(self, periods: np.ndarray) -> np.ndarray:
        """(n,) m/s^2, pseudo-accelerations at periods (n,) s above 0."""
        table = np.log(self.periods), np.log(self.accelerations)
        spectrum: np.ndarray = np.exp(np.interp(np.log(periods), *table))
        return spectrum


@dataclass(frozen=True)
class FilteredNoise:
    """White noise of the rock after one oscillator, the soil (Kanai 1957, Tajimi 1960), and after a second one, which
    takes away what is slow (Clough and Penzien 1975). Only its shape is said, not its size.

    soil    rate (rad/s) and damping of the soil
    filter  rate and damping of the second one; None: Kanai and Tajimi
    """

    soil: tuple[float, float]
    filter: tuple[float, float] | None = None

    def power(self, rates: np.ndarray) -> np.ndarray:
        """(n,) power of the acceleration at rates (n,) rad/s, that of the rock being 1."""
        ratio, damping = rates / self.soil[0], self.soil[1]
        power: np.ndarray = (1.0 + (2.0 * damping * ratio) ** 2) / (
            (1.0 - ratio**2) ** 2 + (2.0 * damping * ratio) ** 2
        )
        if self.filter is not None:
            ratio, damping = rates / self.filter[0], self.filter[1]
            power = power * ratio**4 / ((1.0 - ratio**2) ** 2 + (2.0 * damping * ratio) ** 2)
        return power

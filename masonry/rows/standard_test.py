"""Results of standard tests from the curve: strength, and the modulus between rest and a third of the largest force."""

from math import sqrt
from typing import NamedTuple

import numpy as np


class StandardNumbers(NamedTuple):
    """Strength and modulus (Pa), and the strain at a third of the largest force: None where it is not reached."""

    strength: float
    modulus: float | None
    strain: float | None


def compression(force: np.ndarray, shortening: np.ndarray, area: float, length: float) -> StandardNumbers:
    """EN 1052-1: f = F/A, and E = F / (3 e A) with the strain e at a third of the largest force F.

    force (n,) N, shortening (n,) m over a length (m), from where the test begins; area in m2.
    """
    return _results(force / area, shortening / length)


def diagonal_compression(
    force: np.ndarray, shortening: np.ndarray, extension: np.ndarray, area: float, length: float
) -> StandardNumbers:
    """ASTM E519: the shear stress S = P / (sqrt(2) A), the shear strain g = (DV + DH) / length, and G = S/g at a third
    of the largest force P.

    shortening, extension (n,) m along the diagonal that is pressed and across; area (w + h)/2 t, m2
    """
    return _results(force / (sqrt(2.0) * area), (shortening + extension) / length)


def _results(stress: np.ndarray, strain: np.ndarray) -> StandardNumbers:
    top = int(np.argmax(stress))
    strength, stress, strain = float(stress[top]), stress[: top + 1] - stress[0], strain[: top + 1] - strain[0]
    third = stress[-1] / 3.0
    k = int(np.argmax(stress >= third))
    if k == 0:
        return StandardNumbers(strength, None, None)
    at_third = float(np.interp(third, stress[k - 1 : k + 1], strain[k - 1 : k + 1]))
    return StandardNumbers(strength, float(third / at_third) if at_third > 0.0 else None, at_third)

"""A box divided into a regular grid of boxes."""

from collections.abc import Sequence

import numpy as np


def divide(low: Sequence[float], high: Sequence[float], divisions: Sequence[int]) -> tuple[np.ndarray, np.ndarray]:
    """Low and high corners (n, 3) of the nx x ny x nz cells of the box low..high, x running fastest.

    Neighbours get exactly the same coordinates on their common face.
    """
    cuts = [np.linspace(a, b, n + 1) for a, b, n in zip(low, high, divisions, strict=True)]
    k, j, i = (index.ravel() for index in np.indices(tuple(divisions)[::-1]))
    lows = np.stack([cuts[0][i], cuts[1][j], cuts[2][k]], axis=1)
    highs = np.stack([cuts[0][i + 1], cuts[1][j + 1], cuts[2][k + 1]], axis=1)
    return lows, highs

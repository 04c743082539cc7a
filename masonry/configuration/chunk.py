"""Some steps that are taken without a look at them."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Chunk:
    """Some steps: share of the dead load (n + 1,) and speed of the drive (n + 1,) m/s, before and after each step.

    row    whether a row of the history is due after it
    place  m, signed: where the drive is after it, if that is known better than the sum of the speeds
    """

    dead_load: np.ndarray
    speed: np.ndarray
    row: bool
    place: float | None = None

    @property
    def steps(self) -> int:
        return len(self.speed) - 1

"""The motion that all supports of a specimen share."""

from dataclasses import dataclass

import numpy as np

from masonry.ground.ground_motion import Motion
from masonry.rows.columns import GROUND


@dataclass(frozen=True)
class UniformGround:
    """The motion that all supports share; times (n,) s are those since the settling.

    motions   by axis, "x", "y", "z"
    begin     s, from the end of the settling to when it begins
    is_moved  whether supports are moved; else the run sees it from the ground
    """

    motions: dict[str, Motion]
    begin: float
    is_moved: bool

    def displacement(self, axis: int, time: np.ndarray) -> np.ndarray:
        """(n,) m along an axis (0, 1, 2)."""
        motion = self.motions.get("xyz"[axis])
        return np.zeros(len(time)) if motion is None else motion.displacement_at(time - self.begin)

    def velocity(self, axis: int, time: np.ndarray) -> np.ndarray:
        """(n,) m/s."""
        motion = self.motions.get("xyz"[axis])
        return np.zeros(len(time)) if motion is None else motion.velocity_at(time - self.begin)

    def accelerations(self, time: np.ndarray) -> dict[str, np.ndarray]:
        """By column, (n,) m/s2 along each axis on which it moves."""
        return {GROUND[axis]: motion.acceleration_at(time - self.begin) for axis, motion in self.motions.items()}

"""Joints of a page: a tile for each contact point, or, of many, for each joint as a whole."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from geometry.blocks import Joints
from geometry.joints.tributary_areas import tiles

MOST_TILES = 20_000
"""Contact points beyond which a page shows whole joints: with more it takes seconds to move to another frame."""


@dataclass(frozen=True)
class JointTiles:
    """T tiles of the joints of a specimen.

    joints  all contact points (C,)
    whole   whether a tile is a joint, and not what one contact point stands for
    """

    joints: Joints
    whole: bool

    @classmethod
    def of(cls, joints: Joints) -> "JointTiles":
        """A tile for each contact point, as long as these are no more than MOST_TILES."""
        return cls(joints, len(joints.area) > MOST_TILES)

    @cached_property
    def first(self) -> np.ndarray:
        """(T,) a contact point of each tile: what is the same for all of a tile is that one's."""
        return np.unique(self.joints.patch, return_index=True)[1] if self.whole else np.arange(len(self.joints.area))

    @cached_property
    def owner(self) -> np.ndarray:
        """(C,) the tile of each contact point."""
        return np.unique(self.joints.patch, return_inverse=True)[1] if self.whole else self.first

    @cached_property
    def area(self) -> np.ndarray:
        """(T,) m2."""
        return np.bincount(self.owner, self.joints.area, len(self.first))

    @cached_property
    def corners(self) -> tuple[np.ndarray, np.ndarray]:
        """Where the corners of each tile begin (T + 1,), and these (., 3) m."""
        if not self.whole:
            return tiles(self.joints)
        return self.joints.patch_start, self.joints.patch_points

    def mean(self, values: np.ndarray) -> np.ndarray:
        """(T, ...) of values (C, ...) by area."""
        if not self.whole:
            return values
        weights = self.joints.area.reshape(-1, *[1] * (values.ndim - 1))
        total = np.zeros((len(self.first), *values.shape[1:]))
        np.add.at(total, self.owner, weights * values)
        return total / self.area.reshape(-1, *[1] * (values.ndim - 1))

    def largest(self, values: np.ndarray) -> np.ndarray:
        """(T,) of values (C,) of one sign."""
        if not self.whole:
            return values
        largest = np.zeros(len(self.first))
        np.maximum.at(largest, self.owner, values)
        return largest

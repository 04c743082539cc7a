"""Blocks of one strain: in small displacement, and turning and deforming as far as they like."""

import numpy as np

from geometry.jit_cache import compiled
from masonry.configuration.parts.part import MovingPart, Strain
from masonry.kinematics import affine, deforming
from masonry.kinematics.matrices import rotation_angles, rotations


@compiled
def deform_corners(q, axes, row, arm, moved):
    """Write the displacements (p, 3) m of points of rows (p,) with arms (p, 3) m; axes (b, 3, 3) at the start."""
    for p in range(len(row)):
        b = row[p]
        for i in range(3):
            stretch = 0.0
            for k in range(3):
                for j in range(3):
                    stretch += q[b, 3 + 3 * i + j] * axes[b, k, j] * arm[p, k]
            moved[p, i] = q[b, i] + stretch


class AffinePart(MovingPart):
    """Blocks of a small strain and rotation."""

    def strain(self, stress: np.ndarray) -> Strain:
        return Strain(affine.observe(self.body, stress))

    def moved_corners(self, row: np.ndarray, arm: np.ndarray) -> np.ndarray:
        moved = np.empty(arm.shape)
        deform_corners(self.body.q, self._axes, row, arm, moved)
        return moved

    def rotations(self) -> np.ndarray:
        h = np.einsum("bij,bkj->bik", self.body.q[:, 3:].reshape(-1, 3, 3), self.layout.axes[self.blocks])
        return (0.5 * np.abs(h - h.transpose(0, 2, 1))).reshape(-1, 9)

    def turns_about(self) -> np.ndarray:
        turns = np.any(self.free[:, 3:], axis=1)
        return np.asarray(turns[:, None, None] * np.eye(3))


class DeformingPart(AffinePart):
    """Blocks with a deformation gradient."""

    def strain(self, stress: np.ndarray) -> Strain:
        return Strain(*deforming.observe(self.body, stress))

    @property
    def place(self) -> np.ndarray:
        return np.asarray(self.layout.place[self.name] + self.body.q[:, :3])

    @property
    def axes(self) -> np.ndarray:
        return np.asarray(self.body.frame @ self.layout.axes[self.blocks])

    def rotations(self) -> np.ndarray:
        return rotation_angles(rotations(self.body.frame))[:, None]

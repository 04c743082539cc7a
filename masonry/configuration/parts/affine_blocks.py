"""Blocks of one strain: in small displacement, and turning and deforming as far as they like."""

import numpy as np

from masonry.configuration.parts.part import MovingPart, Strain
from masonry.kinematics import affine, deforming
from masonry.kinematics.matrices import rotation_angles, rotations


class AffinePart(MovingPart):
    """Blocks of a small strain and rotation."""

    def strain(self, stress: np.ndarray) -> Strain:
        return Strain(affine.observe(self.body, stress))

    def moved_corners(self, row: np.ndarray, arm: np.ndarray) -> np.ndarray:
        h = self.body.q[row, 3:].reshape(-1, 3, 3)
        axes = self.layout.axes[self.blocks[row]]
        return np.asarray(self.body.q[row, :3] + np.einsum("cij,ckj,ck->ci", h, axes, arm))

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

"""Blocks of tets, whose dofs are those of nodes: in small displacement, and deforming as far as they like."""

import numpy as np

from masonry.configuration.parts.part import MovingPart, Rows, Strain
from masonry.kinematics import deforming_tets, tets
from masonry.kinematics.matrices import rotation_angles, rotations


class TetPart(MovingPart):
    """Blocks of small strains and rotations."""

    def saved_displacements(self, saved: dict[str, np.ndarray]) -> np.ndarray:
        return saved["u"][: len(self.body.v)]

    def strain(self, stress: np.ndarray) -> Strain:
        return Strain(tets.observe(self.body, self.model.u, stress))

    def moments(self, rows: Rows, forces: np.ndarray) -> np.ndarray:
        return np.zeros((len(forces), 3))

    def rotations(self) -> np.ndarray:
        mean = np.zeros((len(self.blocks), 3))
        tets.mean_rotation(self.body, self.model.u, mean)
        return np.abs(mean)

    def turns_about(self) -> np.ndarray:
        return np.tile(np.eye(3), (len(self.blocks), 1, 1))


class DeformingTetPart(TetPart):
    """Blocks whose tets have deformation gradients."""

    def strain(self, stress: np.ndarray) -> Strain:
        return Strain(*deforming_tets.observe(self.body, self.model.u, stress))

    @property
    def place(self) -> np.ndarray:
        return np.asarray(self.layout.place[self.name] + self.displacements)

    def rotations(self) -> np.ndarray:
        return rotation_angles(rotations(self.body.frame))[:, None]

"""Interface of a kind of displacement: the one place that asks for it is `configuration_of`.

How bodies move and what they hold is asked of parts (parts/parts.py); here stands what differs in the contacts, in the
step, and in what may be trusted.
"""

from typing import Protocol

import numpy as np

from masonry.configuration.chunk import Chunk
from masonry.configuration.large import LargeDisplacement
from masonry.configuration.small import SmallDisplacement
from masonry.elements.element import Elements
from masonry.elements.joints.joint_crushing import JointCrushing
from masonry.elements.joints.joint_patches import NoPatches
from masonry.jit.compiled_parts import StepCalls
from masonry.model.model import Model


class Configuration(Protocol):
    """A model in small displacement or in large.

    any_size  whether blocks may turn, fall and meet others as they like; else displacements are linear in rotations,
              and contacts stay those of the undeformed shape
    crushing  what answers for joints that crush, and for those that do not; patches, for those by which blocks meet
    of_joints elements of joints that took something for good, in the order in which it is added up
    leap      share of the smallest block by which a dof that moves in one step is no motion but an instability
    """

    any_size: bool
    crushing: JointCrushing
    patches: NoPatches
    of_joints: Elements
    leap: float

    def advance(self, chunk: Chunk, threads: int, first: int, steps: int, drive_force: np.ndarray) -> None:
        """Take some compiled steps of a chunk; drive_force (steps,) N out, after each. Raises Stopped."""

    def program(self, threads: int, shared: np.ndarray) -> StepCalls:
        """The parts of a step; `shared` as of kinematics/shared.py."""

    def after_row(self) -> None:
        """Changes between rows: bonds that have nothing left retire."""

    def look_at_contacts(self, seen: np.ndarray) -> float:
        """Fill seen (4, C): opening and slip (m), normal and shear stress (Pa); return the stored energy (J)."""

    def joint_forces(self) -> np.ndarray:
        """(C, 3) N on side a of each joint of the undeformed shape, as seen from the blocks where they turn."""

    def forces_on_blocks(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """All that acts between blocks now: the block (K,), the force (3, K) N on it, and its arm (3, K) m from the
        centroid."""

    def forces_of_pairs(self) -> tuple[np.ndarray, np.ndarray]:
        """Two blocks (K, 2) and the force (K, 3) N between them now, of each joint and each patch."""

    def pressed(self) -> np.ndarray:
        """(B,) N, sums of all components of all forces at each block's contacts."""

    def stiffness(self) -> np.ndarray:
        """(B,) N/m, normal stiffness of all contacts of each block now."""

    def rounding(self, kinetic: float) -> float:
        """N: forces below tell of the rounding of velocities alone; kinetic, the largest energy (J)."""

    def advice(self, leap: float) -> str:
        """Advice where something leaps by more than `leap` (m) in a step within its proven bound."""

    def written(self) -> dict[str, np.ndarray]:
        """By name, each array that steps, the guide or a row write."""

    def make_room_for(self, saved: dict[str, np.ndarray]) -> None:
        """As much room as a run had whose arrays were kept (`written`)."""


def configuration_of(model: Model) -> Configuration:
    """Configuration that answers for the displacements of a model: one for as long as these are of one kind."""
    large = model.large
    if model.configuration is None or model.configuration[0] is not large:
        model.configuration = large, SmallDisplacement(model) if large is None else LargeDisplacement(model, large)
    answering: Configuration = model.configuration[1]
    return answering

"""Where a wallette cracked, from a frame of its run: through what, how straight, and what the crack still carries."""

from dataclasses import dataclass

import numpy as np

from geometry.blocks import Blocks
from masonry.laboratory.result import Result
from masonry.rows.history import Frame

BROKEN = 0.95
"""Damage from which a contact counts as broken, as in summary.json."""
FACES_X = 0.5
"""A joint is a head joint where its normal makes a larger cosine than this with the length of the wall."""


@dataclass(frozen=True)
class CrackPath:
    """The contacts of a wallette at one moment, by what they are, and which of them are broken.

    point, normal        (C, 3) m and 1             area           (C,) m2
    head, bed, unit      (C,) whether a contact lies in a head joint, in a bed joint, within a unit
    broken               (C,) whether it is        frame          the moment
    section              m2 of the wall             middle         (C,) m, x of the middle of the unit it lies within
    """

    point: np.ndarray
    normal: np.ndarray
    area: np.ndarray
    head: np.ndarray
    bed: np.ndarray
    unit: np.ndarray
    broken: np.ndarray
    frame: Frame
    section: float
    middle: np.ndarray

    def sections(self) -> float:
        """Broken area seen along the wall, over its section: 1 is one crack through the whole height."""
        return self._facing(self.broken)

    def fractions(self) -> dict[str, float]:
        """Broken area seen along the wall by what it goes through, over the section; beds are seen from below."""
        along = {"head joints": self.head, "units": self.unit}
        fractions = {name: self._facing(self.broken & kind) for name, kind in along.items()}
        return fractions | {"bed joints": float(self.area[self.broken & self.bed].sum() / self.section)}

    def place(self) -> tuple[float, float]:
        """(middle, spread) m along the wall of what opened: mean and standard deviation of x by opened volume.

        Contacts that slid or that closed again do not count. Raises ValueError where nothing is open.
        """
        weight = self.area * np.where(self.broken, np.maximum(self.frame.opening, 0.0), 0.0)
        if weight.sum() <= 0.0:
            raise ValueError("nothing is broken and open, so no crack has a place")
        x = self.point[:, 0]
        mean = float(np.average(x, weights=weight))
        return mean, float(np.sqrt(np.average((x - mean) ** 2, weights=weight)))

    def off_mid_length(self) -> float:
        """Mean distance (m) along the wall of what is broken within units from the middle of its unit; nan if none."""
        chosen = self.broken & self.unit
        distance = np.abs(self.point[chosen, 0] - self.middle[chosen])
        return float(np.average(distance, weights=self.area[chosen])) if chosen.any() else np.nan

    def head_joint_slip(self) -> float:
        """Largest slip at a broken head joint over the largest opening there; nan where none is broken."""
        chosen = self.broken & self.head
        return float(self.frame.slip[chosen].max() / self.frame.opening[chosen].max()) if chosen.any() else np.nan

    def stress_carried(self, kind: np.ndarray) -> float:
        """Stress (Pa) on the section of the wall that the shear of broken contacts of a kind adds up to at most."""
        chosen = self.broken & kind
        return float(np.abs(self.frame.shear_stress[chosen]) @ self.area[chosen] / self.section)

    def _facing(self, chosen: np.ndarray) -> float:
        return float(self.area[chosen] @ np.abs(self.normal[chosen, 0]) / self.section)


def crack_path(result: Result, frame: Frame | None = None) -> CrackPath:
    """The cracks of a wallette's run at a frame, the last one where none is given."""
    frame = result.history.frames[-1] if frame is None else frame
    joints, blocks = result.joints, result.specimen.blocks
    kind = np.array(result.joint_groups)[result.joint_group]
    along = np.abs(joints.normal[:, 0]) > FACES_X
    return CrackPath(
        point=joints.point,
        normal=joints.normal,
        area=joints.area,
        head=(kind == "unit_unit") & along,
        bed=(kind == "unit_unit") & ~along,
        unit=kind == "within_units",
        broken=(frame.damage >= BROKEN) & (kind != "plate"),
        frame=frame,
        section=result.specimen.section,
        middle=unit_middles(blocks.points, blocks.face_points, corner_units(blocks))[blocks.unit[joints.block_a]],
    )


def corner_units(blocks: Blocks) -> np.ndarray:
    """The unit that each entry of face_points belongs to."""
    return np.repeat(blocks.unit[blocks.face_block()], np.diff(blocks.face_start))


def unit_middles(points: np.ndarray, corner: np.ndarray, unit: np.ndarray) -> np.ndarray:
    """(U,) m, x half-way between the two ends of each unit, from its corners and the unit of each."""
    low, high = np.full(unit.max() + 1, np.inf), np.full(unit.max() + 1, -np.inf)
    np.minimum.at(low, unit, points[corner, 0])
    np.maximum.at(high, unit, points[corner, 0])
    return np.asarray(0.5 * (low + high))

"""How a wall cracked in horizontal bending: round its units, through them in a straight line, or both."""

from dataclasses import dataclass, replace

import numpy as np

from masonry.laboratory.result import Result
from masonry.scene.tables.specimen import BendingSpec
from verification.paper.walls.crack_path import CrackPath, crack_path

CRACKED = 0.5
"""A course counts as cracked where this share of its section is broken within units."""


@dataclass(frozen=True)
class FlexuralCrack:
    """The crack at the end of a run.

    courses  (n,) per course, area broken within units, seen along the wall, over the course's section
    fractions  broken area over the section of the wall: of head joints, units (both seen along the wall), bed joints
    opened   share of the broken area of head joints that lost more by tension than by shear
    """

    courses: np.ndarray
    fractions: dict[str, float]
    opened: float

    @property
    def through(self) -> int:
        """Courses that are cracked through a unit."""
        return int(np.sum(self.courses > CRACKED))

    @property
    def unit_fraction(self) -> float:
        """Of the broken area of head joints and units, that within units: 0 stepped, about a half straight."""
        along = self.fractions["units"] + self.fractions["head joints"]
        return self.fractions["units"] / along if along > 0.0 else 0.0

    @property
    def word(self) -> str:
        """ "stepped": round all units; "straight": through a unit in every other course; "mixed" between."""
        half = len(self.courses) // 2
        return "stepped" if self.through == 0 else "mixed" if self.through < half else "straight"

    def sentence(self) -> str:
        """The pattern with its numbers."""
        beds = self.fractions["bed joints"]
        return (
            f"{self.word}: units cracked in {self.through} of {len(self.courses)} courses, "
            f"{100 * self.unit_fraction:.0f} % of the broken section within units, broken bed joints {beds:.2f} "
            "sections"
        )


def flexural_crack(result: Result, spec: BendingSpec) -> FlexuralCrack:
    """The crack of a run of a bending scene with this specimen."""
    course = spec.unit_height + spec.joint_thickness
    path: CrackPath = replace(crack_path(result), section=spec.courses * course * spec.thickness)
    number = np.clip((path.point[:, 2] / course).astype(int), 0, spec.courses - 1)
    along = np.where(path.broken & path.unit, path.area * np.abs(path.normal[:, 0]), 0.0)
    frame, head = path.frame, path.broken & path.head
    led = frame.damage_tension[head] >= frame.damage_shear[head]
    area = path.area[head]
    return FlexuralCrack(
        np.bincount(number, along, spec.courses) / (course * spec.thickness),
        path.fractions(),
        float(area[led].sum() / area.sum()) if area.size else 0.0,
    )

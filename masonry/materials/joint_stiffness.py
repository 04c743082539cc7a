"""Stiffness of a bed joint without thickness, so that a course shortens as units and mortar do (docs/stiffness.md)."""

from typing import NamedTuple

STIFF_JOINT = 10.0
"""A joint that should add nothing is so many times as stiff as a course of units."""


class MasonryCourse(NamedTuple):
    """A unit and a joint: their height in m and by how much they shorten, m/Pa; modulus of the units in Pa or None."""

    height: float
    compliance: float
    unit_modulus: float | None

    @property
    def modulus(self) -> float:
        """Of the masonry across its bed joints, Pa."""
        return self.height / self.compliance


def course_of_parts(
    unit_height: float, joint: float, unit_modulus: float, mortar_modulus: float | None
) -> MasonryCourse:
    """From heights (m) and moduli (Pa) of units and mortar."""
    mortar = joint / mortar_modulus if joint and mortar_modulus else 0.0
    return MasonryCourse(unit_height + joint, unit_height / unit_modulus + mortar, unit_modulus)


class JointStiffness(NamedTuple):
    """Normal stiffnesses in Pa/m of bed joints and of contacts within units; None where there are none of these.

    is_bounded  whether units and their contacts shorten as much as the course or more: the joint is then ten times as
                stiff as a course of units, and the course is softer than asked
    """

    bed: float
    within: float | None
    is_bounded: bool

    def modulus(self, course: MasonryCourse, divisions: int, deforms: bool) -> float:
        """Of a stack of such courses in the model, Pa."""
        blocks = course.height / course.unit_modulus if deforms and course.unit_modulus else 0.0
        inner = (divisions - 1) / self.within if self.within else 0.0
        return course.height / (1.0 / self.bed + blocks + inner)


def joint_stiffness(course: MasonryCourse, divisions: int = 1, deforms: bool = False) -> JointStiffness:
    """Of courses whose units are `divisions` blocks high, rigid ones or such that deform with the units' modulus.

    Raises ValueError where the modulus of the units is needed and not there.
    """
    if (deforms or divisions > 1) and course.unit_modulus is None:
        raise ValueError("the modulus of the units is needed")
    within, left = None, course.compliance
    if deforms and course.unit_modulus:
        left -= course.height / course.unit_modulus
    elif divisions > 1 and course.unit_modulus:
        within = divisions * course.unit_modulus / course.height
        left -= (divisions - 1) / within
    is_bounded = left <= 1e-9 * course.compliance
    if is_bounded:
        bed = STIFF_JOINT * (course.unit_modulus or 0.0) / course.height
    elif deforms:
        bed = (1.0 + (divisions - 1) / STIFF_JOINT) / left
    else:
        bed = 1.0 / left
    if deforms and divisions > 1:
        within = STIFF_JOINT * bed
    return JointStiffness(bed, within, is_bounded)

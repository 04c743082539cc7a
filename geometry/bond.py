"""Running bond: courses of whole units, half a unit apart, in expanded units.

An expanded unit is as long as the unit and one joint together (its module), so that joints have no thickness.
"""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Bond:
    """Modules of a wall in running bond.

    low, high  (U, 3) m, corners of each module, course by course from below, left to right
    course     (U,) counted from 0
    half       (U,) whether it is a half unit
    length     of the wall, m          height  of the wall, m
    """

    low: np.ndarray
    high: np.ndarray
    course: np.ndarray
    half: np.ndarray
    length: float
    height: float


def running_bond(
    courses: int, units_per_course: int, module_length: float, module_height: float, thickness: float
) -> Bond:
    """Courses 1, 3, ... of whole units; courses 2, 4, ... begin and end with half a unit."""
    left, right, course = [], [], []
    ends = 2 * units_per_course
    for c in range(courses):
        cuts = [0, *range(1, ends, 2), ends] if c % 2 else list(range(0, ends + 1, 2))
        left += cuts[:-1]
        right += cuts[1:]
        course += [c] * (len(cuts) - 1)
    row = np.array(course)
    zero = np.zeros(len(row))
    return Bond(
        low=np.stack([np.array(left) * module_length / 2, zero, row * module_height], axis=1),
        high=np.stack([np.array(right) * module_length / 2, zero + thickness, (row + 1) * module_height], axis=1),
        course=row,
        half=np.array(right) - np.array(left) == 1,
        length=units_per_course * module_length,
        height=courses * module_height,
    )

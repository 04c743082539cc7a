"""Bonds of masonry: how the units of a wall lie on each other, in expanded units.

An expanded unit is as large as the unit and one joint together (its module), so that joints have no thickness. Every
bond is written in parts, quarters of the length of a whole unit: S stretcher 4, H header 2, B half unit 2, q closer 1.
A header lies across the wall and shows its width, half of a stretcher. Courses alternate; each line is one, from below:

    running   |S   |S   |      header    |S |S |S |     (whole units are headers here; a part is a quarter of one)
              |B |S   |B |               |B|S |S |B|
    stack     |S   |S   |      english   |S   |S   |S   |     stretchers, then headers with closers beside the corners
              |S   |S   |                |H |q|H |H |H |q|H |
    flemish   |S   |H |S   |H |S   |                    each header stands in the middle of a stretcher
              |H |q|S   |H |S   |q|H |

Half a unit more in a course of running bond (2.5): |S   |S   |B | below |B |S   |S   |.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from geometry.blocks import GeometryError
from geometry.checks import require_counts

WHOLE = 4


@dataclass(frozen=True)
class Bond:
    """Modules of a wall.

    low, high  (U, 3) m, corners of each module, course by course from below, left to right
    course     (U,) counted from 0
    parts      (U,) length of each module in quarters of a whole unit
    length     of the wall, m          height  of the wall, m
    """

    low: np.ndarray
    high: np.ndarray
    course: np.ndarray
    parts: np.ndarray
    length: float
    height: float


def _running(units: float) -> tuple[list[int], list[int]]:
    whole = int(units)
    if units > whole:  # a half unit ends each course, now right, now left
        return [*[4] * whole, 2], [2, *[4] * whole]
    return [4] * whole, [2, *[4] * (whole - 1), 2]


def _stack(units: int) -> tuple[list[int], list[int]]:
    return [4] * units, [4] * units


def _english(units: int) -> tuple[list[int], list[int]]:
    return [4] * units, [2, 1, *[2] * (2 * units - 3), 1, 2]


def _flemish(units: int) -> tuple[list[int], list[int]]:
    return [4, *[2, 4] * (units - 1)], [2, 1, 4, *[2, 4] * (units - 2), 1, 2]


COURSES: dict[str, Callable[..., tuple[list[int], list[int]]]] = {
    "running": _running,
    "stack": _stack,
    "header": _running,
    "english": _english,
    "flemish": _flemish,
}
"""Parts of the courses 1, 3, ... and 2, 4, ... for so many whole units (flemish: stretchers of the first course)."""


def require_units(kind: str, bond: str, courses: int, units_per_course: float) -> None:
    """Whole numbers of courses and units, or in running bond half a unit more; else GeometryError."""
    half = bond == "running" and units_per_course > 1 and units_per_course % 1 == 0.5
    units = units_per_course + 0.5 if half else units_per_course
    require_counts(kind, "number of units", (units, courses), "xz")


def lay(
    name: str,
    courses: int,
    units_per_course: float,
    unit: tuple[float, float],
    joint: float,
    thickness: float,
    unit_width: float | None = None,
) -> Bond:
    """The modules of a wall in the bond `name`, a key of COURSES.

    unit        (length, height) m of a real unit, without joint         joint  thickness (m) of bed and head joints
    unit_width  m, needed where a bond has headers; in english and flemish bond two headers with the joint between them
                must be as long as a stretcher
    Raises GeometryError for an unknown bond and for units that do not fit it.
    """
    if name not in COURSES:
        raise GeometryError(f"bond '{name}' is unknown; allowed: {', '.join(COURSES)}")
    whole = (unit[0] if name != "header" else require_width(name, unit[0], joint, unit_width)) + joint
    if name in ("english", "flemish"):
        require_width(name, unit[0], joint, unit_width)
        if units_per_course < 2:
            raise GeometryError(f"bond '{name}' needs at least 2 units in a course, not {units_per_course}")
    module = unit[1] + joint
    laid = COURSES[name](units_per_course)
    parts = [np.array(laid[c % 2]) for c in range(courses)]
    end = np.concatenate([np.cumsum(p) for p in parts])
    part, row = np.concatenate(parts), np.repeat(np.arange(courses), [len(p) for p in parts])
    zero = np.zeros(len(row))
    return Bond(
        low=np.stack([(end - part) * (whole / WHOLE), zero, row * module], axis=1),
        high=np.stack([end * (whole / WHOLE), zero + thickness, (row + 1) * module], axis=1),
        course=row,
        parts=part,
        length=sum(laid[0]) * (whole / WHOLE),
        height=courses * module,
    )


def require_width(name: str, length: float, joint: float, width: float | None) -> float:
    """The width that a header shows, or GeometryError."""
    fitting = (length - joint) / 2
    if width is None:
        raise GeometryError(
            f"bond '{name}' has headers: unit_width is needed, {fitting:g} m for a unit of {length:g} m and its joint"
        )
    if name != "header" and not abs(width - fitting) <= 1e-6 * length:
        raise GeometryError(
            f"bond '{name}': unit_width is {width:g} m, but two headers and their joint must be as long as a stretcher "
            f"of {length:g} m; nearest: {fitting:g} m"
        )
    return width

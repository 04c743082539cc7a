"""The tower: four walls round a square, whose stones pass each other at the corners from course to course."""

import numpy as np

from geometry.blocks import GeometryError, Specimen
from geometry.checks import require_counts, require_lengths
from geometry.structures.gathering import Gathering


def tower(
    width: float, thickness: float, courses: int, unit_length: float, unit_height: float, base: float | None = None
) -> Specimen:
    """A hollow square tower from z = 0, the axis at x = y = 0, of stones as deep as its walls are thick.

    width, thickness  m, of the outside, and of each wall     courses  1 or more, of the height `unit_height` (m)
    unit_length       m, about: a wall of a course has a whole number of stones, or the nearest to it
    base              height (m) of a square block below

    In each course every wall begins at a corner of its own and ends at the next wall; the next course goes the other
    way round: stones lie across the joints of the corners, and joints between stones lie apart by half a stone.

    Sets "units", "front", "back", "left" and "right" (the walls), "top" (the uppermost course), "base". The section is
    that of the walls. Raises GeometryError for what cannot be built.
    """
    lengths = {"width": width, "thickness": thickness, "unit_length": unit_length, "unit_height": unit_height}
    require_lengths("tower", lengths | ({} if base is None else {"base": base}))
    require_counts("tower", "number of courses", (courses,), "z")
    if width <= 2.0 * thickness:
        raise GeometryError(f"tower: width is {width:g} m, it must be more than two walls of {thickness:g} m")
    built, side = Gathering(), width - thickness
    count = max(1, round(side / unit_length))
    for k in range(courses):
        shift = np.linspace(0.0, side, count + 1)
        if k % 2:  # half a stone off, with half ones at both ends
            shift = np.concatenate([[0.0], 0.5 * (shift[1:] + shift[:-1]), [side]])
        for wall, name in enumerate(("front", "right", "back", "left")):
            low, high = _stones(shift, width, thickness, wall, mirrored=bool(k % 2))
            heights = np.full(len(low), unit_height)
            corners = np.column_stack([low, k * heights]).tolist(), np.column_stack([high, (k + 1) * heights]).tolist()
            built.add_boxes(*corners, "units", "units", name, *(["top"] if k == courses - 1 else []))
    if base is not None:
        half = 0.5 * width
        built.add_boxes([(-half, -half, -base)], [(half, half, 0.0)], "plates", "base")
    section = width**2 - (width - 2.0 * thickness) ** 2
    return Specimen(built.blocks(), built.sets, section=section, shape="tower")


def _stones(
    ends: np.ndarray, width: float, thickness: float, wall: int, mirrored: bool
) -> tuple[np.ndarray, np.ndarray]:
    """Lower and upper corners (n, 2) m of the stones of one wall, from where they end (n + 1,) m along it: the front
    wall begins at the left corner, mirrored at the right one, and the others follow by quarters of a turn."""
    half = 0.5 * width
    along = half - ends if mirrored else ends - half
    corners = np.array(
        [[along[:-1], np.full(len(ends) - 1, -half)], [along[1:], np.full(len(ends) - 1, thickness - half)]]
    )
    for _ in range(wall):
        corners = np.stack([-corners[:, 1], corners[:, 0]], axis=1)
    return corners.min(axis=0).T, corners.max(axis=0).T

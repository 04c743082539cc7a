r"""Openings of a wall: what they cut out of its courses, and what bears the wall above them.

lintel  ____________________       flat arch  ____________________
       |____________________|                 \   \   \  /   /   /    its joints meet in one point, and units
          |              |                     \___\___\/___/___/     are cut to skewbacks beside it
          |              |                     |                |
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from geometry.blocks import GeometryError
from geometry.structures.coursing import NEAR, Coursing, course_count

LEAST = 0.25
"""Of a module, the shortest piece of a unit that an opening may leave."""
BEARINGS = (0.75, 0.5, 1.0, 1.25)
"""Of a module: bearings of a lintel in the order in which they are tried where none is given."""


class Opening(NamedTuple):
    """A rectangular opening through a wall; lengths in m.

    left, width    along the wall          sill, height  from its foot
    head           "lintel", "flat arch", or "none" where it reaches the top of the wall
    bearing        of a lintel on each side; None: one at which no end of it stands in line with a head joint
    head_courses   height of lintel or flat arch, in courses
    voussoirs      of a flat arch         skew  rad, from the upright, of its skewbacks
    """

    name: str
    left: float
    width: float
    height: float
    sill: float = 0.0
    head: str = "lintel"
    bearing: float | None = None
    head_courses: int = 1
    voussoirs: int = 7
    skew: float = np.radians(20.0)


@dataclass(frozen=True)
class Hole:
    """Cut-out of the courses first..last - 1 between two straight sides: where it starts and where it ends, at the
    lower and at the upper end of each course (n, 2) m."""

    first: int
    start: np.ndarray
    end: np.ndarray


class CoursedWall(NamedTuple):
    """Wall into which an opening is cut: courses, their rise and the length of a module (m)."""

    coursing: Coursing
    rise: float
    module: float

    @property
    def height(self) -> float:
        return len(self.coursing.cuts) * self.rise


def holes(opening: Opening, wall: CoursedWall, bearing: float) -> list[Hole]:
    """Cut-outs of an opening and its head in the courses."""
    first, top = course_of(opening, wall)
    sides = np.array([opening.left, opening.left + opening.width])
    cuts = [Hole(first, *np.tile(sides[:, None, None], (1, top - first, 2)))]
    if opening.head == "none":
        return cuts
    rises = np.arange(opening.head_courses)[:, None] + np.arange(2)
    reach = rises * (wall.rise * np.tan(opening.skew)) if opening.head == "flat arch" else bearing + 0.0 * rises
    return [*cuts, Hole(top, sides[0] - reach, sides[1] + reach)]


def course_of(opening: Opening, wall: CoursedWall) -> tuple[int, int]:
    """The first course of an opening, and the one above it."""
    words = f"of opening '{opening.name}'"
    first = course_count(f"sill {words}", opening.sill, wall.rise) if opening.sill else 0
    return first, first + course_count(f"height {words}", opening.height, wall.rise)


def pieces(cuts: np.ndarray, course: int, cut_out: Sequence[Hole], minimum: float) -> np.ndarray:
    """(n, 4) m: left end below and above, right end below and above, of what holes leave of a course's units.

    Raises GeometryError where a piece would be shorter than `minimum` (m), below or above.
    """
    outlines = [np.repeat(ends, 2) for ends in np.stack([cuts[:-1], cuts[1:]], axis=1)]
    near = NEAR * minimum
    for hole in (h for h in cut_out if h.first <= course < h.first + len(h.start)):
        hole_start, hole_end = hole.start[course - hole.first], hole.end[course - hole.first]
        whole, outlines = outlines, []
        for piece in whole:
            begin, end = piece[:2], piece[2:]
            if np.all(end <= hole_start + near) or np.all(begin >= hole_end - near):
                outlines.append(piece)
                continue
            for a, b in ((begin, np.minimum(hole_start, end)), (np.maximum(hole_end, begin), end)):
                if np.max(b - a) > near:
                    if np.min(b - a) < minimum - near:
                        raise GeometryError(
                            f"a piece {max(np.min(b - a), 0.0) * 1e3:.3g} mm long in course {course + 1}"
                        )
                    outlines.append(np.concatenate([a, b]))
    return np.array(outlines).reshape(-1, 4)


def bearing_of(opening: Opening, wall: CoursedWall) -> float:
    """The bearing of a lintel (m), given or chosen."""
    if opening.bearing is not None or opening.head != "lintel":
        return opening.bearing or 0.0
    fitting = [fraction * wall.module for fraction in BEARINGS if _fault(opening, wall, fraction * wall.module) is None]
    return min(fitting, key=lambda b: _in_line(opening, wall, b), default=BEARINGS[0] * wall.module)


def _in_line(opening: Opening, wall: CoursedWall, bearing: float) -> int:
    """How many ends of a lintel stand above or below a head joint."""
    _, first = course_of(opening, wall)
    ends = opening.left - bearing, opening.left + opening.width + bearing
    beside = [c for c in (first - 1, first + opening.head_courses) if c < len(wall.coursing.cuts)]
    return sum(int(np.abs(wall.coursing.cuts[c] - end).min() < NEAR * wall.module) for c in beside for end in ends)


def _fault(opening: Opening, wall: CoursedWall, bearing: float) -> str | None:
    """Fault of the pieces that an opening leaves, or of its place in the wall; None if there is none."""
    cut_out = holes(opening, wall, bearing)
    begin, end = wall.coursing.inner
    minimum, near = LEAST * wall.module, NEAR * wall.module
    sides = np.array([[hole.start.min(), hole.end.max()] for hole in cut_out])
    room = np.minimum(sides[:, 0] - begin, end - sides[:, 1])
    if room[0] < minimum - near:
        return "too little wall beside it"
    if room.min() < -near:
        return "its head reaches beyond the wall" if opening.head == "lintel" else "its skewbacks reach beyond the wall"
    for hole, (low, high) in zip(cut_out, sides, strict=True):
        for course in range(hole.first, hole.first + len(hole.start)):
            cuts = wall.coursing.cuts[course]
            beside = cuts[(cuts > low - 2 * wall.module) & (cuts < high + 2 * wall.module)]
            try:
                pieces(beside, course, cut_out, minimum)
            except GeometryError as error:
                return str(error)
    return None


def require_fit(opening: Opening, wall: CoursedWall) -> None:
    """GeometryError for an opening that cannot stand in this wall, with the nearest that can."""
    where = f"wall: opening '{opening.name}'"
    first, top = course_of(opening, wall)
    courses = len(wall.coursing.cuts)
    if first >= courses:
        raise GeometryError(f"{where} begins at {opening.sill:g} m, not below the top of the wall, {wall.height:g} m")
    if top > courses:
        raise GeometryError(
            f"{where} reaches to {top * wall.rise:g} m, above the wall of {wall.height:g} m; nearest height: "
            f"{wall.height - opening.sill:g} m with head = 'none'"
        )
    if top == courses and opening.head != "none":
        raise GeometryError(f"{where} reaches the top of the wall, where no {opening.head} fits; write head = 'none'")
    if top < courses and opening.head == "none":
        raise GeometryError(
            f"{where} has no head, but {courses - top} courses above it; write head = 'lintel' or 'flat arch', or let "
            f"it reach the top: height = {wall.height - opening.sill:g} m"
        )
    if opening.head != "none" and top + opening.head_courses > courses:
        raise GeometryError(
            f"{where}: its {opening.head} is {opening.head_courses} courses high, above it are {courses - top}; "
            f"nearest: head_courses = {courses - top}"
        )
    if opening.bearing is not None and opening.bearing < LEAST * wall.module * (1 - NEAR):
        raise GeometryError(
            f"{where}: its lintel bears on {opening.bearing:g} m, less than a quarter of a unit; "
            f"nearest: {LEAST * wall.module:g} m"
        )
    fault = _fault(opening, wall, bearing_of(opening, wall))
    if fault is not None:
        raise GeometryError(
            f"{where}: {fault}; pieces of units must be {LEAST * wall.module:g} m or longer, a quarter of a unit, "
            f"{_nearest(opening, wall)}"
        )


def _nearest(opening: Opening, wall: CoursedWall) -> str:
    """The nearest place and width, in quarters of a module, at which an opening fits, in words."""
    begin, end = wall.coursing.inner
    step = LEAST * wall.module
    grid = begin + step * np.arange(1, max(int((end - begin) / step), 1))
    widths = {opening.width, *(max(round(opening.width / part), 1) * part for part in (step, 2 * step))}
    tried = [
        (abs(start - opening.left) + abs(width - opening.width), float(start), float(width))
        for start in grid
        for width in widths
    ]
    for _, start, width in sorted(tried):
        moved = opening._replace(left=start, width=width)
        if _fault(moved, wall, bearing_of(moved, wall)) is None:
            narrower = "" if abs(width - opening.width) < NEAR * step else f", width = {width:g} m"
            return f"nearest: left = {start:g} m{narrower}"
    return "and there is no place for one so wide with such a head"


def require_apart(opening: Sequence[Opening], wall: CoursedWall) -> None:
    """Openings, their heads included, leave a quarter of a unit between them, or GeometryError."""
    minimum = LEAST * wall.module
    boxes = [
        (o, h.first, h.first + len(h.start), h.start.min(), h.end.max())
        for o in opening
        for h in holes(o, wall, bearing_of(o, wall))
    ]
    for n, (owner, first, last, low, high) in enumerate(boxes):
        for other, begin, end, start, stop in boxes[:n]:
            gap = max(start - high, low - stop)
            if owner is not other and begin < last and first < end and gap < minimum * (1 - NEAR):
                raise GeometryError(
                    f"wall: openings '{other.name}' and '{owner.name}', their heads included, "
                    + (f"overlap by {-gap:g} m" if gap < 0 else f"leave {gap:g} m between them")
                    + f"; a quarter of a unit, {minimum:g} m, must stay"
                )


def flat_arch(opening: Opening, wall: CoursedWall) -> list[np.ndarray]:
    """Outlines (4, 2) m, x and z, of the voussoirs of a flat arch, from left to right."""
    low, rise = opening.sill + opening.height, opening.head_courses * wall.rise
    middle, half = opening.left + 0.5 * opening.width, 0.5 * opening.width
    fraction = 2.0 * np.arange(opening.voussoirs + 1) / opening.voussoirs - 1.0
    below, above = middle + fraction * half, middle + fraction * (half + rise * np.tan(opening.skew))
    return [
        np.array([[below[k], low], [below[k + 1], low], [above[k + 1], low + rise], [above[k], low + rise]])
        for k in range(opening.voussoirs)
    ]

"""Courses of a straight wall and of the walls that return from its corners: where the head joints stand.

Lengths are those of expanded units: a module is a unit and one joint. Units that cover a corner are as long as the
other wall is thick and half a module more, so that beyond it the bond is running bond. From above, two courses:

     left return   facade                      left return   facade
    |   |                                     |   |
    |   |_____________________                |___|_________________
    |___|_______|_______|____|                |_______|_______|_____|
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from geometry.blocks import GeometryError
from geometry.specimens.bond import COURSES, WHOLE

NEAR = 1e-6
"""Of a module: lengths that differ by less are the same."""


@dataclass(frozen=True)
class Coursing:
    """Where units end, course by course from below.

    cuts    for each course, the ends (n + 1,) m of its n units
    inner   (2,) m, where the wall begins and ends between the walls that return from it
    covered (2, C) whether a return covers the left, the right corner in this course
    """

    cuts: list[np.ndarray]
    inner: tuple[float, float]
    covered: np.ndarray


def course_count(what: str, height: float, rise: float) -> int:
    """So many courses of a rise (m) make this height (m); GeometryError where it is no whole number."""
    count = round(height / rise)
    if abs(height - count * rise) > NEAR * rise or (count < 1 and what.startswith("height")):
        raise GeometryError(
            f"wall: {what} is {height:g} m, it must be a multiple of a course of {rise:g} m (a unit and a joint); "
            f"nearest: {max(count, int(what.startswith('height'))) * rise:g} m"
        )
    return count


def straight(bond: str, courses: int, length: float, module: float) -> Coursing:
    """A wall that ends square on both sides, in any bond; GeometryError where whole and half units do not fit."""
    half = bond == "running"
    per_unit = 1.5 if bond == "flemish" else 1.0
    extra = 0.5 if bond == "flemish" else 0.0
    units = (length / module + extra) / per_unit
    nearest = max(round(2 * units) / 2 if half else round(units), 1 if bond in ("running", "stack") else 2)
    laid = COURSES[bond](nearest if nearest % 1 else int(nearest))
    if nearest == 0.5 or abs(sum(laid[0]) * module / WHOLE - length) > NEAR * module:
        pieces = "half units" if half else "whole units" if bond != "flemish" else "stretchers with headers between"
        raise GeometryError(
            f"wall: length is {length:g} m, it must be made of {pieces} of the bond '{bond}', a whole unit with joint "
            f"being {module:g} m; nearest: {sum(laid[0]) * module / WHOLE:g} m"
        )
    ends = [np.concatenate([[0.0], np.cumsum(parts) * (module / WHOLE)]) for parts in laid]
    for last in ends:
        last[-1] = length
    return Coursing([ends[c % 2] for c in range(courses)], (0.0, length), np.zeros((2, courses), dtype=bool))


def cornered(courses: int, length: float, module: float, corners: Sequence[float]) -> Coursing:
    """A facade in running bond with walls that return from it, so thick (m) on the left and right, 0 for none."""
    half = module / 2
    count = _halves("length", length, sum(corners), half)
    cuts, covered = [], np.zeros((2, courses), dtype=bool)
    for c in range(courses):
        odd = c % 2
        ends = corners[0] + half * np.arange(odd, count + 1, 2)
        covered[:, c] = corners[0] > 0 and odd == 0, corners[1] > 0 and count % 2 == odd
        start = corners[0] if covered[0, c] else 0.0
        stop = length - corners[1] if covered[1, c] else length
        inside = ends[(ends > start + NEAR * half) & (ends < stop - NEAR * half)]
        cuts.append(np.concatenate([[start], inside, [stop]]))
    return Coursing(cuts, (corners[0], length - corners[1]), covered)


def returning(length: float, module: float, thickness: float, covers: np.ndarray) -> Coursing:
    """A wall of this length (m) from the front of a facade so thick (m); covers (C,) says in which courses it has the
    corner."""
    half = module / 2
    count = _halves("return_length", length, thickness, half)
    cuts = []
    for has in covers:
        ends = thickness + half * np.arange(1 if has else 2, count, 2)
        cuts.append(np.concatenate([[0.0 if has else thickness], ends, [length]]))
    return Coursing(cuts, (thickness, length), np.zeros((2, len(covers)), dtype=bool))


def _halves(what: str, length: float, taken: float, half: float) -> int:
    """Half modules in what corners leave of a length (m); GeometryError where they do not fit."""
    count = round((length - taken) / half)
    if count < 1 or abs(length - taken - count * half) > NEAR * half:
        raise GeometryError(
            f"wall: {what} is {length:g} m, of which corners take {taken:g} m; what is left must be half units of "
            f"{half:g} m each; nearest: {taken + max(count, 1) * half:g} m"
        )
    return count

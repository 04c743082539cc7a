"""The wall: courses of units in bond with openings, walls that return from its corners, a base and a beam."""

from collections.abc import Sequence

import numpy as np

from geometry.blocks import Blocks, GeometryError, Specimen
from geometry.checks import require_lengths
from geometry.polyhedra.construct import extrude
from geometry.polyhedra.overlaps import check_overlaps
from geometry.specimens.bond import require_width
from geometry.structures.coursing import Coursing, cornered, course_count, returning, straight
from geometry.structures.gathering import Gathering
from geometry.structures.openings import (
    LEAST,
    CoursedWall,
    Hole,
    Opening,
    bearing_of,
    course_of,
    flat_arch,
    holes,
    pieces,
    require_apart,
    require_fit,
)

SIDES = ("left", "right")


def wall(
    length: float,
    height: float,
    thickness: float,
    unit_length: float,
    unit_height: float,
    joint_thickness: float = 0.0,
    unit_width: float | None = None,
    bond: str = "running",
    opening: Sequence[Opening] = (),
    returns: str = "none",
    return_length: float | None = None,
    return_thickness: float | None = None,
    base: float | None = None,
    beam: float | None = None,
) -> Specimen:
    """A facade length x thickness x height (m, along x, y, z) of expanded units; returns run along y from its corners.

    unit_length, unit_height, joint_thickness  m, of real units; units grow by a joint, joints have no thickness
    unit_width        m, of a real unit, where `bond` has headers
    opening           rectangles through the facade, see Opening
    returns           "none", "left", "right" or "both": walls as high, bonded in course by course, running bond only
    return_length     m, from the front of the facade        return_thickness  m; default half a unit and its joint
    base, beam        heights (m) of a block below and above the facade, and below and above each return
    Sets "units", "facade", "bottom course", "top course", "left end", "right end" (blocks at the ends of the facade);
    "left return", "right return"; "lintel", "flat arch", "keystone", each also with the name of its opening before it;
    "base", "beam". The section is length times thickness. Raises GeometryError for what cannot be built.
    """
    lengths = {
        **{"length": length, "height": height, "thickness": thickness, "unit_length": unit_length},
        **{"unit_height": unit_height, "joint_thickness": joint_thickness, "unit_width": unit_width},
        **{"return_length": return_length, "return_thickness": return_thickness, "base": base, "beam": beam},
    }
    require_lengths("wall", {k: v for k, v in lengths.items() if v is not None}, zero_allowed=("joint_thickness",))
    module, rise = unit_length + joint_thickness, unit_height + joint_thickness
    courses = course_count("height", height, rise)
    corners = _corners(bond, returns, thickness, return_length, return_thickness, module)
    if bond in ("english", "flemish"):
        require_width(bond, unit_length, joint_thickness, unit_width)
    coursing = cornered(courses, length, module, corners) if any(corners) else straight(bond, courses, length, module)
    into = CoursedWall(coursing, rise, module)
    built = Gathering()
    course = [_add_facade(built, into, _holes(opening, into), thickness)]
    for side, thick in enumerate(corners):
        if thick and return_length is not None:
            bonded = returning(return_length, module, thickness, coursing.covered[side])
            x = 0.0 if side == 0 else length - thick
            course.append(_add_return(built, bonded, x, thick, rise, f"{SIDES[side]} return"))
    built.sets |= _ends(built.blocks(), np.concatenate(course), (0.0, length), 1e-9 * max(length, height))
    for entry in opening:
        _add_head(built, entry, into, thickness)
    plans = [(0.0, length, 0.0, thickness)]
    plans += [(0.0, corners[0], thickness, return_length or 0.0)] if corners[0] else []
    plans += [(length - corners[1], length, thickness, return_length or 0.0)] if corners[1] else []
    for name, low, tall in (("base", -(base or 0.0), base), ("beam", courses * rise, beam)):
        if tall is not None:
            lows, highs = ([(x[k], x[2 + k], low + k * tall) for x in plans] for k in (0, 1))
            built.add_boxes(lows, highs, "plates", name)
    blocks = built.blocks()
    check_overlaps(blocks)
    return Specimen(blocks, built.sets, section=length * thickness, shape="wall")


def _corners(
    bond: str, returns: str, thickness: float, length: float | None, thick: float | None, module: float
) -> tuple[float, float]:
    """How thick (m) the walls are that return on the left and on the right, 0 for none."""
    if returns not in ("none", *SIDES, "both"):
        raise GeometryError(f"wall: returns is '{returns}', allowed: none, left, right, both")
    if returns == "none":
        if length is not None or thick is not None:
            raise GeometryError("wall: there are no returns, so leave return_length and return_thickness out")
        return 0.0, 0.0
    if bond != "running":
        raise GeometryError(
            f"wall: returns are bonded in in running bond only, not in '{bond}'; nearest: bond = 'running'"
        )
    if length is None:
        raise GeometryError(f"wall: returns = '{returns}' needs return_length, from the front of the facade")
    thick = 0.5 * module if thick is None else thick
    for what, value in (("thickness", thickness), ("return_thickness", thick)):
        if not LEAST * module <= value * (1 + 1e-9) <= (1 - LEAST) * module * (1 + 2e-9):
            near = min(max(value, LEAST * module), (1 - LEAST) * module)
            raise GeometryError(
                f"wall: {what} is {value:g} m: with returns units of both walls lie across the corner in turn, so it "
                f"must be from a quarter to three quarters of a unit and its joint of {module:g} m; nearest: {near:g} m"
            )
    return thick if returns != "right" else 0.0, thick if returns != "left" else 0.0


def _holes(opening: Sequence[Opening], into: CoursedWall) -> list[Hole]:
    """Cut-outs of all openings in the courses, once it is known that they fit."""
    names = [entry.name for entry in opening]
    for entry in opening:
        require_lengths(
            f"wall: opening '{entry.name}'",
            {"left": entry.left, "width": entry.width, "height": entry.height, "sill": entry.sill},
            zero_allowed=("left", "sill"),
        )
        if names.count(entry.name) > 1:
            raise GeometryError(
                f"wall: {names.count(entry.name)} openings are named '{entry.name}'; each needs a name of its own"
            )
        require_fit(entry, into)
    require_apart(opening, into)
    cuts = [hole for entry in opening for hole in holes(entry, into, bearing_of(entry, into))]
    return sorted(cuts, key=lambda hole: float(hole.start.min()))


def _add_facade(built: Gathering, into: CoursedWall, cut_out: Sequence[Hole], thickness: float) -> np.ndarray:
    """Units of the facade; returns the course of each."""
    minimum, loops, course = LEAST * into.module, [], []
    for c, cuts in enumerate(into.coursing.cuts):
        for a0, a1, b0, b1 in pieces(cuts, c, cut_out, minimum):
            low, high = c * into.rise, (c + 1) * into.rise
            loops.append(np.array([[a0, low], [b0, low], [b1, high], [a1, high]]))
            course.append(c)
    built.add(_upright(loops, thickness), "units", "facade")
    return np.array(course)


def _add_return(built: Gathering, bonded: Coursing, x: float, thick: float, rise: float, name: str) -> np.ndarray:
    """Units of a wall that returns; returns the course of each."""
    course = np.repeat(np.arange(len(bonded.cuts)), [len(cuts) - 1 for cuts in bonded.cuts])
    begin, end = (np.concatenate([cuts[part] for cuts in bonded.cuts]) for part in (slice(0, -1), slice(1, None)))
    low = [(x, a, c * rise) for a, c in zip(begin, course, strict=True)]
    high = [(x + thick, b, (c + 1) * rise) for b, c in zip(end, course, strict=True)]
    built.add_boxes(low, high, "units", "units", name)
    return course


def _upright(loops: Sequence[np.ndarray], thickness: float) -> Blocks:
    """Outlines (k, 2) m in x and z through the whole thickness."""
    count = len(loops)
    return extrude(loops, np.zeros(count), np.full(count, thickness), np.zeros(count), ("units",))


def _ends(blocks: Blocks, course: np.ndarray, sides: tuple[float, float], near: float) -> dict[str, np.ndarray]:
    """Sets of the units at the ends of the facade, and of the lowest and the highest course."""
    corners = np.split(blocks.points[blocks.face_points], blocks.face_start[blocks.block_face_start[1:-1]])
    low, high = (np.array([bound(points[:, 0]) for points in corners]) for bound in (np.min, np.max))
    return {
        "left end": np.flatnonzero(low <= sides[0] + near),
        "right end": np.flatnonzero(high >= sides[1] - near),
        "bottom course": np.flatnonzero(course == 0),
        "top course": np.flatnonzero(course == course.max()),
    }


def _add_head(built: Gathering, opening: Opening, into: CoursedWall, thickness: float) -> None:
    """The lintel or the flat arch of an opening, and its sets."""
    if opening.head == "lintel":
        bearing, (_, top) = bearing_of(opening, into), course_of(opening, into)
        low = (opening.left - bearing, 0.0, top * into.rise)
        high = (opening.left + opening.width + bearing, thickness, (top + opening.head_courses) * into.rise)
        built.add_boxes([low], [high], "lintels", "lintel", f"{opening.name} lintel")
    elif opening.head == "flat arch":
        members = built.add(
            _upright(flat_arch(opening, into), thickness), "units", "flat arch", f"{opening.name} flat arch"
        )
        key = members[(len(members) - 1) // 2 : len(members) // 2 + 1]
        for name in ("keystone", f"{opening.name} keystone"):
            built.sets[name] = np.concatenate([built.sets.get(name, key[:0]), key])

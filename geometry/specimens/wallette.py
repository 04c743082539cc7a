"""The wallette: a plane wall of expanded units in any bond, with plates left and right, a base and a beam."""

from collections.abc import Sequence

import numpy as np

from geometry.blocks import GeometryError, Specimen
from geometry.cells.request import CellRequest
from geometry.checks import require_counts, require_lengths
from geometry.polyhedra.construct import concatenate, from_boxes
from geometry.polyhedra.overlaps import check_overlaps
from geometry.specimens.bond import Bond, lay, require_units
from geometry.specimens.walls import fill_bond, wall_sets


def wallette(
    courses: int,
    units_per_course: float,
    unit_length: float,
    unit_height: float,
    thickness: float,
    joint_thickness: float,
    divisions: Sequence[int] | CellRequest = (1, 1),
    plates: float | None = None,
    bond: str = "running",
    unit_width: float | None = None,
    base: float | None = None,
    beam: float | None = None,
    shoes: float | None = None,
) -> Specimen:
    """A wall of courses x units_per_course units of unit_length x thickness x unit_height (m, along x, y, z).

    joint_thickness  of head and bed joints: units are expanded by it, the joints themselves have no thickness
    divisions        (nx, nz) blocks in a whole unit, of which half units get nx / 2; or cells in all units together
    plates           thickness (m) of a plate left and right over the whole height, one block each
    bond, unit_width  as in geometry.specimens.bond
    base, beam       heights (m) of a footing below and a spreader beam above the whole wall, one block each
    shoes            how far (m) plates reach along both sides from the lower left and the upper right corner: two
                     blocks each, as deep as the units are high
    The section is that of a test along x, height times thickness; with a base or a beam and without plates that of a
    bed joint, length times thickness. Raises GeometryError for sizes that cannot be built.
    """
    lengths = {
        "unit_length": unit_length,
        "unit_height": unit_height,
        "thickness": thickness,
        "joint_thickness": joint_thickness,
    }
    optional = {"plates": plates, "unit_width": unit_width, "base": base, "beam": beam, "shoes": shoes}
    lengths |= {name: length for name, length in optional.items() if length is not None}
    require_lengths("wallette", lengths, zero_allowed=("joint_thickness",))
    if shoes is not None and (plates, base, beam) != (None, None, None):
        raise GeometryError("wallette: shoes take the place of plates, base and beam; keep one of them")
    require_units("wallette", bond, courses, units_per_course)
    if not isinstance(divisions, CellRequest):
        require_counts("wallette", "divisions", divisions, "xz")
        divisions = (divisions[0], 1, divisions[1])
    laid = lay(bond, courses, units_per_course, (unit_length, unit_height), joint_thickness, thickness, unit_width)
    blocks, reports = fill_bond("wallette", laid, divisions)
    sets = wall_sets(blocks, laid)
    ends = _ends(plates, base, beam, laid, thickness)
    if shoes is not None:
        if shoes > min(laid.length, laid.height):
            raise GeometryError(f"wallette: shoes of {shoes:g} m are longer than the wall")
        ends = _shoes(shoes, unit_height, laid, thickness)
    if ends:
        sets |= {name: blocks.count + np.flatnonzero([end[0] == name for end in ends]) for name, _, _ in ends}
        low, high = (np.array([end[k] for end in ends]) for k in (1, 2))
        unit = len(laid.parts) + np.arange(len(ends))
        blocks = concatenate([blocks, from_boxes(low, high, unit, np.zeros(len(ends)), ("plates",))])
    check_overlaps(blocks)
    along_z = plates is None and shoes is None and bool(ends)
    section = (laid.length if along_z else laid.height) * thickness
    return Specimen(blocks, sets, section=section, shape="wallette", cells=reports)


Corner = tuple[float, float, float]
End = tuple[str, Corner, Corner]
"""Name of a set, low and high corner (m) of a block."""


def _ends(plates: float | None, base: float | None, beam: float | None, laid: Bond, thickness: float) -> list[End]:
    """Blocks at the ends of a wall that stands on z = 0."""
    length, height, boxes = laid.length, laid.height, {}
    if plates is not None:
        boxes["left plate"] = (-plates, 0.0, 0.0), (0.0, thickness, height)
        boxes["right plate"] = (length, 0.0, 0.0), (length + plates, thickness, height)
    if base is not None:
        boxes["base"] = (0.0, 0.0, -base), (length, thickness, 0.0)
    if beam is not None:
        boxes["beam"] = (0.0, 0.0, height), (length, thickness, height + beam)
    return [(name, low, high) for name, (low, high) in boxes.items()]


def _shoes(reach: float, depth: float, laid: Bond, thickness: float) -> list[End]:
    """Plates that lie against both sides of two opposite corners."""
    length, height = laid.length, laid.height
    return [
        ("lower shoe", (0.0, 0.0, -depth), (reach, thickness, 0.0)),
        ("lower shoe", (-depth, 0.0, 0.0), (0.0, thickness, reach)),
        ("upper shoe", (length - reach, 0.0, height), (length, thickness, height + depth)),
        ("upper shoe", (length, 0.0, height - reach), (length + depth, thickness, height)),
    ]

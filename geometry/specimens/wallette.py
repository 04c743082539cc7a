"""The wallette: a plane wall of expanded units in any bond, with end plates left and right."""

from collections.abc import Sequence

import numpy as np

from geometry.blocks import Blocks, Specimen
from geometry.cells.request import CellsAsked
from geometry.checks import require_counts, require_lengths
from geometry.polyhedra.construct import concatenate, from_boxes
from geometry.polyhedra.overlaps import check_overlaps
from geometry.specimens.bond import lay
from geometry.specimens.walls import fill_bond, wall_sets


def wallette(
    courses: int,
    units_per_course: int,
    unit_length: float,
    unit_height: float,
    thickness: float,
    joint_thickness: float,
    divisions: Sequence[int] | CellsAsked = (1, 1),
    plates: float | None = None,
    bond: str = "running",
    unit_width: float | None = None,
) -> Specimen:
    """A wall of courses x units_per_course units of unit_length x thickness x unit_height (m, along x, y, z).

    joint_thickness  of head and bed joints: units are expanded by it, the joints themselves have no thickness
    divisions        (nx, nz) blocks in a whole unit, of which half units get nx / 2; or cells in all units together
    plates           thickness (m) of a plate left and right over the whole height, one block each
    bond, unit_width  as in geometry.specimens.bond
    The section is the height of the wall times its thickness. Raises GeometryError for sizes that cannot be built.
    """
    lengths = {
        "unit_length": unit_length,
        "unit_height": unit_height,
        "thickness": thickness,
        "joint_thickness": joint_thickness,
        "plates": 1.0 if plates is None else plates,
        "unit_width": 1.0 if unit_width is None else unit_width,
    }
    require_lengths("wallette", lengths, zero_allowed=("joint_thickness",))
    require_counts("wallette", "number of units", (units_per_course, courses), "xz")
    if not isinstance(divisions, CellsAsked):
        require_counts("wallette", "divisions", divisions, "xz")
        divisions = (divisions[0], 1, divisions[1])
    laid = lay(bond, courses, units_per_course, (unit_length, unit_height), joint_thickness, thickness, unit_width)
    blocks, reports = fill_bond("wallette", laid, divisions)
    sets = wall_sets(blocks, laid)
    if plates is not None:
        sets |= {"left plate": np.array([blocks.count]), "right plate": np.array([blocks.count + 1])}
        blocks = concatenate([blocks, _end_plates(plates, laid.length, thickness, laid.height, len(laid.parts))])
    check_overlaps(blocks)
    return Specimen(blocks, sets, section=laid.height * thickness, shape="wallette", cells=reports)


def _end_plates(plate: float, length: float, thickness: float, height: float, unit: int) -> Blocks:
    low = np.array([[-plate, 0.0, 0.0], [length, 0.0, 0.0]])
    high = np.array([[0.0, thickness, height], [length + plate, thickness, height]])
    return from_boxes(low, high, np.array([unit, unit + 1]), np.zeros(2), ("plates",))

"""The wallette: a wall in running bond of expanded units, with end plates left and right."""

from collections.abc import Sequence

import numpy as np

from geometry.blocks import Blocks, GeometryError, Specimen
from geometry.bond import running_bond
from geometry.grid import divide
from geometry.overlaps import check_overlaps
from geometry.shapes import concatenate, from_boxes
from geometry.sizes import require_counts, require_lengths


def wallette(
    courses: int,
    units_per_course: int,
    unit_length: float,
    unit_height: float,
    thickness: float,
    joint_thickness: float,
    divisions: Sequence[int] = (1, 1),
    plates: float | None = None,
) -> Specimen:
    """A wall of courses x units_per_course units of unit_length x thickness x unit_height (m, along x, y, z).

    joint_thickness  of head and bed joints: units are expanded by it, the joints themselves have no thickness
    divisions        (nx, nz) blocks in a whole unit; half units get nx / 2, so nx is 1 or even
    plates           thickness (m) of a plate left and right over the whole height, one block each
    The section is the height of the wall times its thickness. Raises GeometryError for sizes that cannot be built.
    """
    require_lengths(
        "wallette",
        {
            "unit_length": unit_length,
            "unit_height": unit_height,
            "thickness": thickness,
            "joint_thickness": joint_thickness,
            "plates": 1.0 if plates is None else plates,
        },
        zero_allowed=("joint_thickness",),
    )
    require_counts("wallette", "number of units", (units_per_course, courses), "xz")
    require_counts("wallette", "divisions", divisions, "xz")
    nx, nz = divisions
    if nx > 1 and nx % 2 and courses > 1:
        raise GeometryError(
            f"wallette: divisions along x is {nx}, but a half unit takes half of them: 1 or an even number; "
            f"nearest: {nx - 1} or {nx + 1}"
        )
    module = (unit_length + joint_thickness, unit_height + joint_thickness)
    bond = running_bond(courses, units_per_course, *module, thickness)
    lows, highs, units = [], [], []
    for number, (low, high, half) in enumerate(zip(bond.low, bond.high, bond.half, strict=True)):
        cells = divide(low, high, (max(1, nx // 2) if half else nx, 1, nz))
        lows.append(cells[0])
        highs.append(cells[1])
        units.append(np.full(len(cells[0]), number))
    unit = np.concatenate(units)
    blocks = from_boxes(np.concatenate(lows), np.concatenate(highs), unit, np.zeros(len(unit)), ("units",))
    course = bond.course[unit]
    sets = {
        "units": np.arange(blocks.count),
        "left end": np.flatnonzero(np.concatenate(lows)[:, 0] == 0.0),
        "right end": np.flatnonzero(np.concatenate(highs)[:, 0] == bond.length),
        "bottom course": np.flatnonzero(course == 0),
        "top course": np.flatnonzero(course == courses - 1),
    }
    if plates is not None:
        sets |= {"left plate": np.array([blocks.count]), "right plate": np.array([blocks.count + 1])}
        blocks = concatenate([blocks, _end_plates(plates, bond.length, thickness, bond.height, unit[-1] + 1)])
    check_overlaps(blocks)
    return Specimen(blocks, sets, section=bond.height * thickness, shape="wallette")


def _end_plates(plate: float, length: float, thickness: float, height: float, unit: int) -> Blocks:
    low = np.array([[-plate, 0.0, 0.0], [length, 0.0, 0.0]])
    high = np.array([[0.0, thickness, height], [length + plate, thickness, height]])
    return from_boxes(low, high, np.array([unit, unit + 1]), np.zeros(2), ("plates",))

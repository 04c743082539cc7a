"""The multi-leaf wall: two outer leaves in bond, a core of rubble between them, headers through all of it.

Headers lie in some courses, evenly spread over the height, and take the place of whole units in both leaves. The core
is laid in lifts: cells fill the room between two courses of headers, and that between the headers of a course, each by
itself. So the core has level beds where a course of headers begins and ends, and is rubble between.
"""

import numpy as np

from geometry.blocks import CellReport, GeometryError, Specimen
from geometry.cells.request import CellRequest
from geometry.checks import require_lengths
from geometry.polyhedra.measures import bounds
from geometry.polyhedra.overlaps import check_overlaps
from geometry.specimens.bond import WHOLE
from geometry.specimens.filling import fill_with_cells
from geometry.structures.coursing import Coursing, course_count, straight
from geometry.structures.gathering import Gathering

BONDS = ("running", "stack")


def multi_leaf(
    length: float,
    height: float,
    leaf_thickness: float,
    core_thickness: float,
    unit_length: float,
    unit_height: float,
    core: CellRequest,
    joint_thickness: float = 0.0,
    bond: str = "running",
    headers: float = 0.0,
    base: float | None = None,
    beam: float | None = None,
) -> Specimen:
    """A wall length x (two leaves and the core) x height (m, along x, y, z), its front at y = 0.

    unit_length, unit_height, joint_thickness  m, of real units; units grow by a joint, joints have no thickness
    core        how the core is cut into cells, in space
    headers     share of the whole units of a leaf that go through to the other face, 0 to 1
    base, beam  heights (m) of a block below and above all of the wall

    Sets "units" (leaves and headers), "front leaf", "back leaf" (without headers), "headers", "core", "left end",
    "right end", "bottom course", "top course" (of the units), "base", "beam". Group "core" for its cells, each a unit
    of its own. The section is length times the whole thickness. Raises GeometryError for what cannot be built.
    """
    lengths = {
        **{"length": length, "height": height, "leaf_thickness": leaf_thickness, "core_thickness": core_thickness},
        **{"unit_length": unit_length, "unit_height": unit_height, "joint_thickness": joint_thickness},
    }
    lengths |= {name: value for name, value in (("base", base), ("beam", beam)) if value is not None}
    require_lengths("multi-leaf", lengths, zero_allowed=("joint_thickness",))
    _require(bond, headers, core)
    module, rise = unit_length + joint_thickness, unit_height + joint_thickness
    courses = course_count("height", height, rise)
    coursing = straight(bond, courses, length, module)
    through = _headers(coursing, module, headers)
    inside, deep = (leaf_thickness, leaf_thickness + core_thickness), 2 * leaf_thickness + core_thickness
    built = Gathering()
    for name, (front, back) in (("front leaf", (0.0, inside[0])), ("back leaf", (inside[1], deep))):
        _add_units(built, coursing, rise, (front, back), [~chosen for chosen in through], name)
    _add_units(built, coursing, rise, (0.0, deep), through, "headers")
    low, high = bounds(built.blocks())
    near = 1e-9 * max(length, height)
    built.sets |= {
        "left end": np.flatnonzero(low[:, 0] <= near),
        "right end": np.flatnonzero(high[:, 0] >= length - near),
        "bottom course": np.flatnonzero(low[:, 2] <= near),
        "top course": np.flatnonzero(high[:, 2] >= courses * rise - near),
    }
    rooms = np.array(_rooms(coursing, through, rise, inside))
    reports: tuple[CellReport, ...] = ()
    if len(rooms):
        cells, report = fill_with_cells(rooms[:, 0], rooms[:, 1], core, "core")
        built.add(cells, "core")
        reports = (report,)
    for name, bottom, tall in (("base", -(base or 0.0), base), ("beam", courses * rise, beam)):
        if tall is not None:
            built.add_boxes([(0.0, 0.0, bottom)], [(length, deep, bottom + tall)], "plates", name)
    blocks = built.blocks()
    check_overlaps(blocks)
    return Specimen(blocks, built.sets, section=length * deep, shape="multi-leaf", cells=reports)


def _require(bond: str, headers: float, core: CellRequest) -> None:
    if bond not in BONDS:
        raise GeometryError(f"multi-leaf: bond '{bond}' is unknown; allowed: {', '.join(BONDS)}")
    if not 0.0 <= headers <= 1.0:
        raise GeometryError(
            f"multi-leaf: headers is {headers:g}, the share of the units that go through must be from 0 to 1; "
            f"nearest: {min(max(headers, 0.0), 1.0) if headers == headers else 0.0:g}"
        )
    if not core.space:
        raise GeometryError("multi-leaf: the core is cut into cells in space: form = 'space'")


def _headers(coursing: Coursing, module: float, fraction: float) -> list[np.ndarray]:
    """For each course, which of its units are headers: whole ones only, as many as the fraction says, evenly spread."""
    whole = [np.diff(cuts) > module * (1 - 0.5 / WHOLE) for cuts in coursing.cuts]
    total = sum(int(mask.sum()) for mask in whole)
    target, courses = round(fraction * total), len(whole)
    headers = [np.zeros(len(mask), dtype=bool) for mask in whole]
    if target == 0:
        return headers
    fewest = min(int(mask.sum()) for mask in whole)
    maximum = max(fewest // 2, 1) if fraction <= 0.5 else max(fewest, 1)  # every other one where that is enough
    number = min(courses, -(-target // maximum))
    chosen = np.floor((np.arange(number) + 0.5) * courses / number).astype(int)
    remaining = target
    for k, c in enumerate(chosen.tolist()):
        places = np.flatnonzero(whole[c])
        here = min(-(-remaining // (number - k)), len(places))
        headers[c][places[np.floor((np.arange(here) + 0.5) * len(places) / here).astype(int)]] = True
        remaining -= here
    for mask, could in zip(headers, whole, strict=True):  # what did not fit where it was to be
        more = np.flatnonzero(could & ~mask)[:remaining]
        mask[more] = True
        remaining -= len(more)
    return headers


def _add_units(
    built: Gathering, coursing: Coursing, rise: float, sides: tuple[float, float], which: list[np.ndarray], name: str
) -> None:
    """Units of some courses between two planes across y."""
    ends = [
        (cuts[k], cuts[k + 1], c)
        for c, (cuts, chosen) in enumerate(zip(coursing.cuts, which, strict=True))
        for k in np.flatnonzero(chosen)
    ]
    if ends:
        low = [(a, sides[0], c * rise) for a, _, c in ends]
        high = [(b, sides[1], (c + 1) * rise) for _, b, c in ends]
        built.add_boxes(low, high, "units", "units", name)


def _rooms(
    coursing: Coursing, through: list[np.ndarray], rise: float, sides: tuple[float, float]
) -> list[list[tuple[float, float, float]]]:
    """Low and high corner (m) of each box of the core: lifts between courses of headers, and between headers."""
    boxes, begin = [], 0
    length, courses = float(coursing.cuts[0][-1]), len(through)
    for c in range(courses + 1):
        if c < courses and not through[c].any():
            continue
        if c > begin:
            boxes.append([(0.0, sides[0], begin * rise), (length, sides[1], c * rise)])
        if c < courses:
            cuts = coursing.cuts[c]
            edges = [0.0, *(x for k in np.flatnonzero(through[c]) for x in (cuts[k], cuts[k + 1])), length]
            boxes += [
                [(a, sides[0], c * rise), (b, sides[1], (c + 1) * rise)]
                for a, b in zip(edges[::2], edges[1::2], strict=True)
                if b > a
            ]
        begin = c + 1
    return boxes

"""Horizontal bending (Fig. 20): a wall between two support rollers and two load rollers, all upright."""

import numpy as np

from geometry.blocks import Blocks, GeometryError, Specimen
from geometry.cells.request import CellRequest
from geometry.checks import require_counts, require_lengths
from geometry.polyhedra.construct import concatenate, from_boxes
from geometry.polyhedra.overlaps import check_overlaps
from geometry.specimens.bond import lay, require_units
from geometry.specimens.stacked import Filling
from geometry.specimens.walls import fill_bond, wall_sets


def bending(
    courses: int,
    units_per_course: float,
    unit_length: float,
    unit_height: float,
    thickness: float,
    joint_thickness: float,
    divisions: Filling = (1, 1, 1),
    bond: str = "running",
    unit_width: float | None = None,
    support_distance: float = 0.025,
    load_distance: float | None = None,
    roller_width: float = 0.01,
    bottom_plate: float | None = None,
) -> Specimen:
    """A wall as in `wallette`, divided into (nx, ny, nz) blocks a unit or into cells, between four rollers.

    support_distance  m, from each end of the wall to the middle of a support roller, on the face y+
    load_distance     m, along x from a support roller to the next load roller, on the face y-; default a third of the
                      span, so that the loads stand at its third points
    roller_width      m; a roller is a square bar over the whole height that touches the wall in a strip so wide
    bottom_plate      thickness (m) of a plate under the wall, one block, where the wall is pressed from above

    Sets "support rollers", "load rollers", "bottom plate" and those of a wallette. With a force F on both load rollers
    together the moment between them is F a / 2, a = load_distance, so the section H t^2 / (3 a) makes F / section the
    nominal flexural stress M / W of the gross section, W = H t^2 / 6; at third points that is F span / (H t^2).
    Raises GeometryError for sizes that cannot be built and rollers that do not stand side by side on the wall.
    """
    sizes = {"unit_width": unit_width, "load_distance": load_distance, "bottom_plate": bottom_plate}
    lengths = {
        "unit_length": unit_length,
        "unit_height": unit_height,
        "thickness": thickness,
        "joint_thickness": joint_thickness,
        "support_distance": support_distance,
        "roller_width": roller_width,
        **{name: value for name, value in sizes.items() if value is not None},
    }
    require_lengths("bending", lengths, zero_allowed=("joint_thickness",))
    require_units("bending", bond, courses, units_per_course)
    if not isinstance(divisions, CellRequest):
        require_counts("bending", "divisions", divisions, "xyz")
    laid = lay(bond, courses, units_per_course, (unit_length, unit_height), joint_thickness, thickness, unit_width)
    span = laid.length - 2 * support_distance
    arm = span / 3 if load_distance is None else load_distance
    _require_room(span, support_distance, arm, roller_width)
    blocks, reports = fill_bond("bending", laid, divisions)
    sets, count, unit = wall_sets(blocks, laid), blocks.count, len(laid.parts)
    supports = _rollers(np.array([0.0, span]) + support_distance, thickness, laid.height, roller_width, unit)
    loads = _rollers(np.array([arm, span - arm]) + support_distance, -roller_width, laid.height, roller_width, unit + 2)
    sets |= {"support rollers": count + np.arange(2), "load rollers": count + np.arange(2, 4)}
    parts = [blocks, supports, loads]
    if bottom_plate is not None:
        high = np.array([[laid.length, thickness, 0.0]])
        low = np.array([[0.0, 0.0, -bottom_plate]])
        parts.append(from_boxes(low, high, np.array([unit + 4]), np.zeros(1), ("plates",)))
        sets["bottom plate"] = np.array([count + 4])
    whole = concatenate(parts)
    check_overlaps(whole)
    section = laid.height * thickness**2 / (3 * arm)
    return Specimen(whole, sets, section=section, shape="bending", cells=reports)


def _require_room(span: float, inset: float, arm: float, width: float) -> None:
    """Rollers stand on the wall and beside each other."""
    if inset < width / 2:
        raise GeometryError(
            f"bending: support_distance is {inset:g} m, so a roller {width:g} m wide stands out beyond the end of the "
            f"wall; nearest: {width / 2:g} m"
        )
    if not 2 * arm + width <= span:
        raise GeometryError(
            f"bending: rollers {width:g} m wide at {arm:g} m from the supports do not fit beside each other "
            f"into a span of {span:.4g} m; a third of it is {span / 3:.4g} m"
        )


def _rollers(middle: np.ndarray, face: float, height: float, width: float, unit: int) -> Blocks:
    """Two square bars over the whole height, from y = face on."""
    low = np.stack([middle - width / 2, np.full(2, face), np.zeros(2)], axis=1)
    return from_boxes(low, low + (width, width, height), unit + np.arange(2), np.zeros(2), ("rollers",))

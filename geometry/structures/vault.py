"""The barrel vault: courses of units along its length, laid in bond over a circular ring, between two abutments."""

import numpy as np

from geometry.blocks import GeometryError, Specimen
from geometry.checks import require_counts, require_lengths
from geometry.polyhedra.construct import concatenate, extrude
from geometry.polyhedra.overlaps import check_overlaps
from geometry.specimens.bond import COURSES
from geometry.structures.rings import abutment_outlines, crown, in_facets, joints_of_ring, require_ring

BONDS = ("running", "stack")


def vault(
    radius: float,
    angle: float,
    courses: int,
    thickness: float,
    length: float,
    units_per_course: float,
    bond: str = "running",
    facets: int = 1,
    level: float = 0.0,
) -> Specimen:
    """A ring as of an arch, so many courses from springing to springing, drawn out along y and cut into units.

    radius, angle, thickness, facets, level  as in `arch`: m and rad
    courses           2 or more, each as long as the vault
    length            m, along y
    units_per_course  whole units in a course, or in running bond half a unit more
    bond              "running": head joints of a course stand at the middle of the units of the next; or "stack"

    Units come course by course from left to right, each from front to back, then the two abutments, each one block over
    the whole length. Sets "voussoirs", "keystone" (the course at the crown, both of them where their number is even),
    "front", "back" (units at the ends), "left abutment", "right abutment". The section is that of a bed joint,
    thickness * length. Raises GeometryError for what cannot be built.
    """
    require_lengths("vault", {"radius": radius, "thickness": thickness, "length": length})
    require_ring("vault", "courses", radius, angle, courses, thickness)
    require_counts("vault", "number of facets", (facets,), "x")
    if bond not in BONDS:
        raise GeometryError(f"vault: bond '{bond}' is unknown; allowed: {', '.join(BONDS)}")
    halves = bond == "running" and units_per_course > 1 and units_per_course % 1 == 0.5
    require_counts("vault", "number of units", (units_per_course + 0.5 * halves,), "y")
    laid = COURSES[bond](units_per_course if halves else int(units_per_course))
    cuts = [np.concatenate([[0.0], np.cumsum(parts) * (length / sum(parts))]) for parts in laid]
    ends = joints_of_ring(radius, angle, courses * facets, thickness, level)
    parts, course = [], []
    for c in range(courses):
        course_ends, slices = ends[c * facets : (c + 1) * facets + 1], cuts[c % 2]
        number = len(slices) - 1
        repeated = [in_facets(course_ends, facets, slices[k : k + 1], slices[k + 1 : k + 2]) for k in range(number)]
        parts += repeated
        course += [c] * number
    whole = extrude(abutment_outlines(ends, angle), np.zeros(2), np.full(2, length), np.zeros(2), ("units",))
    blocks = concatenate([*parts, whole])
    blocks.unit[:] = np.arange(blocks.count)
    if facets == 1:  # more of them lie within the same wedges
        check_overlaps(blocks)
    of, count = np.array(course), len(course)
    first = np.concatenate([[True], of[1:] != of[:-1]])
    sets = {
        "voussoirs": np.arange(count),
        "keystone": np.flatnonzero(np.isin(of, crown(courses))),
        "front": np.flatnonzero(first),
        "back": np.flatnonzero(np.roll(first, -1)),
        "left abutment": np.array([count]),
        "right abutment": np.array([count + 1]),
    }
    return Specimen(blocks, sets, section=thickness * length, shape="vault")

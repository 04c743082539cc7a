"""The arch: voussoirs cut from a circular ring by plane joints that point at its centre, between two abutments."""

import numpy as np

from geometry.blocks import GeometryError, Specimen
from geometry.checks import require_counts, require_lengths
from geometry.polyhedra.construct import concatenate, extrude
from geometry.polyhedra.overlaps import check_overlaps
from geometry.structures.rings import (
    abutment_outlines,
    crown,
    in_facets,
    joints_of_ring,
    require_ring,
    skewback_outlines,
)

ABUTMENTS = ("square", "skewbacks")


def arch(
    radius: float,
    angle: float,
    voussoirs: int,
    thickness: float,
    depth: float,
    facets: int = 1,
    abutments: str = "square",
    level: float = 0.0,
) -> Specimen:
    """Equal voussoirs in an upright plane, the crown at the top; intrados and extrados are polygons.

    radius     m, of the centre line, midway between intrados and extrados; the joints end on these two circles
    angle      rad, of embrace, from springing to springing: above 0, up to pi for a semicircle
    voussoirs  2 or more
    thickness  m, along the joints, less than the radius
    depth      m, along y
    facets     straight pieces of intrados and extrados in each voussoir; with more than 1 voussoirs are not convex
    abutments  "square": each a block that goes on beyond the springing, square to it, by half the thickness; or
               "skewbacks": each stands upright below the springing, level below, which it meets in a slope
    level      m, z of the centre of the circle, whose x is 0

    Voussoirs come from left to right, then the left and the right abutment.
    Sets "voussoir 1", "voussoir 2", ... from left to right, "voussoirs", "keystone" (the voussoir at the crown; both of
    them where their number is even), "left abutment", "right abutment". The section is that of a joint, thickness *
    depth. Raises GeometryError for what cannot be built.
    """
    require_lengths("arch", {"radius": radius, "thickness": thickness, "depth": depth})
    require_ring("arch", "voussoirs", radius, angle, voussoirs, thickness)
    require_counts("arch", "number of facets", (facets,), "x")
    if abutments not in ABUTMENTS:
        raise GeometryError(f"arch: abutments is '{abutments}', allowed: {', '.join(ABUTMENTS)}")
    ends = joints_of_ring(radius, angle, voussoirs * facets, thickness, level)
    stones = in_facets(ends, facets, np.zeros(voussoirs), np.full(voussoirs, depth))
    outlines = abutment_outlines(ends, angle) if abutments == "square" else skewback_outlines(ends)
    sides = extrude(outlines, np.zeros(2), np.full(2, depth), voussoirs + np.arange(2), ("units",))
    blocks = concatenate([stones, sides])
    if facets == 1:  # more of them lie within the same wedges
        check_overlaps(blocks)
    sets = {f"voussoir {k + 1}": np.array([k]) for k in range(voussoirs)}
    sets |= {
        "voussoirs": np.arange(voussoirs),
        "keystone": crown(voussoirs),
        "left abutment": np.array([voussoirs]),
        "right abutment": np.array([voussoirs + 1]),
    }
    return Specimen(blocks, sets, section=thickness * depth, shape="arch")

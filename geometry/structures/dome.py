"""The dome: courses of voussoirs round an upright axis, cut from a spherical shell by joints that point at its centre.

The shell has flat facets: the corners of all joints stand on two spheres, at the same angles from course to course. Bed
joints lie in planes through the centre, one for each facet, as do head joints, which stand in planes through the axis.
With a bond a voussoir spans two facets, so that head joints stand at the middle of the voussoirs of the next course: it
is bent in the middle, and not convex. Without one it spans one facet, is convex, and head joints stand in line.
"""

import numpy as np

from geometry.blocks import GeometryError, Specimen
from geometry.checks import require_counts, require_lengths
from geometry.polyhedra.construct import from_faces
from geometry.structures.rings import require_ring

FACETS = {"running": 2, "stack": 1}
"""Facets that a voussoir spans in each bond."""


def dome(
    radius: float,
    thickness: float,
    courses: int,
    voussoirs: int,
    crown: float,
    angle: float = np.pi,
    bond: str = "running",
    closed: bool = True,
) -> Specimen:
    """A shell of voussoirs from its springing up to the radius `crown`, on a ring of blocks, the axis at x = y = 0.

    radius     m, of the sphere midway between intrados and extrados, its centre at z = 0
    thickness  m, less than the radius
    courses    from the springing to the crown, equally high
    voussoirs  in each course, 3 or more; in running bond each spans two of twice as many facets
    crown      m, from the axis, on the sphere midway: there the courses end
    angle      rad, of embrace, from springing to springing: up to pi for a hemisphere
    closed     whether one block, flat above and below, closes the crown; otherwise it is open

    Sets "voussoirs", "course 1" (at the springing), "course 2", ..., "keystone" (the block at the crown), "base" (a
    block below each facet of the springing, which goes on by half the thickness). The section is that of the springing.
    Raises GeometryError for what cannot be built.
    """
    _require(radius, thickness, courses, voussoirs, crown, angle, bond)
    span = FACETS[bond]
    sides = span * voussoirs
    steep = np.linspace(0.5 * angle, np.arcsin(crown / radius), courses + 1)
    corner = _corners(radius + thickness * np.array([-0.5, 0.5]), steep, sides)
    bodies = []
    for c in range(courses):
        first = c % 2 if span == 2 else 0
        for v in range(voussoirs):
            facets = (first + span * v + np.arange(span + 1)) % sides
            bodies.append(_body(corner[:, c : c + 2, facets]))
    count = len(bodies)
    if closed:
        bodies.append(_cap(corner[:, -1]))
    down = 0.5 * thickness * _along(steep[0], sides)
    for f in range(sides):
        facets = np.array([f, (f + 1) % sides])
        top = corner[:, 0, facets]
        bodies.append(_body(np.stack([top + down[facets], top], axis=1)))
    blocks = from_faces(bodies, list(range(len(bodies))), [0] * len(bodies), ("units",))
    sets = {"voussoirs": np.arange(count)}
    sets |= {f"course {c + 1}": c * voussoirs + np.arange(voussoirs) for c in range(courses)}
    sets |= {"keystone": np.array([count])} if closed else {}
    sets["base"] = count + closed + np.arange(sides)
    bed = 0.5 * np.linalg.norm(np.cross(corner[1, 0, 0], corner[1, 0, 1]) - np.cross(corner[0, 0, 0], corner[0, 0, 1]))
    return Specimen(blocks, sets, section=float(sides * bed), shape="dome")


def _corners(spheres: np.ndarray, steep: np.ndarray, sides: int) -> np.ndarray:
    """(2, C + 1, n, 3) m: on both spheres, at each angle from the axis (rad), round about."""
    azimuth = 2 * np.pi * np.arange(sides) / sides
    r, s, p = np.meshgrid(spheres, steep, azimuth, indexing="ij")
    level = np.where(np.abs(s - 0.5 * np.pi) < 1e-14, 0.0, np.cos(s))  # a hemisphere stands level
    return np.stack([r * np.sin(s) * np.cos(p), r * np.sin(s) * np.sin(p), r * level], axis=-1)


def _along(steep: float, sides: int) -> np.ndarray:
    """(n, 3) unit vectors down along the meridians at an angle from the axis (rad)."""
    azimuth = 2 * np.pi * np.arange(sides) / sides
    flat = 0.0 if abs(steep - 0.5 * np.pi) < 1e-14 else np.cos(steep)
    return np.stack([flat * np.cos(azimuth), flat * np.sin(azimuth), np.full(sides, -np.sin(steep))], axis=1)


def _body(corner: np.ndarray) -> list[np.ndarray]:
    """Faces of a voussoir with corners (2, 2, k + 1, 3): inner and outer, low and high, along its k facets."""
    (inner_low, inner_high), (outer_low, outer_high) = corner
    faces = []
    for k in range(corner.shape[2] - 1):
        a, b = k, k + 1
        faces += [
            np.stack([outer_low[a], outer_low[b], outer_high[b], outer_high[a]]),
            np.stack([inner_low[a], inner_high[a], inner_high[b], inner_low[b]]),
            np.stack([inner_low[a], inner_low[b], outer_low[b], outer_low[a]]),
            np.stack([inner_high[a], outer_high[a], outer_high[b], inner_high[b]]),
        ]
    for end, side in ((0, 1), (-1, -1)):
        face = np.stack([inner_low[end], outer_low[end], outer_high[end], inner_high[end]])
        faces.append(face[::side])
    return faces


def _cap(ring: np.ndarray) -> list[np.ndarray]:
    """Faces of the block in the crown, whose corners (2, n, 3) are those of the last course."""
    inner, outer = ring
    following = np.roll(np.arange(len(inner)), -1)
    sides = [np.stack([inner[a], inner[b], outer[b], outer[a]]) for a, b in enumerate(following)]
    return [*sides, outer, inner[::-1]]


def _require(
    radius: float, thickness: float, courses: int, voussoirs: int, crown: float, angle: float, bond: str
) -> None:
    require_lengths("dome", {"crown": crown})
    require_ring("dome", "courses", radius, angle, courses, thickness, minimum=1)
    require_counts("dome", "number of voussoirs", (voussoirs,), "x")
    if voussoirs < 3:
        raise GeometryError(f"dome: number of voussoirs is {voussoirs}, it must be 3 or more; nearest: 3")
    if bond not in FACETS:
        raise GeometryError(f"dome: bond '{bond}' is unknown; allowed: {', '.join(FACETS)}")
    springing = radius * np.sin(0.5 * angle)
    if crown >= springing:
        raise GeometryError(
            f"dome: crown is {crown:g} m, it must be less than the radius at the springing, {springing:.4g} m"
        )

"""Load that a joint bears at the peak, by its own contact points and by many: bent, sheared and twisted.

A joint moves in six ways. Its contact points have its area and its middle, so that all bear a normal force and a shear
force in the middle alike. They differ in bending about two axes, under the normal force of the joint
(`joint_sections.py`), and in a twist with its shears, under the pressures of the joint (`joint_planes.py`).
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from geometry.joints.faces.strips import NARROW, NARROWER, Section, depth_of, of_points, spread
from geometry.joints.point_density import Density
from masonry.assembly.assemble import Assembly
from masonry.estimates.bearing_points import points_of
from masonry.estimates.joint_faces import Faces, corners_of, is_elastic, law_of
from masonry.estimates.joint_loads import Look, Shear
from masonry.estimates.strength.joint_planes import PlanePoints, axes_across, borne_in_plane, shear_strengths, softening
from masonry.estimates.strength.joint_pressures import StressBounds, pressures
from masonry.estimates.strength.joint_sections import envelope, moments, strength
from masonry.rows.history import Frame

MANY, FEWER = 12, 4
"""Points along an edge that stand for a stress spread over the area, in its plane: within 0.1 % of 40 along each edge;
so few on each of many polygons that make up a face."""
FURTHER = 10.0
"""Times the opening at which a joint tears, up to which one that is whole could open were there more points."""
TURNED = 1e-3
"""Times the same opening, or its mean closing: a joint that has never opened further at one edge than at the other
does not bend."""
LEAST_ARM = 1.0 / 12.0
"""Of the depth of a joint: section modulus over area, of a triangle that opens from its tip; of a rectangle a sixth."""
SLID = 1e-3
"""Share of the work of sliding that is not elastic, from which on a joint has slid."""


class Borne(NamedTuple):
    """A joint in one of the two ways: its contacts, whether in its plane, whether it gave way; its shares (2,) of the
    work; what it carries at the peak over what it bears by many points; what points (n, 3) m with areas (n,) m2 bear
    over that; and of one that bends, the moments (A,) N m of such points, or of many, at multiples (A,) of its turn."""

    contacts: np.ndarray
    in_plane: bool
    gave: bool
    shares: np.ndarray
    carries: float
    by: Callable[[np.ndarray, np.ndarray], float]
    at: Callable[[np.ndarray, tuple[np.ndarray, np.ndarray] | None], np.ndarray] | None = None


def bent(
    assembly: Assembly, faces: Faces, now: Look, face: int, gave: bool, turns: tuple[float, float], shares: np.ndarray
) -> Borne | None:
    """A joint face that bends at the peak; None where it never turned, or neither gave way nor bears more than its
    elastic moment.

    turns  rad, its largest one, up to which it is asked, and that up to which it is asked where it is dry
    """
    length = float(np.linalg.norm(now.turn[face]))
    force = float(now.force[face])
    parameters, joint = law_of(assembly, faces, face)
    limit = float(joint.tensile_strength or 0.0)
    if length == 0.0 or is_elastic(joint) or (limit == 0.0 and force >= 0.0):
        return None
    middle, along = faces.middle[face], now.turn[face] / length
    corners, moment = corners_of(faces, face), abs(float(now.moment[face] @ along))
    depth, tears_at = depth_of(corners @ along), limit / faces.stiffness[face]
    closes, turn = -force / (faces.stiffness[face] * faces.area[face]), turns[0]
    if turn * depth <= TURNED * max(tears_at, closes) or (
        not gave and moment < LEAST_ARM * depth * (limit * faces.area[face] - force)
    ):
        return None
    is_dry = limit == 0.0 and joint.compressive_strength is None
    turn = turns[is_dry]
    many = _many_fibres(faces, face, along, is_dry, turn)
    if not gave:
        turn = max(turn, FURTHER * tears_at / many.depth)
    law = envelope(parameters, joint, 2.0 * turn * many.depth)
    bears = strength(many, law, force, moment, turn)
    if bears <= 0.0 or (not gave and moment <= bears):
        return None

    def own(point: np.ndarray, area: np.ndarray) -> Section:
        return of_points((point - middle) @ along, area)

    def by(point: np.ndarray, area: np.ndarray) -> float:
        return strength(own(point, area), law, force, moment, turn) / bears

    def at(times: np.ndarray, points: tuple[np.ndarray, np.ndarray] | None) -> np.ndarray:
        return moments(many if points is None else own(*points), law, force, moment, turn, times * length)

    return Borne(faces.contacts(face), False, gave, shares, moment / bears, by, at)


def _many_fibres(faces: Faces, face: int, along: np.ndarray, is_dry: bool, turn: float) -> Section:
    """A joint face across a direction; its very edges where it turns without end."""
    middle, corners = faces.middle[face], corners_of(faces, face)
    if np.isinf(turn):
        return of_points((corners - middle) @ along, np.ones(len(corners)))
    across = np.cross(faces.normal[face], along)
    return spread(faces.polygons[face], along, across, middle, NARROWER if is_dry else NARROW)


def by_many(polygons: list[np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """Places (n, 3) m and areas (n,) m2 that stand for a stress spread over convex polygons (K, 3) m."""
    return points_of(polygons, Density("gauss", max(round(MANY / len(polygons) ** 0.5), FEWER)))


def slid(
    assembly: Assembly, faces: Faces, now: Look, shear: Shear, frame: Frame, face: int, shares: np.ndarray
) -> Borne | None:
    """A joint face that is sheared at the peak; None where it has no limit, or bears what it carries by many points."""
    joints, contacts = assembly.joints, faces.contacts(face)
    parameters, joint = law_of(assembly, faces, face)
    if is_elastic(joint) or joint.shear_stiffness <= 0.0:
        return None
    normal, middle = faces.normal[face], faces.middle[face]
    axes = axes_across(normal)
    force, twist = axes @ shear.force[face], float(shear.twist[face])
    whole = 1.0 - float(np.average(frame.damage_tension[contacts], weights=joints.area[contacts]))
    left = joint._replace(cohesion=float(joint.cohesion or 0.0) * whole)
    bounds = StressBounds(
        float(joint.normal_stiffness),
        float(joint.tensile_strength or 0.0) * whole,
        float(joint.compressive_strength or np.inf),
    )
    pressed = max(-float(now.force[face]) / float(faces.area[face]), 0.0)
    farthest = float(frame.slip[contacts].max())
    law = softening(parameters, left, pressed, 2.0 * farthest)

    def bears(point: np.ndarray, area: np.ndarray) -> float:
        place = (point - middle) @ axes.T
        on = pressures(place, area, bounds, float(now.force[face]), axes @ now.moment[face])
        return borne_in_plane(PlanePoints(place, area, *shear_strengths(left, on)), law, force, twist, farthest)

    many = bears(*by_many(faces.polygons[face]))
    gave = bool(now.inelastic.sliding[face] > SLID * now.work.sliding[face])
    if not 0.0 < many < np.inf or (not gave and many >= 1.0):
        return None
    return Borne(contacts, True, gave, shares, 1.0 / many, lambda point, area: bears(point, area) / many)

"""Joints that twist in a mechanism: at their corners alone they bear more friction than an even pressure does.

A pressure may lie at the corners, so that a limit analysis is right to reckon with it; stresses that follow the
stiffness of a joint do not. The factor is too high by the sum over the joints of the error of what they bear in their
plane (`estimates/strength/joint_planes.py`) times their share of the work, as that of a run is (`few_points`).
"""

import numpy as np

from geometry.joints.faces.whole_faces import first_patches, middles
from masonry.estimates.strength.joint_motions import by_many
from masonry.estimates.strength.joint_planes import PlanePoints, ShearCurve, axes_across, borne_in_plane
from masonry.estimates.strength.joint_pressures import StressBounds, pressures
from masonry.limit_analysis.limit_data import LimitData
from masonry.statics.problem import STEEP, RigidBodies, RigidContacts

TOLD, TWISTS, MOST = 0.015, 1e-3, 200
"""Share of a factor from which on it is told; share of the work of the load from which on a twist counts; joints that
are looked at, those that take the most of it."""
STIFF = 1e10
"""Pa/m, of all joints, as only how stresses are shared out in one of them counts."""


def say_of_twists(result: LimitData, bodies: RigidBodies, contacts: RigidContacts) -> None:
    """A word where joints that twist make a factor too high."""
    less = _lost(result, bodies, contacts)
    if less > TOLD:
        result.remarks.append(
            "joints twist in this mechanism, and pressed at their corners alone they bear more friction than pressed "
            f"as their stiffness shares it out: it may fall at about {100.0 * less:.2g} % less; a run with "
            "specimen.points_per_edge = 6 tells"
        )


def _lost(result: LimitData, bodies: RigidBodies, contacts: RigidContacts) -> float:
    """The share of the factor that stresses which are spread over the joints do not bear."""
    joints = result.joints
    work = abs(result.factor * float((bodies.live * result.velocity).sum()))
    if not (len(joints.area) and 0.0 < work < np.inf):
        return 0.0
    a, b, normal = joints.block_a, joints.block_b, joints.normal
    apart = result.velocity_at(b, joints.point) - result.velocity_at(a, joints.point)
    spin = np.abs(np.einsum("ci,ci->c", result.velocity[b, 3:] - result.velocity[a, 3:], normal))
    heads = first_patches(joints)
    faces, first, of = np.unique(heads[joints.patch], return_index=True, return_inverse=True)
    polygons = np.split(joints.patch_points, joints.patch_start[1:-1])
    middle = middles(joints, of, len(faces))[1]
    twist = np.bincount(of, np.einsum("ci,ci->c", normal, np.cross(joints.point - middle[of], result.shear)))
    fraction = np.bincount(of, np.abs(np.einsum("ci,ci->c", result.shear, apart))) / work
    counts = np.abs(twist) * spin[first] / work >= TWISTS
    lost = 0.0
    for face in np.argsort(-fraction)[:MOST]:
        points = np.flatnonzero(of == face)
        if counts[face] and contacts.friction[points].any() and not contacts.solid[points].any():
            parts = [polygons[patch] for patch in np.flatnonzero(heads == faces[face])]
            times = _times(result, contacts, points, parts, middle[face], float(twist[face]))
            lost += fraction[face] * max(1.0 - 1.0 / times, 0.0)
    return float(lost)


def _times(
    result: LimitData,
    contacts: RigidContacts,
    points: np.ndarray,
    polygons: list[np.ndarray],
    middle: np.ndarray,
    twist: float,
) -> float:
    """Ratio of the load of a joint in its plane to the load borne there by stresses that are spread over it."""
    joints, normal = result.joints, result.joints.normal[points[0]]
    axes = axes_across(normal)
    point, area = by_many(polygons)
    place, whole = (point - middle) @ axes.T, float(area.sum())
    tension = min(float(contacts.tension[points].sum()) / whole, STIFF)
    force = -float(result.normal[points].sum())
    moment = -axes @ (result.normal[points] @ (joints.point[points] - middle))
    pressed = pressures(place, area, StressBounds(STIFF, tension, np.inf), force, moment)
    tan, cohesion = min(float(contacts.friction[points[0]]), STEEP), float(contacts.cohesion[points].sum()) / whole
    strong = np.maximum(cohesion + tan * pressed, 0.0)
    perfect = ShearCurve(STIFF, np.array([0.0, 1.0]), np.ones(2))
    bears = borne_in_plane(
        PlanePoints(place, area, strong, strong), perfect, axes @ result.shear[points].sum(axis=0), twist, 0.0
    )
    return 1.0 / bears if bears > 0.0 else 1.0

"""Strength of a joint in its plane, two shears and a twist about its normal: by its few contact points, and by many.

Points slide as those of a rigid plate do. Each has the stress of its law at its slip, along that slip. A shear force
and a twist that grow together are borne up to a multiple, the largest of all sizes of the slide.
"""

from typing import Any, NamedTuple

import numpy as np

from masonry.laws.law_dispatch import shear_intact
from masonry.laws.state import JointProperties

SIZES, NEARER, ROUNDS, CURVE = 20, 6, 40, 60
"""Sizes of slides that are looked at, over all and beside the one by which most is borne; rounds that look for each
slide; points of the softening."""
FURTHEST, LITTLE = 1e3, 1e-3
"""Times the slip at which the strongest point yields: without softening all that can slide does so by then. Of its
strength: points of less are not looked at for where they yield first."""
TINY = 1e-9
"""Of a stiffness, of a strength: none."""


class PlanePoints(NamedTuple):
    """Points of a joint: place (n, 2) m from its middle, area (n,) m2, shear strength (n,) Pa at first, and what is
    left of it at last."""

    place: np.ndarray
    area: np.ndarray
    peak: np.ndarray
    residual: np.ndarray


class ShearCurve(NamedTuple):
    """Shear stiffness Pa/m; share (E,) of the strength above the residual that is left at a slip (E,) m beyond the
    elastic one."""

    stiffness: float
    slip: np.ndarray
    left: np.ndarray


def axes_across(normal: np.ndarray) -> np.ndarray:
    """(2, 3) two directions in a plane, at right angles, that turn about its normal."""
    first = np.cross(normal, np.eye(3)[int(np.argmin(np.abs(normal)))])
    first /= np.linalg.norm(first)
    return np.array([first, np.cross(normal, first)])


def softening(parameters: Any, joint: JointProperties, pressure: float, farthest: float) -> ShearCurve:
    """Of a law with numbers of one contact under a pressure (Pa), up to a slip (m)."""
    peak, residual = shear_strengths(joint, np.array([pressure]))
    slip = np.concatenate([[0.0], np.geomspace(1e-4, 1.0, CURVE) * max(farthest, 1e-12)])
    left = np.ones(len(slip))
    if peak[0] > residual[0]:
        with np.errstate(all="ignore"):
            at = (float(peak[0]), float(residual[0]), float(pressure))
            left[1:] = [float(shear_intact(parameters, joint, 1.0, s, *at)) for s in slip[1:]]
    return ShearCurve(float(joint.shear_stiffness), slip, np.clip(np.nan_to_num(left), 0.0, 1.0))


def shear_strengths(joint: JointProperties, pressure: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Pa under pressures (n,) Pa, at first and what is left; without limit where the law is elastic."""
    if joint.tensile_strength is None and joint.tan_friction is None:
        return np.full(len(pressure), np.inf), np.full(len(pressure), np.inf)
    tan, cohesion = float(joint.tan_friction or 0.0), float(joint.cohesion or 0.0)
    left = tan if joint.tan_residual_friction is None else float(joint.tan_residual_friction)
    peak = np.maximum(cohesion + tan * pressure, 0.0)
    return peak, np.minimum(float(joint.residual_cohesion or 0.0) + left * np.maximum(pressure, 0.0), peak)


def borne_in_plane(plane: PlanePoints, law: ShearCurve, force: np.ndarray, twist: float, farthest: float) -> float:
    """The largest multiple of a shear force (2,) N and a twist (N m) that points bear, up to a slip (m)."""
    length = float(np.sqrt(plane.area.sum()))
    x, y = (plane.place / length).T
    load = np.array([force[0], force[1], twist / length])
    size = float(np.linalg.norm(load))
    if size == 0.0 or plane.peak.max(initial=0.0) <= 0.0:
        return np.inf if size == 0.0 else 0.0
    if not np.isfinite(plane.peak).all():
        return np.inf
    load = load / size
    sums = np.column_stack([np.ones(len(x)), x, y, x * x + y * y])
    slips = _slips(_slides((law.stiffness * plane.area) @ sums[None], load, np.ones(1)), x, y)[0]
    bears = plane.peak > LITTLE * plane.peak.max()
    yields = plane.peak[bears] / (law.stiffness * np.maximum(slips[bears], TINY * slips.max()))
    last = max(FURTHEST * float(plane.peak.max()) / law.stiffness, farthest) / float(slips.max())
    sizes = np.geomspace(float(yields.min()), max(last, 2.0 * float(yields.min())), SIZES)
    borne = _multiples(plane, law, sums, load, sizes, x, y)
    most = int(np.argmax(borne))
    nearer = np.geomspace(sizes[max(most - 1, 0)], sizes[min(most + 1, SIZES - 1)], NEARER)
    return float(max(borne[most], _multiples(plane, law, sums, load, nearer, x, y).max())) / size


def _multiples(
    plane: PlanePoints,
    law: ShearCurve,
    sums: np.ndarray,
    load: np.ndarray,
    sizes: np.ndarray,
    x: np.ndarray,
    y: np.ndarray,
) -> np.ndarray:
    """(D,) N, of a load (3,) of length 1, that points bear at slides of sizes (D,) m along it."""
    weight = np.tile(law.stiffness * plane.area, (len(sizes), 1))
    for _ in range(ROUNDS):
        slip = _slips(_slides(weight @ sums, load, sizes), x, y)
        secant = _stress(plane, law, slip) / np.maximum(slip, TINY * slip.max(axis=1, keepdims=True))
        weight = plane.area * np.maximum(secant, TINY * law.stiffness)  # what bears nothing any more slides evenly
    slide = _slides(weight @ sums, load, sizes)
    slip = _slips(slide, x, y)
    works = (plane.area * _stress(plane, law, slip) * slip).sum(axis=1)
    return np.asarray(works / sizes)


def _stress(plane: PlanePoints, law: ShearCurve, slip: np.ndarray) -> np.ndarray:
    """(D, n) Pa, of points at slips (D, n) m."""
    beyond = np.maximum(slip - plane.peak / law.stiffness, 0.0)
    left = np.interp(beyond, law.slip, law.left)
    return np.minimum(law.stiffness * slip, plane.residual + left * (plane.peak - plane.residual))


def _slides(sums: np.ndarray, load: np.ndarray, sizes: np.ndarray) -> np.ndarray:
    """(D, 3) m, two shifts and a turn times a length, that a plate on springs makes of a load, as far as sizes (D,)
    say along it; sums (D, 4) N/m of the springs, of them times x, times y, times the square of the distance."""
    all_, sx, sy, polar = sums.T
    zero = np.zeros_like(all_)
    matrix = np.array([[all_, zero, -sy], [zero, all_, sx], [-sy, sx, polar]]).transpose(2, 0, 1)
    matrix += TINY * all_[:, None, None] * np.eye(3)
    slide = np.linalg.solve(matrix, np.broadcast_to(load, (len(sums), 3))[:, :, None])[:, :, 0]
    return np.asarray(slide * (sizes / (slide @ load))[:, None])


def _slips(slide: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """(D, n) m of points at places x and y, over a length."""
    return np.hypot(slide[:, :1] - slide[:, 2:] * y, slide[:, 1:2] + slide[:, 2:] * x)

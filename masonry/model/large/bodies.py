"""The bodies of a model for large displacements, made from those for small ones: the same blocks, sides and loads."""

from typing import Any

import numpy as np

from masonry.kinematics.affine import Affine
from masonry.kinematics.deforming import Deforming
from masonry.kinematics.deforming_tets import DeformingTets, mean_slopes
from masonry.kinematics.rigid import Rigid
from masonry.kinematics.tets import Tets
from masonry.kinematics.turning import Turning
from masonry.model.body_arrays import Bodies, in_rows


def large(bodies: Bodies, inertia: np.ndarray, apart: np.ndarray | None = None) -> Bodies:
    """Bodies that turn and deform as far as they like, at the start of their motion.

    inertia  (B, 3) kg m2 of the rigid blocks about their principal axes, of held ones too
    apart    rows like the contacts' forces, which the sweep fills with u_b - u_a; or None
    """
    rigid, affine, tets = bodies
    return Bodies(
        None if rigid is None else turning(rigid, inertia, apart),
        None if affine is None else deforming(affine, apart),
        None if tets is None else deforming_tets(tets, apart),
    )


def turning(body: Rigid, inertia: np.ndarray, apart: np.ndarray | None) -> Turning:
    """Rigid blocks that turn. Moments of loads and expected turns, along the block's axes, become global."""
    count = len(body.q)
    return Turning(
        **_common(body, ("q", "arm", "first_point", "axes")),
        frame=np.tile(np.eye(3), (count, 1, 1)),
        momentum=np.zeros((count, 3)),
        inertia=np.ascontiguousarray(inertia),
        load=_moments_turned_out(body.load, body.axes),
        change=_moments_turned_out(body.change, body.axes),
        guess=_moments_turned_out(body.guess, body.axes),
        apart=apart,
    )


def deforming(body: Affine, apart: np.ndarray | None) -> Deforming:
    """Affine blocks that turn and deform."""
    return Deforming(
        **_common(body, ("q", "arm", "first_point", "axes", "stiffness", "load", "change", "guess")),
        inner=in_rows(np.zeros(body.q.shape)),
        frame=np.tile(np.eye(3), (len(body.q), 1, 1)),
        apart=apart,
    )


def deforming_tets(body: Tets, apart: np.ndarray | None, framed: bool = True) -> DeformingTets:
    """Blocks of tets that turn and deform; without frames where nobody asks for them."""
    root = 6.0 * np.linalg.det(body.slope.transpose(0, 2, 1).reshape(-1, 8, 3, 3))  # sqrt(V), see tets.py
    slope = body.slope / np.where(root > 0.0, root, 1.0)[:, None, :]
    volume = root**2
    frames: dict[str, Any] = {}
    if framed:
        frames["frame"] = np.tile(np.eye(3), (len(body.lame), 1, 1))
        frames["mean_slope"] = in_rows(mean_slopes(len(body.v), body.corner, slope, volume, body.node_start))
    between = ("corner_between", "fraction_between", "start_between", "first_between")
    by_node = ("pull_start", "pull_code", "pull_fraction")
    names = ("inner", "node_start", "group_start", "corner", "lame", "load", "change", "guess", *between, *by_node)
    return DeformingTets(**_common(body, names), slope=slope, volume=volume, apart=apart, **frames)


def _common(body: Any, names: tuple[str, ...]) -> dict[str, Any]:
    """Fields that stay, and the account of works with room for a fourth."""
    work = None if body.work is None else np.zeros((len(body.work), 4))
    fields = ("v", "dt_over_mass", "contact", "hold", "start", "code", *names)
    return {"work": work, **{name: getattr(body, name) for name in fields}}


def _moments_turned_out(values: np.ndarray | None, axes: np.ndarray | None) -> np.ndarray | None:
    """(B, 6) with the last three along the principal axes -> the same along x, y, z."""
    if values is None or axes is None:
        return values
    return in_rows(np.concatenate([values[:, :3], np.einsum("bij,bj->bi", axes, values[:, 3:])], axis=1))

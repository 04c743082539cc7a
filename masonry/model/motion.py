"""Blocks that start in motion: their velocities on the dofs, and the work that set them off."""

from typing import Any

import numpy as np

from masonry.kinematics.turning import spin
from masonry.model.layout import KINDS, Layout
from masonry.model.model import Model


def velocities_of(
    layout: Layout, kind: str, rows: np.ndarray, velocity: np.ndarray, spin: np.ndarray, about: np.ndarray
) -> np.ndarray:
    """(n, dofs) of a rigid motion on rows of a kind: velocity (3,) m/s of the point `about` (3,) m, and spin (3,)
    rad/s, in the dofs that v of these bodies has.

    Rigid: velocity of the centroid along x, y, z, spin about the block's principal axes. Affine: velocity of the
    centroid, then the rate of the gradient, rows along x, y, z and columns along the principal axes. Tets: velocity of
    each node.
    """
    if kind == "tets":
        assert layout.mesh is not None
        return np.asarray(velocity + np.cross(spin, layout.mesh.nodes[rows] - about))
    block = layout.members[kind][rows]
    axes = layout.axes[block]
    moves = velocity + np.cross(spin, layout.centroid[block] - about)
    if kind == "rigid":
        return np.concatenate([moves, np.einsum("bji,j->bi", axes, spin)], axis=1)
    gradient = np.cross(spin, axes, axisb=1, axisc=1)
    return np.concatenate([moves, gradient.reshape(-1, 9)], axis=1)


def rows_of(layout: Layout, kind: str, chosen: np.ndarray) -> np.ndarray:
    """The rows of a kind that belong to some blocks (n,): blocks of that kind, or nodes of tets."""
    inside = chosen[layout.kind[chosen] == KINDS.index(kind)]
    if kind != "tets":
        return layout.local[inside]
    if layout.mesh is None:
        return np.zeros(0, dtype=np.int64)
    start = layout.mesh.node_start
    return np.concatenate([np.zeros(0, dtype=np.int64), *(np.arange(start[b], start[b + 1]) for b in inside)])


def begin(model: Model, load_factors: np.ndarray | None, loaded: bool) -> None:
    """Set off what starts in motion in a run without settling. Dead loads that act at once (`loaded`) give all that is
    free half a step of themselves, so that velocities are those in the middle of the first step.

    load_factors  (H,) of the loads that vary as the run begins; None without any
    """
    blows = {} if model.motion is None else {kind: blow.copy() for kind, blow in model.motion.items()}
    for kind, body in _present(model):
        if not loaded or body.load is None:
            continue
        load = body.load.copy()
        for load_factor, varying in zip(() if load_factors is None else load_factors, model.varying, strict=True):
            load += 0.0 if varying[kind] is None else load_factor * varying[kind]
        blows[kind] = blows.get(kind, 0.0) + 0.5 * body.dt_over_mass * load
    _strike(model, blows, [body.v.copy() for _, body in _present(model)])


def set_off(model: Model, before: list[np.ndarray]) -> None:
    """Add the velocities with which blocks start, once the dead loads have settled.

    before  velocities one step earlier, in the order of the bodies that there are
    """
    _strike(model, model.motion or {}, before)


def _strike(model: Model, blows: dict[str, np.ndarray], before: list[np.ndarray]) -> None:
    """Add to velocities, by kind (rows, dofs); the work of the blow that does this is booked as external work.

    The kinetic energy of a row is v(n-1/2) M v(n+1/2) / 2, and the forces of this step do half of their work with the
    velocity after it: a blow dv between them adds v' M v' / 2 - v M v / 2 - (v - v(n-1/2)) M dv / 2, with v' = v + dv.
    """
    for (kind, body), old in zip(_present(model), before, strict=True):
        if (blow := blows.get(kind)) is None:
            continue
        rotates = model.large is not None and kind == "rigid"
        if rotates:
            blow = blow.copy()
            blow[:, 3:] = np.einsum("bij,bj->bi", model.layout.axes[model.layout.members[kind]], blow[:, 3:])
        energy = model.masses[kind] * blow * (body.v + 0.5 * blow - 0.5 * (body.v - old))
        body.v[...] += blow
        if rotates:  # blocks that turned before start from their momentum, which has no masses
            had = 0.5 * np.einsum("bi,bi->b", body.momentum, body.v[:, 3:] - blow[:, 3:])
            spin(body)
            energy[:, 3:] = 0.0
            energy[:, 3] = 0.5 * np.einsum("bi,bi->b", body.momentum, body.v[:, 3:]) - had
        _book(body, energy.sum(axis=1))


def _present(model: Model) -> list[tuple[str, Any]]:
    return [(kind, body) for kind, body in zip(KINDS, model.bodies, strict=True) if body is not None]


def _book(body: Any, energy: np.ndarray) -> None:
    """External work (J) of each row; that of nodes, which are not told apart by block, in the first account."""
    if len(energy) == len(body.work):
        body.work[:, 2] += energy
    else:
        body.work[0, 2] += energy.sum()

"""Equilibrium of rigid blocks as a sparse matrix: what forces at contact points do to the dofs of the blocks."""

from dataclasses import dataclass

import numpy as np
from scipy import sparse

from masonry.statics.problem import Bodies, Contacts


@dataclass(frozen=True)
class Equilibrium:
    """normal N + shear T + dead + factor live = 0, without units: forces over `force`, moments over `force length`.

    normal   (R, C) of a unit normal force at each contact point, on block b, and against it on block a
    shear    (R, G k) of unit shear forces, group by group
    group    (C,) the group whose shear forces a contact point can bear a part of
    leader   (G,) a contact point of each group, at which its shear forces act
    tangent  (G, k, 3) their directions: one in a plane, two in space
    dead, live  (R,)
    rows     (R, 6 B) sparse, from dofs of all blocks (with units of length) to the R equations
    force    N, and `live_force` N, of which `live` is made
    length   m
    """

    normal: sparse.csr_array
    shear: sparse.csr_array
    group: np.ndarray
    leader: np.ndarray
    tangent: np.ndarray
    dead: np.ndarray
    live: np.ndarray
    rows: sparse.csr_array
    force: float
    live_force: float
    length: float


def equilibrium(bodies: Bodies, contacts: Contacts, axis: int | None = None) -> Equilibrium:
    """The equations of all dofs that nothing holds; axis: across the plane of a plane problem, None in space.

    In a plane all shear forces of one polygon act along one line, and are one force.
    """
    arm = contacts.point - bodies.centre[contacts.block_b]
    length = float(np.sqrt((arm**2).sum(axis=1).mean())) if contacts.count else 1.0
    rows = _rows(bodies, axis, length)
    tangent, group, leader = _tangents(contacts, axis)
    normal = _wrenches(bodies, contacts, np.arange(contacts.count), contacts.normal)
    k = tangent.shape[1]
    shear = _wrenches(bodies, contacts, np.repeat(leader, k), tangent.reshape(-1, 3))
    force, live_force = _mean_force(bodies.dead), _mean_force(bodies.live)
    strength = float(contacts.cohesion.mean()) if contacts.count else 0.0
    force = force or strength or live_force or 1.0
    live_force = live_force or 1.0
    return Equilibrium(
        normal=(rows @ normal).tocsr(),
        shear=(rows @ shear).tocsr(),
        group=group,
        leader=leader,
        tangent=tangent,
        dead=rows @ bodies.dead.ravel() / force,
        live=rows @ bodies.live.ravel() / live_force,
        rows=rows,
        force=force,
        live_force=live_force,
        length=length,
    )


def _mean_force(load: np.ndarray) -> float:
    """N, mean over the blocks that are loaded; of a pure moment its size."""
    size = np.abs(load).max(axis=1, initial=0.0)
    return float(size[size > 0].mean()) if (size > 0).any() else 0.0


def _rows(bodies: Bodies, axis: int | None, length: float) -> sparse.csr_array:
    """(R, 6 B): picks the free dofs, adds up those that move together, and divides moments by the length."""
    free = bodies.free.copy()
    if axis is not None:
        free[:, [k for k in range(6) if (k == axis) or (k >= 3 and k != 3 + axis)]] = False
    row = np.full(free.shape, -1)
    linked = np.zeros_like(free) if bodies.together is None else bodies.together & free
    alone = free & ~linked
    row[alone] = np.arange(alone.sum())
    count = int(alone.sum())
    if linked.any():
        row[linked] = count
        count += 1
    used = np.flatnonzero(row.ravel() >= 0)
    scale = np.tile([1.0, 1.0, 1.0, 1 / length, 1 / length, 1 / length], len(free))
    return sparse.csr_array((scale[used], (row.ravel()[used], used)), shape=(count, free.size))


def _tangents(contacts: Contacts, axis: int | None) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Directions (G, k, 3) of shear, group of each contact (C,), and a contact of each group (G,)."""
    if axis is not None:
        _, leader, group = np.unique(contacts.patch, return_index=True, return_inverse=True)
        return np.cross(np.eye(3)[axis], contacts.normal[leader])[:, None], group.ravel(), leader
    every = np.arange(contacts.count)
    least = np.eye(3)[np.argmin(np.abs(contacts.normal), axis=1)]
    first = np.cross(contacts.normal, least)
    first /= np.linalg.norm(first, axis=1, keepdims=True)
    return np.stack([first, np.cross(contacts.normal, first)], axis=1), every, every


def _wrenches(bodies: Bodies, contacts: Contacts, which: np.ndarray, direction: np.ndarray) -> sparse.csr_array:
    """(6 B, n): what unit forces in directions (n, 3) at contact points `which` (n,) do to the two blocks of each."""
    parts = []
    for block, sign in ((contacts.block_a[which], -1.0), (contacts.block_b[which], 1.0)):
        moment = np.cross(contacts.point[which] - bodies.centre[block], direction)
        wrench = sign * np.concatenate([direction, moment], axis=1)
        row = 6 * block[:, None] + np.arange(6)
        parts.append((wrench.ravel(), row.ravel(), np.repeat(np.arange(len(which)), 6)))
    value, row, column = (np.concatenate(arrays) for arrays in zip(*parts, strict=True))
    return sparse.csr_array((value, (row, column)), shape=(bodies.free.size, len(which)))

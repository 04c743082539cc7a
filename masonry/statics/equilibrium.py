"""Equilibrium of rigid blocks as a sparse matrix: what forces at contact points do to the dofs of the blocks."""

from dataclasses import dataclass

import numpy as np
from scipy import sparse

from masonry.statics.problem import RigidBodies, RigidContacts, Sizes


@dataclass(frozen=True)
class Equilibrium:
    """normal N + shear T + dead + factor live = 0, without units: in those of each block and each contact.

    normal   (R, C) of a unit normal force at each contact point, on block b, and against it on block a
    shear    (R, G k) of unit shear forces, group by group
    group    (C,) the group whose shear forces a contact point can bear a part of
    leader   (G,) a contact point of each group, at which its shear forces act
    tangent  (G, k, 3) their directions: one in a plane, two in space
    dead, live  (R,)
    rows     (R, 6 B) sparse, from loads of all blocks (N and N m) to the R equations
    block, moment  (R,) the block of each equation, the first one where several move as one; whether it is of moments
    force    (C,) N, unit of the forces of each contact point: of a group, all have one
    factor   that counts as 1
    """

    normal: sparse.csr_array
    shear: sparse.csr_array
    group: np.ndarray
    leader: np.ndarray
    tangent: np.ndarray
    dead: np.ndarray
    live: np.ndarray
    rows: sparse.csr_array
    block: np.ndarray
    moment: np.ndarray
    force: np.ndarray
    factor: float


def equilibrium(bodies: RigidBodies, contacts: RigidContacts, sizes: Sizes, axis: int | None = None) -> Equilibrium:
    """The equations of all dofs that nothing holds; axis: across the plane of a plane problem, None in space.

    In a plane all shear forces of one polygon act along one line, and are one force. A contact has the unit of the
    smaller one of its blocks that move.
    """
    rows, block, moment = _rows(bodies, axis, sizes)
    tangent, group, leader = _tangents(contacts, axis)
    normal = _wrenches(bodies, contacts, np.arange(contacts.count), contacts.normal)
    k = tangent.shape[1]
    shear = _wrenches(bodies, contacts, np.repeat(leader, k), tangent.reshape(-1, 3))
    moving = np.where(bodies.free.any(axis=1), sizes.force, np.inf)
    force = np.minimum(moving[contacts.block_a], moving[contacts.block_b])
    force = np.where(np.isfinite(force), force, sizes.force[contacts.block_a])
    return Equilibrium(
        normal=(rows @ normal @ sparse.diags_array(force)).tocsr(),
        shear=(rows @ shear @ sparse.diags_array(np.repeat(force[leader], k))).tocsr(),
        group=group,
        leader=leader,
        tangent=tangent,
        dead=rows @ bodies.dead.ravel(),
        live=sizes.factor * (rows @ bodies.live.ravel()),
        rows=rows,
        block=block,
        moment=moment,
        force=force,
        factor=sizes.factor,
    )


def _rows(bodies: RigidBodies, axis: int | None, sizes: Sizes) -> tuple[sparse.csr_array, np.ndarray, np.ndarray]:
    """(R, 6 B): picks the free dofs, adds up those that move together, and divides by force and length of the block;
    the block of each row (R,), and whether it is of moments (R,)."""
    free = bodies.free.copy()
    if axis is not None:
        free[:, [k for k in range(6) if (k == axis) or (k >= 3 and k != 3 + axis)]] = False
    row = np.full(free.shape, -1)
    linked = np.zeros_like(free) if bodies.together is None else bodies.together & free
    alone = free & ~linked
    row[alone] = np.arange(alone.sum())
    count = int(alone.sum())
    unit = sizes.force[:, None] * np.column_stack([np.ones((len(free), 3)), np.tile(sizes.length[:, None], 3)])
    if linked.any():
        row[linked] = count
        unit[linked] = unit[linked].max()
        count += 1
    used = np.flatnonzero(row.ravel() >= 0)
    number = row.ravel()[used]
    first = np.zeros(count, dtype=np.int64)
    first[number[::-1]] = used[::-1]
    return (
        sparse.csr_array((1.0 / unit.ravel()[used], (number, used)), shape=(count, free.size)),
        first // 6, first % 6 >= 3,
    )  # fmt: skip


def _tangents(contacts: RigidContacts, axis: int | None) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Directions (G, k, 3) of shear, group of each contact (C,), and a contact of each group (G,)."""
    if axis is not None:
        _, leader, group = np.unique(contacts.patch, return_index=True, return_inverse=True)
        return np.cross(np.eye(3)[axis], contacts.normal[leader])[:, None], group.ravel(), leader
    every = np.arange(contacts.count)
    reference = np.eye(3)[np.argmin(np.abs(contacts.normal), axis=1)]
    first = np.cross(contacts.normal, reference)
    first /= np.linalg.norm(first, axis=1, keepdims=True)
    return np.stack([first, np.cross(contacts.normal, first)], axis=1), every, every


def _wrenches(
    bodies: RigidBodies, contacts: RigidContacts, which: np.ndarray, direction: np.ndarray
) -> sparse.csr_array:
    """(6 B, n): what unit forces in directions (n, 3) at contact points `which` (n,) do to the two blocks of each."""
    parts = []
    for block, sign in ((contacts.block_a[which], -1.0), (contacts.block_b[which], 1.0)):
        moment = np.cross(contacts.point[which] - bodies.centre[block], direction)
        wrench = sign * np.concatenate([direction, moment], axis=1)
        row = 6 * block[:, None] + np.arange(6)
        parts.append((wrench.ravel(), row.ravel(), np.repeat(np.arange(len(which)), 6)))
    value, row, column = (np.concatenate(arrays) for arrays in zip(*parts, strict=True))
    return sparse.csr_array((value, (row, column)), shape=(bodies.free.size, len(which)))

"""Plane problems in space: blocks that are alike on both sides of a plane, loaded in it, need no third direction."""

from dataclasses import replace

import numpy as np
from scipy import sparse

from masonry.statics.problem import RigidBodies, RigidContacts

FLAT = 1e-9
"""Share of the size, or of the largest load of a block, below which what leaves the plane counts as none."""


def plane_of(bodies: RigidBodies, contacts: RigidContacts) -> int | None:
    """The axis 0, 1 or 2 across the plane of a problem; None if it has none.

    All centres of blocks that can move lie in the plane, no load leaves it, no contact looks along the axis, and the
    points of each polygon that lie behind each other have their middle, by area, in the plane. What is found in the
    plane then balances in space, by pressures in proportion to the areas; and where both halves are mirror images,
    nothing in space is better, since the mean of a solution and its image lies in the plane.
    """
    for axis in (1, 0, 2):
        if _is_plane(bodies, contacts, axis):
            return axis
    return None


def _is_plane(bodies: RigidBodies, contacts: RigidContacts, axis: int) -> bool:
    moves = bodies.free.any(axis=1)
    if not moves.any() or contacts.count == 0:
        return False
    size = float(np.ptp(contacts.point, axis=0).max())
    level = float(bodies.centre[moves, axis].mean())
    if np.abs(bodies.centre[moves, axis] - level).max() > FLAT * size:
        return False
    if np.abs(contacts.normal[:, axis]).max() > FLAT:
        return False
    out_of_plane = [axis, *(k for k in (3, 4, 5) if k != 3 + axis)]
    for load in (np.abs(bodies.dead[moves]), np.abs(bodies.live[moves])):
        if (load[:, out_of_plane].max(axis=1) > FLAT * load.max(axis=1) * max(1.0, size)).any():
            return False
    if bodies.together is not None and bodies.together[:, out_of_plane].any():
        return False
    _, owner = flattened(contacts, axis)
    moment = np.bincount(owner, contacts.area * (contacts.point[:, axis] - level))
    return bool((np.abs(moment) <= FLAT * size * np.bincount(owner, contacts.area)).all())


def flattened(contacts: RigidContacts, axis: int) -> tuple[RigidContacts, np.ndarray]:
    """Points of a polygon that lie behind each other along an axis made one, and the number of each in it (C,)."""
    size = max(float(np.ptp(contacts.point, axis=0).max()), 1e-300)
    across = [k for k in range(3) if k != axis]
    place = np.rint(contacts.point[:, across] / (1e-7 * size) + 0.137)  # no coordinate that people give lies on a seam
    _, first, owner = np.unique(
        np.column_stack([contacts.patch, place]), axis=0, return_index=True, return_inverse=True
    )
    owner = owner.ravel()
    total = {name: np.bincount(owner, getattr(contacts, name)) for name in ("area", "cohesion", "tension")}
    if contacts.limit is not None and contacts.pretension is not None:
        total |= {name: np.bincount(owner, getattr(contacts, name)) for name in ("limit", "pretension")}
    if (crush := contacts.crush) is not None:
        fraction = contacts.area / total["area"][owner]
        crush = crush.merged(sparse.csr_array((fraction, (np.arange(contacts.count), owner))))
    return replace(contacts.select(first), **total, crush=crush), owner

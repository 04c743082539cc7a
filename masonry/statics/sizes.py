"""In what units the equilibrium of each block is written: one for all, or what each block itself weighs and bears.

A solver has one tolerance for all rows. In one unit for all, a pebble on a boulder lies below it, and may float. So a
solution is looked at block by block, and where one is not balanced, all is written anew in the units of each.
"""

import numpy as np

from masonry.statics.problem import RigidBodies, RigidContacts, Sizes


def alike(bodies: RigidBodies, contacts: RigidContacts) -> Sizes:
    """One for all: the mean load of a block, or where nothing is loaded a strength; the mean arm of a contact."""
    arm = contacts.point - bodies.centre[contacts.block_b]
    length = float(np.sqrt((arm**2).sum(axis=1).mean())) if contacts.count else 1.0
    strength = float(contacts.cohesion.mean()) if contacts.count else 0.0
    force = _mean_force(bodies.dead) or strength or _mean_force(bodies.live) or 1.0
    count = len(bodies.centre)
    size = np.full(count, length)
    dead = _size(bodies.dead, size)
    return Sizes(np.full(count, force), size, _factor(bodies, np.where(dead > 0.0, dead, force), size))


def of_each(
    bodies: RigidBodies, contacts: RigidContacts, factor: float, normal: np.ndarray, shear: np.ndarray
) -> Sizes:
    """Of each block its loads, or the forces at its contacts where they are more, as far as they are known; its arms.

    normal (C,) and shear (C, 3) N of a first solution at a factor; all of them 0 without one
    """
    length = own_lengths(bodies, contacts)
    loads = own_loads(bodies, contacts, factor, length)
    through = np.hypot(normal, np.linalg.norm(shear, axis=1))
    both = sum(np.bincount(block, through, len(loads)) for block in (contacts.block_a, contacts.block_b))
    force = np.maximum(loads, 0.5 * both)
    return Sizes(force, length, _factor(bodies, force, length))


def own_loads(bodies: RigidBodies, contacts: RigidContacts, factor: float, length: np.ndarray) -> np.ndarray:
    """(B,) N, what loads a block at a factor, moments over its length (B,); the mean of all for one without loads."""
    unit = alike(bodies, contacts)
    dead, live = _size(bodies.dead, length), _size(bodies.live, length)
    at_least = np.where(dead > 0.0, abs(factor), max(abs(factor), unit.factor))
    load = np.maximum(dead, at_least * live)
    return np.where(load > 0.0, load, unit.force)


def own_lengths(bodies: RigidBodies, contacts: RigidContacts) -> np.ndarray:
    """(B,) m, root of the mean square of the arms of a block's contacts; of one without contacts that of all."""
    square, number = np.zeros(len(bodies.centre)), np.zeros(len(bodies.centre))
    for block in (contacts.block_a, contacts.block_b):
        arm = contacts.point - bodies.centre[block]
        square += np.bincount(block, (arm**2).sum(axis=1), len(square))
        number += np.bincount(block, minlength=len(square))
    mean = np.sqrt(square.sum() / max(number.sum(), 1.0)) or 1.0
    return np.where(square > 0.0, np.sqrt(square / np.maximum(number, 1.0)), mean)


def _factor(bodies: RigidBodies, force: np.ndarray, length: np.ndarray) -> float:
    """The factor at which the growing load of a block that moves first is as much as a force (B,)."""
    ratio = float((_size(bodies.live, length) / force)[bodies.free.any(axis=1)].max(initial=0.0))
    return 1.0 / ratio if ratio > 0.0 else 1.0


def _size(load: np.ndarray, length: np.ndarray) -> np.ndarray:
    """(B,) N, the largest component of each load, moments over a length."""
    forces, moments = (np.abs(part).max(axis=1, initial=0.0) for part in (load[:, :3], load[:, 3:]))
    return np.maximum(forces, moments / length)


def _mean_force(load: np.ndarray) -> float:
    """N, mean over the blocks that are loaded; of a pure moment its size."""
    size = np.abs(load).max(axis=1, initial=0.0)
    return float(size[size > 0].mean()) if (size > 0).any() else 0.0

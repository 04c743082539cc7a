"""How well a solution is balanced, block by block, and keeps to what its contacts bear."""

import numpy as np
from scipy import sparse

from masonry.statics.equilibrium import Equilibrium
from masonry.statics.problem import RigidBodies, RigidContacts
from masonry.statics.sizes import own_lengths, own_loads


def unbalanced(bodies: RigidBodies, forces: Equilibrium, contacts: RigidContacts, unknown: np.ndarray) -> np.ndarray:
    """(B,) what is left on each block, and what its contacts bear too much, over its own loads.

    Over the forces at its contacts where these are more. So much, at most, loads, strengths or the places of contacts
    would have to differ for the balance to be exact (Oettli and Prager 1964, for each block as a whole). A contact
    counts for the smaller one of its blocks that move.

    unknown  normal forces, shear forces and the factor, without units
    """
    matrix = sparse.hstack([forces.normal, forces.shear, forces.live[:, None]], format="csr")
    length = own_lengths(bodies, contacts)
    unit = 1.0 / abs(forces.rows).max(axis=1).toarray().ravel()
    unit = np.where(forces.moment, unit / length[forces.block], unit)
    size = own_loads(bodies, contacts, float(unknown[-1] * forces.factor), length)
    np.maximum.at(size, forces.block, unit * (abs(matrix) @ np.abs(unknown) + np.abs(forces.dead)))
    residual = np.zeros(len(size))
    np.maximum.at(residual, forces.block, unit * np.abs(matrix @ unknown + forces.dead))
    moving = np.where(bodies.free.any(axis=1), size, np.inf)
    pair = np.column_stack([contacts.block_a, contacts.block_b])
    smaller = pair[np.arange(len(pair)), np.argmin(moving[pair], axis=1)]
    np.maximum.at(residual, smaller, _too_much(forces, contacts, unknown))
    return np.asarray(residual / size)


def _too_much(forces: Equilibrium, contacts: RigidContacts, unknown: np.ndarray) -> np.ndarray:
    """(C,) N beyond tension, friction with cohesion, or compressive strength."""
    (groups, k), count = forces.tangent.shape[:2], contacts.count
    normal = forces.force * unknown[:count]
    shear = forces.force[forces.leader] * np.linalg.norm(unknown[count:-1].reshape(groups, k), axis=1)
    bears = np.bincount(forces.group, contacts.cone_friction * normal + contacts.cohesion, groups)
    excess = np.maximum(-normal - contacts.tension, (shear - bears)[forces.group])
    if contacts.limit is not None:
        excess = np.maximum(excess, normal - contacts.limit)
    excess[contacts.solid] = 0.0
    if (crush := contacts.crush) is not None:
        total, first, second = (rows @ normal for rows in (crush.total, crush.first, crush.second))
        pressed = total - np.cbrt(crush.strength * np.maximum(first, 0.0) * np.maximum(second, 0.0))
        np.maximum.at(excess, crush.total.indices[crush.total.indptr[:-1]], pressed)
    return np.maximum(excess, 0.0)

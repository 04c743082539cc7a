"""Blocks that may stand only because they are jammed: joints that press against each other without any load.

Where forces can balance each other without a load (self-stress), limit analysis takes as much of them as friction
needs. In a structure they are there only if something wedges, expands or was prestressed.
"""

from dataclasses import replace
from typing import Any

import numpy as np
from scipy import sparse
from scipy.optimize import linprog

from masonry.statics.equilibrium import equilibrium
from masonry.statics.linear_programming import pyramids
from masonry.statics.no_dilation import forces_without_sliding
from masonry.statics.plane import flattened, plane_of
from masonry.statics.problem import RigidBodies, RigidContacts, Solution
from masonry.statics.sizes import alike
from masonry.statics.solve import EXACTLY, STANDS, Method, standing

SIDES, MUCH = 8, 1000
"""Of the friction pyramids with which self-stress is looked for, and the contact points beyond which it is not."""
PRESSED = 1e-6
"""Share of the greatest self-stress from which a contact counts as pressed by it."""
OPENS = 1e-7
"""How fast, over the speed of the blocks, all joints must open for a proof that there is no self-stress."""


def jammed(bodies: RigidBodies, contacts: RigidContacts, method: Method = EXACTLY) -> Solution | None:
    """The mechanism of what falls under its dead loads unless it is jammed; None where nothing is.

    In joints that can press without any load friction is bounded by the pressure that the loads themselves give them,
    where nothing slides and joints are of one stiffness. What falls then is jammed, if it stands. What bars press
    together is not: they are what may have been tightened.
    """
    moves = np.asarray(bodies.free.any(axis=1))
    loose = np.asarray(moves[contacts.block_a] | moves[contacts.block_b]) & ~contacts.is_link
    if not 0 < loose.sum() <= MUCH or _all_open(bodies, contacts.select(loose)):
        return None
    pressed = np.zeros(contacts.count, dtype=bool)
    pressed[loose] = _self_stressed(bodies, contacts.select(loose))
    if not pressed.any():
        return None
    normal = forces_without_sliding(bodies, contacts, method)
    patches = int(contacts.patch.max()) + 1
    area, on_joint = (np.bincount(contacts.patch, x, patches) for x in (contacts.area, np.maximum(normal, 0.0)))
    bears = contacts.friction * (on_joint / np.maximum(area, 1e-300))[contacts.patch] * contacts.area
    solution = standing(
        bodies,
        replace(
            contacts,
            friction=np.where(pressed, 0.0, contacts.friction),
            cohesion=contacts.cohesion + np.where(pressed, bears, 0.0),
        ),
        method,
    )
    return None if solution.status == "solved" and solution.factor >= STANDS else solution


def _all_open(bodies: RigidBodies, contacts: RigidContacts) -> bool:
    """Whether some motion opens all joints faster than friction needs: then no forces balance each other.

    Each block moves as it is, by a velocity that is linear in its place. Virtual work of a self-stress on it would be
    above 0.
    """
    if contacts.solid.any() or np.isinf(contacts.tension).any():
        return False
    moves = bodies.free[:, :3] if bodies.together is None else bodies.free[:, :3] & ~bodies.together[:, :3]
    centre = bodies.centre - bodies.centre.mean(axis=0)
    place = np.column_stack([centre / max(float(np.abs(centre).max()), 1e-300), np.ones(len(centre))])
    _, sample = np.unique(np.column_stack([contacts.patch, contacts.block_a]), axis=0, return_index=True)
    normal, friction = contacts.normal[sample], contacts.cone_friction[sample]
    first = np.cross(normal, np.eye(3)[np.argmin(np.abs(normal), axis=1)])
    first /= np.linalg.norm(first, axis=1, keepdims=True)
    second = np.cross(normal, first)
    rows = []
    for a, b in ((1, 1), (1, -1), (-1, 1), (-1, -1)):
        along = normal - friction[:, None] * (a * first + b * second)
        parts = [
            sign * (along * moves[block])[:, :, None] * place[block][:, None, :]
            for block, sign in ((contacts.block_b[sample], 1.0), (contacts.block_a[sample], -1.0))
        ]
        rows.append((parts[0] + parts[1]).reshape(len(sample), 12))
    matrix = np.concatenate(rows)
    upper = np.column_stack([-matrix, np.ones(len(matrix))])
    cost = np.append(np.zeros(12), -1.0)
    optimum = linprog(cost, upper, np.zeros(len(matrix)), bounds=[(-1.0, 1.0)] * 13, method="highs")
    return bool(optimum.status == 0 and -optimum.fun > OPENS)


def _self_stressed(bodies: RigidBodies, contacts: RigidContacts) -> np.ndarray:
    """(C,) contacts that press in forces which balance each other without a load, all of them at once."""
    none = np.zeros_like(contacts.cohesion)
    dry = replace(contacts, cohesion=none, tension=none, crush=None)
    still = replace(bodies, dead=np.zeros_like(bodies.dead), live=np.zeros_like(bodies.dead))
    axis, owner = plane_of(still, dry), np.arange(dry.count)
    if axis is not None:
        dry, owner = flattened(dry, axis)
    forces = equilibrium(still, dry, alike(bodies, dry), axis)
    count, tangents = dry.count, forces.shear.shape[1]
    upper, bound = pyramids(forces, dry, SIDES if axis is None else 2)
    pressing = sparse.hstack(
        [-sparse.eye_array(count), sparse.csr_array((count, tangents + 1)), sparse.eye_array(count)], format="csr"
    )
    upper = sparse.vstack([sparse.hstack([upper, sparse.csr_array((upper.shape[0], count))]), pressing], format="csr")
    rows = len(forces.dead)
    matrix = sparse.hstack([forces.normal, forces.shear, sparse.csr_array((rows, 1 + count))], format="csr")
    cost = np.concatenate([np.zeros(count + tangents + 1), -np.ones(count)])
    low = np.concatenate([np.where(dry.solid, -np.inf, 0.0), np.full(tangents, -np.inf), np.zeros(1 + count)])
    high = np.concatenate([np.full(count + tangents, np.inf), [0.0], np.where(dry.solid, 0.0, 1.0)])
    sides = np.concatenate([bound, np.zeros(count)])
    optimum: Any = linprog(cost, upper, sides, matrix, np.zeros(rows), np.column_stack([low, high]), method="highs")
    return np.asarray(optimum.x[-count:] > PRESSED)[owner] if optimum.status == 0 else np.zeros(len(owner), dtype=bool)

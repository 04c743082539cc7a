"""Impulses that change the velocities of bodies between two steps, booked as a force of the damping in the step."""

import numpy as np

from masonry.kinematics.turning import Turning
from masonry.model.model import Model


def strike(model: Model, kind: str, body, change: np.ndarray, earlier: np.ndarray) -> None:
    """Change the velocities (rows, n) of all that is free, and book the impulse that this takes: as a force of the
    damping in this step, which it does work by at the velocities `earlier` (a step before), so that the energy balance
    stays closed."""
    impulse = momenta(model, kind, body, change)
    if isinstance(body, Turning):
        body.momentum[...] += impulse[:, 3:]
    body.hold[...] += impulse / model.dt
    work = 0.5 * impulse * earlier
    if len(work) == len(body.work):
        body.work[:, 1] += work.sum(axis=1)
    else:
        body.work[0, 1] += work.sum()  # nodes of tets are not told apart by block
    body.v[...] += np.where(impulse != 0.0, change, 0.0)


def velocities_of(body, kept: np.ndarray) -> np.ndarray:
    """(rows, n) from what energy.velocities keeps, which of blocks that turn is their angular momentum."""
    if not isinstance(body, Turning):
        return kept
    q = principal(body)
    spin = np.einsum("bij,bj->bi", q, np.einsum("bji,bj->bi", q, kept[:, 3:]) / body.inertia)
    return np.concatenate([kept[:, :3], spin], axis=1)


def momenta(model: Model, kind: str, body, v: np.ndarray) -> np.ndarray:
    """(rows, n) mass times velocity of all that is free; without turns, of blocks that turn as far as they like and are
    held about some axes."""
    found = np.asarray(model.masses[kind] * v)
    if isinstance(body, Turning):
        free = np.all(body.dt_over_mass[:, 3:] > 0.0, axis=1, keepdims=True)
        q = principal(body)
        own = np.einsum("bij,bj->bi", q, body.inertia * np.einsum("bji,bj->bi", q, v[:, 3:]))
        found[:, 3:] = np.where(free, own, 0.0)
    return found


def principal(body: Turning) -> np.ndarray:
    """(B, 3, 3) principal axes as the blocks stand now, in columns."""
    return body.frame if body.axes is None else body.frame @ body.axes

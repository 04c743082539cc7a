"""The explicit step, Fig. 2 of the paper on one screen: displace, contact stresses, forces, velocities.

A step is a list of parts, each a whole sweep over the bodies of a kind or the contacts of a group, compiled for exactly
the types that it meets: an absent array is None and leaves no code behind; an absent body or group is no part at all.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np

from masonry.jit.compiled_parts import Call, CompiledPart, StepCalls
from masonry.jit.records import unpack
from masonry.kernels import contact
from masonry.kinematics.dispatch import move, update_positions
from masonry.kinematics.shared import DRIVE_FORCE, FACTOR, FACTOR_BEFORE, SPEED, SPEED_BEFORE
from masonry.patches.branches import NO_DASHPOTS, Dashpots


def step(
    parallel: bool | None, dt: float, damping: Any, groups: tuple, contacts: tuple, bodies: Sequence[Any],
    drives: Sequence[Any], shared: np.ndarray, dashpots: Dashpots = NO_DASHPOTS, elements: Sequence[Call] = (),
    all_forces: np.ndarray | None = None,
) -> StepCalls:  # fmt: skip
    """The step of small displacement, for `driver.drive`.

    parallel  True for the versions with threads, else None
    damping   None, a number (xi of eq. 3), Guided or Dragged
    groups    (parameters, joints, states, ranges), one entry per contact group; ranges (2 G,) its first contact and
              the one behind its last
    contacts  (sides, normal, area, u, force)
    bodies    (rigid, affine, tets), None where absent
    drives    (K, 2) row and number of the dofs that the drive moves, one array per kind of bodies or None
    shared    what parts share, of kinematics/shared.py
    dashpots  in closed contacts
    elements  calls that compute their forces; all_forces: rows of those of contacts, and behind them of elements
    """
    *_, u, force = contacts
    return StepCalls(
        [],
        [],
        [],
        [
            *displacing(parallel, bodies, dt, u),
            *sweeping(parallel, groups, contacts, dashpots),
            *elements,
            *kicking(parallel, bodies, dt, damping, shared, force if all_forces is None else all_forces, u),
            *driving(bodies, drives, shared),
        ],
    )


def displacing(parallel: bool | None, bodies: Sequence[Any], dt: float, u: np.ndarray) -> list[Call]:
    """Positions of all bodies, and the displacements of their points; loads and what is expected are no matter here."""
    moved = [body._replace(load=None, change=None, guess=None) for body in bodies if body is not None]
    return [_displace.of(parallel, body, dt, u) for body in moved]


def sweeping(parallel: bool | None, groups: tuple, contacts: tuple, dashpots: Dashpots) -> list[Call]:
    """Forces of every contact group by its own law."""
    parameters, joints, states, ranges = groups
    numbers = zip(parameters, joints, states, ranges[::2], ranges[1::2], strict=True)
    return [_sweep.of(parallel, *of_group, *contacts, *dashpots) for of_group in numbers]


def kicking(
    parallel: bool | None, bodies: Sequence[Any], dt: float, damping: Any, shared: np.ndarray, force: np.ndarray,
    u: np.ndarray,
) -> list[Call]:  # fmt: skip
    """Forces and velocities of all bodies."""
    return [_kick.of(parallel, body, dt, damping, shared, force, u) for body in bodies if body is not None]


def driving(bodies: Sequence[Any], drives: Sequence[Any], shared: np.ndarray) -> list[Call]:
    """Calls by which the drive moves bodies."""
    pairs = [(body, dofs) for body, dofs in zip(bodies, drives, strict=True) if body is not None and dofs is not None]
    return [_drive.of(body.hold, body.v, dofs, shared) for body, dofs in pairs]


@CompiledPart
def _displace(record):
    parallel, body, dt, u = unpack(record)
    update_positions(parallel, body, dt, u)


@CompiledPart
def _sweep(record):
    parallel, parameters, joint, state, first, last, sides, normal, area, u, force, k, g, before, m, taken = unpack(
        record
    )
    contact.sweep(
        parallel, parameters, joint, state, first, last, sides, normal, area, u, force, k, g, before, m, taken
    )


@CompiledPart
def _kick(record):
    parallel, body, dt, damping, shared, force, u = unpack(record)
    loading = shared[FACTOR], shared[FACTOR_BEFORE], shared[SPEED], shared[SPEED_BEFORE]
    move(parallel, body, dt, damping, loading, force, u)


@CompiledPart
def _drive(record):
    """Add up the forces that hold the driven dofs, and set their velocity."""
    hold, v, dofs, shared = unpack(record)
    total = 0.0
    for k in range(len(dofs)):
        total += hold[dofs[k, 0], dofs[k, 1]]
        v[dofs[k, 0], dofs[k, 1]] = shared[SPEED]
    shared[DRIVE_FORCE] += total


def reaction(body: Any, dofs: np.ndarray | None) -> float:
    """Sum of the forces that hold the given dofs, in their order; 0 where there are none."""
    if dofs is None or len(dofs) == 0:
        return 0.0
    return float(np.cumsum(body.hold[dofs[:, 0], dofs[:, 1]])[-1])

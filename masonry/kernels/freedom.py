"""One freedom: damping, leapfrog, and the work of each force by the trapezoid (eqs 1 and 3)."""

from typing import NamedTuple

from numba import types
from numba.extending import overload, register_jitable


@register_jitable
def sign(v):
    """sign(0) = 0: with the printed sgn(0) = +1 a body at rest would answer +F and -F differently (errata)."""
    return (v > 0.0) - (v < 0.0)


class Guided(NamedTuple):
    """Damping of what moves otherwise than expected.

    share  c dt / 2, for a viscosity of c times the mass against the unexpected part of the velocity
    xi     of a little local damping, eq. (3), of all motion
    """

    share: float
    xi: float


def resist(damping, pace, force, velocity, now, before):
    """What damping adds to the force on a freedom that is expected to move at `before`, and at `now` after the step.

    None: nothing. A number: local damping -xi |F| sign(v), eq. (3). Guided: the rest of the velocity, v - expected,
    decays by (1 - share) / (1 + share) a step, and the expected part follows the drive without any force. Leapfrog with
    a viscosity taken at the middle of the step is stable as without, so the bound is that of the local part.
    """
    if damping is None:
        return 0.0
    if isinstance(damping, Guided):
        return _guided(damping.share, damping.xi, pace, force, velocity, now, before)
    return _local(damping, force, velocity)


@register_jitable
def _local(xi, force, velocity):
    return -xi * abs(force) * sign(velocity)


@register_jitable
def _guided(share, xi, pace, force, velocity, now, before):
    driving = force + _local(xi, force, velocity)
    after = now + ((velocity - before) * (1.0 - share) + pace * driving) / (1.0 + share)
    return (after - velocity) / pace - force


@overload(resist, inline="always")
def _resist(damping, pace, force, velocity, now, before):
    if isinstance(damping, (types.NoneType, types.Omitted)):
        return lambda damping, pace, force, velocity, now, before: 0.0
    if getattr(damping, "instance_class", None) is Guided:
        return lambda damping, pace, force, velocity, now, before: _guided(
            damping.share, damping.xi, pace, force, velocity, now, before
        )
    return lambda damping, pace, force, velocity, now, before: _local(damping, force, velocity)


@register_jitable
def held_back(damping, pace, force, velocity, now, before):
    """What else acts on a freedom: the reaction where it is prescribed (pace = 0), else damping."""
    if pace == 0.0:
        return -force
    return resist(damping, pace, force, velocity, now, before)


@register_jitable
def expected(guess, row, i, speed):
    """Velocity that is expected of freedom i while the drive has this speed; 0 where nothing is."""
    if guess is None:
        return 0.0
    return speed * guess[row, i]


@register_jitable
def dead(load, row, i, factor):
    """Dead load on freedom i now; absent in a scene without gravity and tractions."""
    if load is None:
        return 0.0
    return factor * load[row, i]


@register_jitable
def book(work, b, pace, half_step_move, contact, hold, load):
    """Add a trapezoid's half-sums of forces times the move: contact, damping, external (reactions and dead loads)."""
    if work is None:
        return
    work[b, 0] += contact * half_step_move
    if pace == 0.0:
        work[b, 2] += hold * half_step_move
    else:
        work[b, 1] += hold * half_step_move
    work[b, 2] += load * half_step_move


@register_jitable
def advance(body, row, i, block, contact, inner, dt, damping, clock):
    """Freedom i of a row: total force, damping or reaction, works, and the kick of eq. (1).

    contact, inner  force of the contacts and of the block's own stiffness now
    clock           share of the dead load that acts now and one step before; speed of the drive after and before
    """
    load = dead(body.load, row, i, clock[0])
    pace, velocity = body.pace[row, i], body.v[row, i]
    total = contact + inner + load
    now, before = expected(body.guess, row, i, clock[2]), expected(body.guess, row, i, clock[3])
    hold = held_back(damping, pace, total, velocity, now, before)
    contacts = contact + body.contact[row, i]
    holds = hold + body.hold[row, i]
    loads = load + dead(body.load, row, i, clock[1])
    book(body.work, block, pace, 0.5 * dt * velocity, contacts, holds, loads)
    body.contact[row, i] = contact
    body.hold[row, i] = hold
    body.v[row, i] = at_rest_or(velocity + pace * (total + hold))


@register_jitable
def at_rest_or(velocity):
    """Velocities that damping has brought below 1e-100 m/s are rest: denormal numbers would slow the step tenfold."""
    if abs(velocity) < 1e-100:
        return 0.0
    return velocity

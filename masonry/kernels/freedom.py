"""One freedom: local damping, leapfrog, and the work of each force by the trapezoid (eqs 1 and 3)."""

from numba.extending import register_jitable


@register_jitable
def sign(v):
    """sign(0) = 0: with the printed sgn(0) = +1 a body at rest would answer +F and -F differently (errata)."""
    return (v > 0.0) - (v < 0.0)


@register_jitable
def held_back(damping, pace, force, velocity):
    """What else acts on a freedom: the reaction where it is prescribed (pace = 0), else local damping, eq. (3)."""
    if pace == 0.0:
        return -force
    return resist(damping, force, velocity)


@register_jitable
def resist(damping, force, velocity):
    """Local damping -xi |F| sign(v), eq. (3); None where there is none."""
    if damping is None:
        return 0.0
    return -damping * abs(force) * sign(velocity)


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
def advance(body, row, i, block, contact, inner, dt, damping, factor, factor_before):
    """Freedom i of a row: total force, damping or reaction, works, and the kick of eq. (1).

    contact, inner  force of the contacts and of the block's own stiffness now
    factor          share of the dead load that acts now (and one step before)
    """
    load = dead(body.load, row, i, factor)
    pace, velocity = body.pace[row, i], body.v[row, i]
    total = contact + inner + load
    hold = held_back(damping, pace, total, velocity)
    contacts = contact + body.contact[row, i]
    holds = hold + body.hold[row, i]
    loads = load + dead(body.load, row, i, factor_before)
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

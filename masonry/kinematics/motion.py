"""One degree of freedom: damping, leapfrog, and the work of each force by the trapezoid (eqs 1 and 3)."""

from typing import NamedTuple

from numba import types

from masonry.jit.extending import overload, register_jitable
from masonry.simd import filled, put, take, total, where


class Guided(NamedTuple):
    """Damping of what moves otherwise than expected.

    half_c_dt  h = c dt / 2, for a viscosity of c times the mass against the unexpected part of the velocity
    xi         of a little local damping, eq. (3), of all motion
    """

    half_c_dt: float
    xi: float


class Dragged(NamedTuple):
    """Damping of the mass: h = c dt / 2, for a viscosity of c times the mass against the velocity."""

    half_c_dt: float


def resist(damping, dt_over_mass, force, velocity, now, before):
    """Contribution of damping to the force on a dof expected to move at `before`, and at `now` after the step.

    None: nothing. A number: local damping -xi |F| sign(v), eq. (3). Dragged: all of the velocity decays by
    (1 - h) / (1 + h) a step. Guided: so does the rest of the velocity, v - expected, and the expected part follows the
    drive without any force. Leapfrog with a viscosity taken at the middle of the step is stable as without, so the
    bound is that of the local part.
    """
    if damping is None:
        return 0.0
    if isinstance(damping, Guided):
        return _guided(damping.half_c_dt, damping.xi, dt_over_mass, force, velocity, now, before)
    if isinstance(damping, Dragged):
        return _dragged(damping.half_c_dt, dt_over_mass, force, velocity)
    return _local(damping, force, velocity)


@register_jitable
def _local(xi, force, velocity):
    """sign(0) = 0: with the printed sgn(0) = +1 a body at rest would answer +F and -F differently (errata)."""
    size = xi * abs(force)
    return where(velocity > 0.0, -size, where(velocity < 0.0, size, filled(0.0, size)))


@register_jitable
def _guided(half_c_dt, xi, dt_over_mass, force, velocity, now, before):
    driving = force + _local(xi, force, velocity)
    after = now + ((velocity - before) * (1.0 - half_c_dt) + dt_over_mass * driving) / (1.0 + half_c_dt)
    return (after - velocity) / dt_over_mass - force


@register_jitable
def _dragged(half_c_dt, dt_over_mass, force, velocity):
    return -half_c_dt / (1.0 + half_c_dt) * (force + 2.0 * velocity / dt_over_mass)


@overload(resist)
def _resist(damping, dt_over_mass, force, velocity, now, before):
    if isinstance(damping, (types.NoneType, types.Omitted)):
        return lambda damping, dt_over_mass, force, velocity, now, before: filled(0.0, force)
    if getattr(damping, "instance_class", None) is Guided:
        return lambda damping, dt_over_mass, force, velocity, now, before: _guided(
            damping.half_c_dt, damping.xi, dt_over_mass, force, velocity, now, before
        )
    if getattr(damping, "instance_class", None) is Dragged:
        return lambda damping, dt_over_mass, force, velocity, now, before: _dragged(
            damping.half_c_dt, dt_over_mass, force, velocity
        )
    return lambda damping, dt_over_mass, force, velocity, now, before: _local(damping, force, velocity)


def factor_times(array, at, like, factor):
    """A factor times what an array holds from index `at` on, as many as `like` has; 0 where the array is absent."""
    return 0.0 if array is None else factor * take(array, at, like)


@overload(factor_times)
def _factor_times(array, at, like, factor):
    if isinstance(array, types.Array):
        return lambda array, at, like, factor: factor * take(array, at, like)
    return lambda array, at, like, factor: 0.0


def dead_load(body, at, like, load_factor):
    """The load on a dof times its factor; what the factor exceeds 1 by is that of the load that varies besides."""
    if body.change is None:
        return factor_times(body.load, at, like, load_factor)
    return min(load_factor, 1.0) * take(body.load, at, like) + max(load_factor - 1.0, 0.0) * take(body.change, at, like)


@overload(dead_load)
def _dead_load(body, at, like, load_factor):
    if isinstance(dict(zip(body.fields, body.types, strict=True))["change"], types.Array):
        return lambda body, at, like, load_factor: (
            min(load_factor, 1.0) * take(body.load, at, like)
            + max(load_factor - 1.0, 0.0) * take(body.change, at, like)
        )
    return lambda body, at, like, load_factor: factor_times(body.load, at, like, load_factor)


@register_jitable
def accumulate_work(done, held, half_step_move, contact, hold, load):
    """Add a trapezoid's half-sums of forces times the move to the works done so far: of the contacts, of damping, and
    of reactions and dead loads.
    """
    by_hold = hold * half_step_move
    return (
        done[0] + contact * half_step_move,
        done[1] + where(held, 0.0, by_hold),
        done[2] + where(held, by_hold, 0.0) + load * half_step_move,
    )


@register_jitable
def advance(body, at, contact, inner, dt, damping, loading, done):
    """Dofs of a row from `at` on, one or several: total force, damping or reaction, and the kick of eq. (1).

    contact, inner  force of the contacts and of the block's own stiffness now: numbers or lanes
    loading           factor of the dead load that acts now and one step before; speed of the drive after and before
    done            works (J) of contacts, damping, and what acts from outside, so far; returned with this step's
    """
    load = dead_load(body, at, contact, loading[0])
    dt_over_mass, velocity = take(body.dt_over_mass, at, contact), take(body.v, at, contact)
    sum_of_forces = contact + inner + load
    now, before = (
        factor_times(body.guess, at, contact, loading[2]),
        factor_times(body.guess, at, contact, loading[3]),
    )
    held = dt_over_mass == 0.0
    hold = where(held, -sum_of_forces, resist(damping, dt_over_mass, sum_of_forces, velocity, now, before))
    contacts = contact + take(body.contact, at, contact)
    holds = hold + take(body.hold, at, contact)
    loads = load + dead_load(body, at, contact, loading[1])
    done = accumulate_work(done, held, 0.5 * dt * velocity, contacts, holds, loads)
    put(body.contact, at, contact)
    put(body.hold, at, hold)
    put(body.v, at, at_rest_or(velocity + dt_over_mass * (sum_of_forces + hold)))
    return done


@register_jitable
def at_rest_or(velocity):
    """Velocities that damping has brought below 1e-100 m/s are rest: denormal numbers would slow the step tenfold."""
    return where(abs(velocity) < 1e-100, filled(0.0, velocity), velocity)


@register_jitable
def keep(work, b, done):
    """Add the works of a block's dofs to its account, where one is kept."""
    if work is not None:
        work[b, 0] += total(done[0])
        work[b, 1] += total(done[1])
        work[b, 2] += total(done[2])

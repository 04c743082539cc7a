"""Rigid blocks that turn as far as they like: x = centroid + t + R arm; momentum is kept to the bit in free flight.

What a block keeps is its angular momentum L; its angular velocity is w = J^-1 L with J = R I R^T. Over a step it turns
by exp(w* dt) with w* = w + dt/2 w', and w' = J^-1 (L x w) of Euler's equations of free motion (Buss 2000, second
order). Contact moments change L at the end of the step, as forces change momenta in leapfrog.

Held rotations are about global axes. Of a block that is held about some of them the other components of L move on, and
w follows from L and what is prescribed; R is then turned by the midpoint rule. Reactions leave the block's inertia out,
as for translations; where it turns about prescribed axes and freely about others, its work is in `work[:, 3]`.
"""

from typing import NamedTuple

import numpy as np
from numba import prange

from masonry.jit.compiler import jit
from masonry.jit.extending import register_jitable
from masonry.kinematics.levers import axial, moments, patch_couple, patch_force
from masonry.kinematics.matrices import (
    added,
    dot,
    each,
    exponential,
    matrix_at,
    minus,
    product,
    put_matrix,
    put_vector,
    scaled,
    straightened,
    times,
    transposed,
    transposed_times,
    vector_at,
    vector_or_zero,
)
from masonry.kinematics.motion import advance, at_rest_or, resist
from masonry.kinematics.spins import free_axes, given_spin, inertia_now, mean_spin, principal_axes, spin_of
from masonry.simd import EIGHT, eight, eight_rows, filled, pack, plus, put_row


class Turning(NamedTuple):
    """Arrays of B rigid blocks that have S contact sides in all; components are global but where it says otherwise.

    q               (B, 6) displacement of the centroid (m), and the sum of all small turns (rad), which is no rotation
    v, dt_over_mass  (B, 6) velocity and angular velocity; dt/mass, 0 where prescribed; of turns only whether it is 0
    contact, hold   (B, 6) force and moment at the last step: contacts and patches; damping or reaction
    frame           (B, 3, 3) rotation R since the start
    momentum        (B, 3) kg m2/s, angular momentum L about the centroid; 0 about held axes. It belongs to v: `spin`
    inertia         (B, 3) kg m2 about the principal axes
    start, code     sides of each block, as for Rigid
    arm             (S, 3) m, from the centroid to the point, as at the start
    first_point     row of u at which the sides begin
    work            (B, 4) J: contacts, damping, external, and what the free rotor loses while R turns and L stays
    load, change    (B, 6) dead loads, which do not turn; moments about global axes; or None
    guess           (B, 6) expected velocity for a unit speed of the drive, or None
    axes            (B, 3, 3) principal axes at the start in columns; None where they are x, y, z
    apart           rows like force: u_b - u_a of every contact, see levers.py; None for 0
    patches         (B, 6) force and moment about the centroid of detected contacts, or None
    shifted         (B, 6) moments that loads at points have besides `load` as their arms change: now, and a step
                    before; or None
    """

    q: np.ndarray
    v: np.ndarray
    dt_over_mass: np.ndarray
    contact: np.ndarray
    hold: np.ndarray
    frame: np.ndarray
    momentum: np.ndarray
    inertia: np.ndarray
    start: np.ndarray
    code: np.ndarray
    arm: np.ndarray
    first_point: np.uint32
    work: np.ndarray | None = None
    load: np.ndarray | None = None
    guess: np.ndarray | None = None
    axes: np.ndarray | None = None
    change: np.ndarray | None = None
    apart: np.ndarray | None = None
    patches: np.ndarray | None = None
    shifted: np.ndarray | None = None


def update_positions(body, dt, u):
    """Move and turn every block with its velocities, and write the displacement of every contact point."""
    q, frame, arm, start, first = body.q, body.frame, body.arm, body.start, body.first_point
    for g in prange(-(-len(q) // EIGHT)):
        b, behind = EIGHT * g, min(EIGHT * g + EIGHT, len(q))
        if behind == b + EIGHT:
            _turn(body, eight_rows(b), dt)
        else:
            for k in range(b, behind):
                _turn(body, k, dt)
        for k in range(b, behind):
            _place(q, frame, arm, start, first, k, u)


@register_jitable(forceinline=True)
def _turn(body, b, dt):
    """Move and turn block b, or eight of them."""
    q, v, frame, momentum, inertia = body.q, body.v, body.frame, body.momentum, body.inertia
    r, free, moving = matrix_at(frame, b), free_axes(vector_at(body.dt_over_mass, b, 3)), vector_at(v, b, 3)
    w = mean_spin(r, body.axes, b, vector_at(inertia, b, 0), free, vector_at(momentum, b, 0), moving, dt)
    rotation = scaled(dt, w)
    put_matrix(frame, b, straightened(product(exponential(rotation), r)))
    put_vector(q, b, 0, added(vector_at(q, b, 0), scaled(dt, vector_at(v, b, 0))))
    put_vector(q, b, 3, added(vector_at(q, b, 3), rotation))


@register_jitable
def _place(q, frame, arm, start, first, b, u):
    """Write the displacements of the contact points of block b."""
    moved, r = pack((q[b, 0], q[b, 1], q[b, 2], 0.0)), matrix_at(frame, b)
    by_x, by_y = pack((r[0] - 1.0, r[3], r[6], 0.0)), pack((r[1], r[4] - 1.0, r[7], 0.0))
    by_z = pack((r[2], r[5], r[8] - 1.0, 0.0))
    for k in range(start[b], start[b + 1]):
        put_row(u, first + k, plus(plus(plus(moved, arm[k, 0], by_x), arm[k, 1], by_y), arm[k, 2], by_z))


def move(body, dt, damping, loading, force, u):
    """Sum the forces and moments of each block, damp, book the work, and kick its momenta."""
    start, count = body.start, len(body.q)
    for g in prange(-(-count // EIGHT)):
        b, behind = EIGHT * g, min(EIGHT * g + EIGHT, count)
        if behind == b + EIGHT and start[b] == start[behind]:
            nothing = eight(), eight(), eight()
            _kick(body, eight_rows(b), nothing, nothing, dt, damping, loading)
        else:
            for k in range(b, behind):
                resultant, moment = _of_contacts(body, force, k)
                _kick(body, k, resultant, moment, dt, damping, loading)


@register_jitable
def _of_contacts(body, force, b):
    """Force and moment of the contacts of block b."""
    resultant, moment, beside = moments(body.apart, body.start, body.code, body.arm, force, b)
    return resultant, added(axial(product(moment, transposed(matrix_at(body.frame, b)))), beside)


@register_jitable(forceinline=True)
def _kick(body, b, resultant, moment, dt, damping, loading):
    """Push block b, or eight of them, by the force and moment of their contacts and all that acts besides.

    With K = L(n-1/2) J(n)^-1 L(n+1/2) / 2 the works close to round-off: K gains dt/2 (M(n-1) w+ + M(n) w-), with w+ and
    w- of one momentum before and after the turn, and L (w- - w+) / 2, which is the rotor's.
    """
    v, contact, reaction, momentum = body.v, body.contact, body.hold, body.momentum
    moment = added(moment, patch_couple(body.patches, b))
    resultant = added(resultant, patch_force(body.patches, b))
    before, angular = vector_at(v, b, 3), vector_at(momentum, b, 0)
    nothing = filled(0.0, resultant[0])
    done = nothing, nothing, nothing
    done = advance(body, (b, 0), resultant[0], 0.0, dt, damping, loading, done)
    done = advance(body, (b, 1), resultant[1], 0.0, dt, damping, loading, done)
    done = advance(body, (b, 2), resultant[2], 0.0, dt, damping, loading, done)

    q, principal = principal_axes(body.axes, b, matrix_at(body.frame, b)), vector_at(body.inertia, b, 0)
    free = free_axes(vector_at(body.dt_over_mass, b, 3))
    w = spin_of(q, principal, free, angular, before)
    load = _with_shift(_moment_of_load(body.load, body.change, b, loading[0]), body.shifted, b, 0)
    earlier = _with_shift(_moment_of_load(body.load, body.change, b, loading[1]), body.shifted, b, 3)
    driving = each(free, added(moment, load))
    damped = each(free, _damping(damping, _expected(body.guess, b, loading), principal, q, driving, w, dt))
    hold = added(damped, minus(driving, added(moment, load)))
    was = vector_at(reaction, b, 3)
    push = added(driving, damped)
    kicked = _rested(added(angular, scaled(dt, push)))
    rotational_work = (
        dot(moment, w) + dot(vector_at(contact, b, 3), before),
        dot(damped, w) + dot(each(free, was), before),
        dot(minus(hold, damped), w) + dot(minus(was, each(free, was)), before) + dot(load, w) + dot(earlier, before),
    )
    loss = 0.5 * dot(angular, minus(before, w)) - 0.5 * dt * dot(push, given_spin(q, principal, free, angular, w))
    after = spin_of(q, principal, free, kicked, before)
    put_vector(contact, b, 3, moment)
    put_vector(reaction, b, 3, hold)
    put_vector(momentum, b, 0, kicked)
    put_vector(v, b, 3, added(before, each(free, minus(after, before))))
    _keep(body.work, b, done, scaled(0.5 * dt, rotational_work), loss)


@register_jitable
def _rested(a):
    return at_rest_or(a[0]), at_rest_or(a[1]), at_rest_or(a[2])


@register_jitable
def _moment_of_load(load, change, b, load_factor):
    """Moment of the dead loads times their factor, as in motion.dead_load; 0 where there are none."""
    if change is None:
        return scaled(load_factor, vector_or_zero(load, b, 3))
    return added(
        scaled(min(load_factor, 1.0), vector_or_zero(load, b, 3)),
        scaled(max(load_factor - 1.0, 0.0), vector_or_zero(change, b, 3)),
    )


@register_jitable
def _with_shift(moment, shifted, b, first):
    """A moment of dead loads with what changing arms add to it."""
    return moment if shifted is None else added(moment, vector_at(shifted, b, first))


@register_jitable
def _damping(damping, expected, inertia, q, driving, w, dt):
    """Moment that damps, formed along the block's principal axes: so it is the same from wherever one looks, and each
    axis has its own inertia. It brakes the power of every axis, and so it does about the free ones alone.
    """
    nothing = filled(0.0, w[0])
    if damping is None:
        return nothing, nothing, nothing
    m, turning = transposed_times(q, driving), transposed_times(q, w)
    now, before = transposed_times(q, expected[0]), transposed_times(q, expected[1])
    braking = (
        resist(damping, dt / inertia[0], m[0], turning[0], now[0], before[0]),
        resist(damping, dt / inertia[1], m[1], turning[1], now[1], before[1]),
        resist(damping, dt / inertia[2], m[2], turning[2], now[2], before[2]),
    )
    return times(q, braking)


@register_jitable
def _expected(guess, b, loading):
    """Angular velocities that block b is expected to have after this step and before; 0 where nothing is expected."""
    return scaled(loading[2], vector_or_zero(guess, b, 3)), scaled(loading[3], vector_or_zero(guess, b, 3))


@register_jitable
def _keep(work, b, done, rotational_work, loss):
    """Add the works of moving and of turning to a block's account, where one is kept."""
    if work is not None:
        put_vector(work, b, 0, added(vector_at(work, b, 0), added(done, rotational_work)))
        work[b, 3] += loss


@jit
def spin(body):
    """Give every block the momentum that belongs to v, after v was set from outside; none about held axes."""
    for b in range(len(body.q)):
        j = inertia_now(principal_axes(body.axes, b, matrix_at(body.frame, b)), vector_at(body.inertia, b, 0))
        put_vector(
            body.momentum, b, 0, each(free_axes(vector_at(body.dt_over_mass, b, 3)), times(j, vector_at(body.v, b, 3)))
        )


def momenta(body: Turning) -> np.ndarray:
    """(B, 6) velocity and angular momentum now: what `kinetic` needs a step later."""
    return np.concatenate([body.v[:, :3], body.momentum], axis=1)


def kinetic(body: Turning, masses: np.ndarray, before: np.ndarray) -> float:
    """v(n-1/2) m v(n+1/2) / 2 + L(n-1/2) w(n+1/2) / 2 (J), with which the balance closes to round-off.

    masses (B, >= 3) kg, 0 where held; before: `momenta` a step earlier
    """
    moving = np.sum(masses[:, :3] * before[:, :3] * body.v[:, :3])
    return 0.5 * float(moving + np.sum(before[:, 3:] * body.v[:, 3:]))

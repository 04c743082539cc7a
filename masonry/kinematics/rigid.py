"""Rigid blocks, small rotations: u(x) = t + theta x (x - centroid); 6 dofs, three moves and three turns.

Displacements are linear in the dofs: a rotation theta costs an error of theta^2/2, so a run stops beyond a stated
rotation. Turns are about the axes in the columns of `axes` (principal axes; None where they are x, y, z).
"""

from typing import NamedTuple

import numpy as np
from numba import prange

from masonry.jit.extending import register_jitable
from masonry.kinematics.motion import advance, keep
from masonry.simd import EIGHT, eight, numbers, pack, part, plus, put, put_row, take, take_row


class Rigid(NamedTuple):
    """Arrays of B rigid blocks that have S contact sides in all.

    q, v, dt_over_mass  (B, 6) displacement, velocity, and dt/mass (0 = prescribed)
    contact, hold   (B, 6) generalised forces at the last step: contacts; damping or reaction
    start           (B + 1,) sides of block b: start[b]..start[b + 1]
    code            (S,) 2 * contact + (1 on side b of the contact)
    arm             (S, 3) m, from the centroid to the point
    first_point     row of u at which the sides begin
    work            (B, 3) J: contact, damping, external; None without a ledger
    load            (B, 6) dead loads or None
    change          (B, 6) by how much the dead loads change while their share rises from 1 to 2, or None
    guess           (B, 6) expected velocity for a unit speed of the drive, or None
    axes            (B, 3, 3) or None
    """

    q: np.ndarray
    v: np.ndarray
    dt_over_mass: np.ndarray
    contact: np.ndarray
    hold: np.ndarray
    start: np.ndarray
    code: np.ndarray
    arm: np.ndarray
    first_point: np.uint32
    work: np.ndarray | None = None
    load: np.ndarray | None = None
    guess: np.ndarray | None = None
    axes: np.ndarray | None = None
    change: np.ndarray | None = None


@register_jitable
def turn_out(axes, b, x, y, z):
    """Components along the block's axes -> global."""
    if axes is None:
        return x, y, z
    a = axes[b]
    return (
        a[0, 0] * x + a[0, 1] * y + a[0, 2] * z,
        a[1, 0] * x + a[1, 1] * y + a[1, 2] * z,
        a[2, 0] * x + a[2, 1] * y + a[2, 2] * z,
    )


@register_jitable
def turn_in(axes, b, x, y, z):
    """Global components -> along the block's axes."""
    if axes is None:
        return x, y, z
    a = axes[b]
    return (
        a[0, 0] * x + a[1, 0] * y + a[2, 0] * z,
        a[0, 1] * x + a[1, 1] * y + a[2, 1] * z,
        a[0, 2] * x + a[1, 2] * y + a[2, 2] * z,
    )


def update_positions(body, dt, u):
    """Advance the dofs by dt v and write the displacement of every contact point."""
    q, v, arm, start, first, axes = body.q, body.v, body.arm, body.start, body.first_point, body.axes
    for b in prange(len(q)):
        for i in range(0, 6, EIGHT):
            put(q, (b, i), take(q, (b, i), eight()) + dt * take(v, (b, i), eight()))
        p, r, s = turn_out(axes, b, q[b, 3], q[b, 4], q[b, 5])
        moved = pack((q[b, 0], q[b, 1], q[b, 2], 0.0))
        by_x, by_y, by_z = pack((0.0, s, -r, 0.0)), pack((-s, 0.0, p, 0.0)), pack((r, -p, 0.0, 0.0))
        for k in range(start[b], start[b + 1]):
            put_row(u, first + k, plus(plus(plus(moved, arm[k, 0], by_x), arm[k, 1], by_y), arm[k, 2], by_z))


def move(body, dt, damping, loading, force, u):
    """Sum the contact forces of each block, damp, add up the work, and kick the velocities by half a step each way."""
    arm, start, code, axes = body.arm, body.start, body.code, body.axes
    for b in prange(len(body.q)):
        nothing = pack((0.0, 0.0, 0.0, 0.0))
        sums, by_x, by_y, by_z = nothing, nothing, nothing, nothing
        for k in range(start[b], start[b + 1]):
            push = plus(nothing, 1.0 - 2.0 * (code[k] & 1), take_row(force, code[k] >> 1))
            sums = plus(sums, 1.0, push)
            by_x = plus(by_x, arm[k, 0], push)
            by_y = plus(by_y, arm[k, 1], push)
            by_z = plus(by_z, arm[k, 2], push)
        fx, fy, fz, _ = numbers(sums)
        x, y, z = numbers(by_x), numbers(by_y), numbers(by_z)
        mx, my, mz = y[2] - z[1], z[0] - x[2], x[1] - y[0]
        mx, my, mz = turn_in(axes, b, mx, my, mz)
        forces = pack((fx, fy, fz, mx, my, mz, 0.0, 0.0))
        done = eight(), eight(), eight()
        for i in range(0, 6, EIGHT):
            done = advance(body, (b, i), part(forces, i), 0.0, dt, damping, loading, done)
        keep(body.work, b, done)

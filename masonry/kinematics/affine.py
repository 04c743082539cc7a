"""Affine blocks: u(x) = t + H (x - centroid); 12 dofs, with the block's own linear elasticity (uniform strain).

H is held along the block's axes: column k is the derivative along axis k of the block.
"""

from typing import NamedTuple

import numpy as np
from numba import prange

from masonry.jit.compiler import jit
from masonry.jit.extending import register_jitable
from masonry.kinematics.motion import advance, keep
from masonry.simd import FOUR, four, numbers, pack, part, plus, put, put_row, take, take_row


class Affine(NamedTuple):
    """Arrays of B affine blocks that have S contact sides in all.

    q, v, dt_over_mass  (B, 12): t, then H row by row; dt/mass (0 = prescribed)
    contact, hold   (B, 12) generalised forces at the last step: contacts; damping or reaction
    start, code     sides of each block, as for rigid blocks
    arm             (S, 3) m, from the centroid to the point, along the block's axes
    stiffness       (B, 2) J: volume times the Lame constants lambda, mu
    first_point     row of u at which the sides begin
    work, load, guess, axes, change  as for rigid blocks; None where absent
    """

    q: np.ndarray
    v: np.ndarray
    dt_over_mass: np.ndarray
    contact: np.ndarray
    hold: np.ndarray
    start: np.ndarray
    code: np.ndarray
    arm: np.ndarray
    stiffness: np.ndarray
    first_point: np.uint32
    work: np.ndarray | None = None
    load: np.ndarray | None = None
    guess: np.ndarray | None = None
    axes: np.ndarray | None = None
    change: np.ndarray | None = None


def update_positions(body, dt, u):
    """Advance the dofs by dt v and write the displacement of every contact point."""
    q, v, arm, start, first = body.q, body.v, body.arm, body.start, body.first_point
    for b in prange(len(q)):
        for i in range(0, 12, FOUR):
            put(q, (b, i), take(q, (b, i), four()) + dt * take(v, (b, i), four()))
        moved = pack((q[b, 0], q[b, 1], q[b, 2], 0.0))
        by_a = pack((q[b, 3], q[b, 6], q[b, 9], 0.0))
        by_b = pack((q[b, 4], q[b, 7], q[b, 10], 0.0))
        by_c = pack((q[b, 5], q[b, 8], q[b, 11], 0.0))
        for k in range(start[b], start[b + 1]):
            put_row(u, first + k, plus(plus(plus(moved, arm[k, 0], by_a), arm[k, 1], by_b), arm[k, 2], by_c))


def move(body, dt, damping, loading, force, u):
    """Sum contact forces and their first moments, add the block's own stiffness, and advance."""
    arm, start, code = body.arm, body.start, body.code
    for b in prange(len(body.q)):
        nothing = pack((0.0, 0.0, 0.0, 0.0))
        whole, by_a, by_b, by_c = nothing, nothing, nothing, nothing
        for k in range(start[b], start[b + 1]):
            row, side = take_row(force, code[k] >> 1), 1.0 - 2.0 * (code[k] & 1)
            whole = plus(whole, side, row)
            by_a = plus(by_a, side * arm[k, 0], row)
            by_b = plus(by_b, side * arm[k, 1], row)
            by_c = plus(by_c, side * arm[k, 2], row)
        f, x, y, z = numbers(whole), numbers(by_a), numbers(by_b), numbers(by_c)
        sums = (f[0], f[1], f[2], x[0], y[0], z[0], x[1], y[1], z[1], x[2], y[2], z[2])
        inner = _inner(body, b)
        done = four(), four(), four()
        done = _advance_row(body, b, 0, sums[0:4], inner[0:4], dt, damping, loading, done)
        done = _advance_row(body, b, 4, sums[4:8], inner[4:8], dt, damping, loading, done)
        done = _advance_row(body, b, 8, sums[8:12], inner[8:12], dt, damping, loading, done)
        keep(body.work, b, done)


@register_jitable
def _advance_row(body, b, first, contact, inner, dt, damping, loading, done):
    contacts, inners = pack(contact), pack(inner)
    for i in range(0, 4, FOUR):
        done = advance(body, (b, first + i), part(contacts, i), part(inners, i), dt, damping, loading, done)
    return done


@register_jitable
def product(m, a):
    """Product of two 3 x 3 matrices, both row by row."""
    return (
        *(m[0] * a[0] + m[1] * a[3] + m[2] * a[6], m[0] * a[1] + m[1] * a[4] + m[2] * a[7]),
        *(m[0] * a[2] + m[1] * a[5] + m[2] * a[8], m[3] * a[0] + m[4] * a[3] + m[5] * a[6]),
        *(m[3] * a[1] + m[4] * a[4] + m[5] * a[7], m[3] * a[2] + m[4] * a[5] + m[5] * a[8]),
        *(m[6] * a[0] + m[7] * a[3] + m[8] * a[6], m[6] * a[1] + m[7] * a[4] + m[8] * a[7]),
        m[6] * a[2] + m[7] * a[5] + m[8] * a[8],
    )


@register_jitable
def times_axes(axes, b, m):
    """(3 x 3 matrix, row by row) times the block's axes: derivatives along x, y, z -> along the axes."""
    if axes is None:
        return m
    q = axes[b]
    return product(m, (q[0, 0], q[0, 1], q[0, 2], q[1, 0], q[1, 1], q[1, 2], q[2, 0], q[2, 1], q[2, 2]))


@register_jitable
def gradient(axes, b, q):
    """Displacement gradient of block b along x, y, z, row by row: H times the transposed axes."""
    h = (q[b, 3], q[b, 4], q[b, 5], q[b, 6], q[b, 7], q[b, 8], q[b, 9], q[b, 10], q[b, 11])
    if axes is None:
        return h
    a = axes[b]
    return product(h, (a[0, 0], a[1, 0], a[2, 0], a[0, 1], a[1, 1], a[2, 1], a[0, 2], a[1, 2], a[2, 2]))


@register_jitable
def hooke(h, lame, mu):
    """Stress (xx yy zz yz xz xy) of a displacement gradient, small strains."""
    pressure = lame * (h[0] + h[4] + h[8])
    two_mu = 2.0 * mu
    return (
        pressure + two_mu * h[0],
        pressure + two_mu * h[4],
        pressure + two_mu * h[8],
        mu * (h[5] + h[7]),
        mu * (h[2] + h[6]),
        mu * (h[1] + h[3]),
    )


@register_jitable
def _inner(body, b):
    """Generalised force of the block's own stiffness on its 12 dofs: -V sigma on H, nothing on t."""
    s = hooke(gradient(body.axes, b, body.q), -body.stiffness[b, 0], -body.stiffness[b, 1])
    m = times_axes(body.axes, b, (s[0], s[5], s[4], s[5], s[1], s[3], s[4], s[3], s[2]))
    return (0.0, 0.0, 0.0, m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8])


@jit
def observe(body, stress):
    """Write the stress (B, 6) Pa times volume of every block; return their elastic energy (J), from the state."""
    energy = 0.0
    for b in range(len(body.q)):
        h = gradient(body.axes, b, body.q)
        s = hooke(h, body.stiffness[b, 0], body.stiffness[b, 1])
        for i in range(6):
            stress[b, i] = s[i]
        shear = s[3] * (h[5] + h[7]) + s[4] * (h[2] + h[6]) + s[5] * (h[1] + h[3])
        energy += 0.5 * (s[0] * h[0] + s[1] * h[4] + s[2] * h[8] + shear)
    return energy

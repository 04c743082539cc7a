"""Affine blocks that turn and deform as far as they like: x = centroid + t + F (X - centroid), St Venant-Kirchhoff.

H = F - 1 is held along the block's axes at the start, as in affine.py: column k is the derivative along axis k. The
mass matrix is constant, no term is gyroscopic, and a rigid turn of the whole changes neither energy nor stress in the
block. A force at a point y from the centroid, in space, acts on H with the lever F^-1 y that its material has; of the
lever beyond a contact's own point (levers.py) only the couple counts, with F^-T.
"""

from typing import NamedTuple

import numpy as np
from numba import prange

from masonry.jit.compiler import jit
from masonry.jit.extending import register_jitable
from masonry.kinematics.levers import moments, patch_force, patch_moments, skew
from masonry.kinematics.matrices import (
    added,
    determinant,
    inverse,
    largest_stretch,
    matrix_at,
    product,
    put_matrix,
    second_piola,
    strain,
    times_symmetric,
    transposed,
    work_density,
)
from masonry.kinematics.motion import advance, keep
from masonry.simd import FOUR, four, pack, part, plus, put, put_row, take, total


class Deforming(NamedTuple):
    """Arrays of B affine blocks that have S contact sides in all.

    q, v, dt_over_mass  (B, 12): t, then H row by row; dt/mass (0 = prescribed); those of a column of H are equal
    contact, hold   (B, 12) generalised forces at the last step: contacts and patches; damping or reaction
    inner           (B, 12) generalised force of the block's own stiffness at the last step
    frame           (B, 3, 3) deformation gradient F, along x, y, z
    start, code     sides of each block, as for Rigid
    arm             (S, 3) m, from the centroid to the point at the start, along the block's axes
    stiffness       (B, 2) J: volume at the start times the Lame constants lambda, mu
    first_point     row of u at which the sides begin
    work            (B, 4) J: contacts, damping, external, and what was put into the block's own stiffness
    load, guess, axes, change  as for Affine; None where absent
    apart           rows like force: u_b - u_a of every contact, see levers.py; None for 0
    patches         (B, 12) detected contacts: force, then first moments about the centroid, sum of f_i y_j row by row,
                    with y from the centroid now; all global; or None
    """

    q: np.ndarray
    v: np.ndarray
    dt_over_mass: np.ndarray
    contact: np.ndarray
    hold: np.ndarray
    inner: np.ndarray
    frame: np.ndarray
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
    apart: np.ndarray | None = None
    patches: np.ndarray | None = None


def update_positions(body, dt, u):
    """Advance the dofs by dt v, write F and the displacement of every contact point."""
    q, v, arm, start, first, axes = body.q, body.v, body.arm, body.start, body.first_point, body.axes
    frame = body.frame
    for b in prange(len(q)):
        for i in range(0, 12, FOUR):
            put(q, (b, i), take(q, (b, i), four()) + dt * take(v, (b, i), four()))
        h = _columns(q, b)
        put_matrix(frame, b, _plus_one(_times_axes(h, axes, b)))
        moved = pack((q[b, 0], q[b, 1], q[b, 2], 0.0))
        by_a, by_b = pack((h[0], h[3], h[6], 0.0)), pack((h[1], h[4], h[7], 0.0))
        by_c = pack((h[2], h[5], h[8], 0.0))
        for k in range(start[b], start[b + 1]):
            put_row(u, first + k, plus(plus(plus(moved, arm[k, 0], by_a), arm[k, 1], by_b), arm[k, 2], by_c))


def move(body, dt, damping, loading, force, u):
    """Sum contact forces and their first moments, add the block's own stiffness, and advance."""
    arm, start, code, q, axes, stiffness = body.arm, body.start, body.code, body.q, body.axes, body.stiffness
    apart, patches, work = body.apart, body.patches, body.work
    for b in prange(len(q)):
        h = _columns(q, b)
        f, m, couple = moments(apart, start, code, arm, force, b)
        f, m = added(f, patch_force(patches, b)), _with_spatial(apart, patches, couple, b, m, h, axes)
        p = times_symmetric(_edges(h, axes, b), _stress(h, axes, b, -stiffness[b, 0], -stiffness[b, 1]))
        done, drawn = (four(), four(), four()), four()
        contact, inner = (f[0], f[1], f[2], m[0]), (0.0, 0.0, 0.0, p[0])
        done, drawn = _advance_row(body, b, 0, contact, inner, dt, damping, loading, done, drawn)
        done, drawn = _advance_row(body, b, 4, m[1:5], p[1:5], dt, damping, loading, done, drawn)
        done, drawn = _advance_row(body, b, 8, m[5:9], p[5:9], dt, damping, loading, done, drawn)
        keep(work, b, done)
        keep_drawn(work, b, 0.5 * dt * total(drawn))


@register_jitable
def _advance_row(body, b, first, contact, inner, dt, damping, loading, done, drawn):
    """Four dofs; `drawn` grows by what the stiffness gives, the sum of its forces now and before times v."""
    contacts, inners = pack(contact), pack(inner)
    for i in range(0, 4, FOUR):
        at, inner_force = (b, first + i), part(inners, i)
        drawn = drawn + (inner_force + take(body.inner, at, inner_force)) * take(body.v, at, inner_force)
        put(body.inner, at, inner_force)
        done = advance(body, at, part(contacts, i), inner_force, dt, damping, loading, done)
    return done, drawn


@register_jitable
def keep_drawn(work, b, drawn):
    """Take what a block's stiffness gave (J) from what was put into it, where an account is kept."""
    if work is not None:
        work[b, 3] -= drawn


@register_jitable
def _columns(q, b):
    """H of block b."""
    return q[b, 3], q[b, 4], q[b, 5], q[b, 6], q[b, 7], q[b, 8], q[b, 9], q[b, 10], q[b, 11]


@register_jitable
def _plus_one(h):
    return 1.0 + h[0], h[1], h[2], h[3], 1.0 + h[4], h[5], h[6], h[7], 1.0 + h[8]


@register_jitable
def _times_axes(h, axes, b):
    """H by derivatives along x, y, z."""
    if axes is None:
        return h
    return product(h, transposed(matrix_at(axes, b)))


@register_jitable
def _edges(h, axes, b):
    """Present axes of a block, in columns: F times the axes."""
    if axes is None:
        return _plus_one(h)
    return _sum(matrix_at(axes, b), h)


@register_jitable
def _green(h, axes, b):
    """Green's strain along the block's axes."""
    if axes is None:
        return strain(h)
    return strain(product(transposed(matrix_at(axes, b)), h))


@register_jitable
def _stress(h, axes, b, lame, mu):
    """Second Piola-Kirchhoff stress along the block's axes."""
    return second_piola(_green(h, axes, b), lame, mu)


@register_jitable
def _with_spatial(apart, patches, couple, b, moment, h, axes):
    """First moments by material levers, and what levers in space add to them."""
    if apart is None and patches is None:
        return moment
    in_space = _sum(skew(couple), patch_moments(patches, b))
    return _sum(moment, product(in_space, transposed(inverse(_edges(h, axes, b)))))


@register_jitable
def _sum(m, a):
    """Of two matrices."""
    return (
        *(m[0] + a[0], m[1] + a[1], m[2] + a[2], m[3] + a[3], m[4] + a[4], m[5] + a[5]),
        *(m[6] + a[6], m[7] + a[7], m[8] + a[8]),
    )


@jit
def observe(body, stress):
    """Write Cauchy's stress (B, 6) Pa times the volume at the start; from the state.

    Returns the elastic energy (J), the least det F, and a bound on the largest stretch of any line.
    """
    energy, smallest, largest = 0.0, np.inf, 0.0
    for b in range(len(body.q)):
        h = _columns(body.q, b)
        e = _green(h, body.axes, b)
        s, edges = second_piola(e, body.stiffness[b, 0], body.stiffness[b, 1]), _edges(h, body.axes, b)
        jacobian = determinant(_plus_one(_times_axes(h, body.axes, b)))
        t = product(times_symmetric(edges, s), transposed(edges))
        for i, value in enumerate((t[0], t[4], t[8], t[5], t[2], t[1])):
            stress[b, i] = value / jacobian
        energy += work_density(s, e)
        smallest, largest = min(smallest, jacobian), max(largest, largest_stretch(e))
    return energy, smallest, largest

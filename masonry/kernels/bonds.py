"""Bonds: contacts with strength left, between material points, in a frame that turns with the block on side a.

The law sees what it sees in small displacement: d = R^T (x_b - x_a), split along the normal of the undeformed shape,
where R turns with side a. Its force, turned forward by R, acts on both blocks at the material point of side b. So the
forces derive from the energy that the law books, and no couple is left: with d held in the frame of a, the rate of d is
the velocity of b less that of a at one and the same point.

Between two rigid blocks all of that is linear in the place x of a bond, from the first one of the two blocks:
d = d_first + R^T (R_b - R) x. So bonds of rigid blocks need no displacement of their points, and give the two blocks
one force and one moment. Where some blocks deform, all points move by themselves.
"""

from typing import NamedTuple

import numpy as np

from masonry.jit.compiler import inlined, inner
from masonry.kinematics.matrices import added, cross, matrix_at, minus, times, vector_at
from masonry.patches.press import add
from masonry.simd import numbers, pack, plus, put_row, take_row


class Bonds(NamedTuple):
    """Data of C bonds besides the arrays of contacts, which hold displacements and forces in the frame of side a.

    frames  (B, 3, 3) rotation of each block; of one that deforms, that of its polar decomposition
    alive   (C,) whether the bond holds; the law of one that does not sees no more motion, and books nothing more
    runs    (K, 4) bonds of two blocks side by side: block of side a, that of side b, the first bond, and the one behind
            the last, which is the first again where they hold no more
    lever   (K, 6) m, from the centroids of both blocks to the first bond of a run, as at the start
    across  (C, 3) m, from there to each bond, as at the start
    What follows is used where some blocks deform:
    rows    (C, 2) rows of u of both sides
    u       (S, 3) m, displacement of the material points from the start
    force   (C, 3) N on side a
    apart   (C, 3) m, u_b - u_a
    """

    frames: np.ndarray
    alive: np.ndarray
    runs: np.ndarray
    lever: np.ndarray
    across: np.ndarray
    rows: np.ndarray
    u: np.ndarray
    force: np.ndarray
    apart: np.ndarray


@inner
def part_rigid(bonds, motion, local):
    """Write the displacement of side b against side a, in the frame of a, to row 1 + c of `local` (1 + C, 3), of bonds
    between rigid blocks."""
    runs, lever, across, moved, frame = bonds.runs, bonds.lever, bonds.across, motion.moved, motion.frame
    for k in range(len(runs)):
        a, b = runs[k, 0], runs[k, 1]
        m, n = matrix_at(frame, a), matrix_at(frame, b)
        whole = minus(vector_at(moved, b, 0), vector_at(moved, a, 0))
        turned = minus(times(less_one(n), vector_at(lever, k, 3)), times(less_one(m), vector_at(lever, k, 0)))
        first = back(m, *added(whole, turned))
        of_x = back(m, n[0] - m[0], n[3] - m[3], n[6] - m[6])
        of_y = back(m, n[1] - m[1], n[4] - m[4], n[7] - m[7])
        of_z = back(m, n[2] - m[2], n[5] - m[5], n[8] - m[8])
        for c in range(runs[k, 2], runs[k, 3]):
            put_row(local, 1 + c, plus(plus(plus(first, across[c, 0], of_x), across[c, 1], of_y), across[c, 2], of_z))


@inner
def push_rigid(bonds, motion, local, force):
    """Add the forces (C, 3) N of the law, in the frames of side a, and their moments to what pushes rigid blocks."""
    runs, lever, across, frame, push = bonds.runs, bonds.lever, bonds.across, motion.frame, motion.push
    nothing = pack((0.0, 0.0, 0.0, 0.0))
    for k in range(len(runs)):
        first, last = runs[k, 2], runs[k, 3]
        if first == last:
            continue
        whole, by_x, by_y, by_z = nothing, nothing, nothing, nothing
        for c in range(first, last):
            row = take_row(force, c)
            x, y, z, _ = numbers(plus(take_row(across, c), 1.0, take_row(local, 1 + c)))
            whole, by_x = plus(whole, 1.0, row), plus(by_x, x, row)
            by_y, by_z = plus(by_y, y, row), plus(by_z, z, row)
        f, x, y, z = numbers(whole), numbers(by_x), numbers(by_y), numbers(by_z)
        f, moment = (f[0], f[1], f[2]), (y[2] - z[1], z[0] - x[2], x[1] - y[0])
        a, b = runs[k, 0], runs[k, 1]
        m, n = matrix_at(frame, a), matrix_at(frame, b)
        resultant, on_a = times(m, f), times(m, added(moment, cross(vector_at(lever, k, 0), f)))
        arm = minus(times(n, vector_at(lever, k, 3)), times(m, vector_at(local, 1 + first, 0)))
        on_b = added(times(m, moment), cross(arm, resultant))
        add(push, a, 1.0, resultant[0], resultant[1], resultant[2], on_a[0], on_a[1], on_a[2])
        add(push, b, -1.0, resultant[0], resultant[1], resultant[2], on_b[0], on_b[1], on_b[2])


@inner
def to_frames(bonds, local):
    """`part_rigid` of blocks of which some deform."""
    rows, frames, u, apart, runs = bonds.rows, bonds.frames, bonds.u, bonds.apart, bonds.runs
    for k in range(len(runs)):
        m = matrix_at(frames, runs[k, 0])
        for c in range(runs[k, 2], runs[k, 3]):
            parted = plus(take_row(u, rows[c, 1]), -1.0, take_row(u, rows[c, 0]))
            x, y, z, _ = numbers(parted)
            put_row(apart, c, parted)
            put_row(local, 1 + c, back(m, x, y, z))


@inner
def from_frames(bonds, local):
    """Turn the forces (C, 3) of the law, in the frames of side a, to x, y, z."""
    frames, force, runs = bonds.frames, bonds.force, bonds.runs
    nothing = pack((0.0, 0.0, 0.0, 0.0))
    for k in range(len(runs)):
        m = matrix_at(frames, runs[k, 0])
        of_x, of_y, of_z = pack((m[0], m[3], m[6], 0.0)), pack((m[1], m[4], m[7], 0.0)), pack((m[2], m[5], m[8], 0.0))
        for c in range(runs[k, 2], runs[k, 3]):
            x, y, z, _ = numbers(take_row(local, c))
            put_row(force, c, plus(plus(plus(nothing, x, of_x), y, of_y), z, of_z))


@inlined
def back(m, x, y, z):
    """A row of four: the transposed matrix times a vector."""
    of_x, of_y, of_z = pack((m[0], m[1], m[2], 0.0)), pack((m[3], m[4], m[5], 0.0)), pack((m[6], m[7], m[8], 0.0))
    return plus(plus(plus(pack((0.0, 0.0, 0.0, 0.0)), x, of_x), y, of_y), z, of_z)


@inlined
def less_one(m):
    """A matrix less that of unity."""
    return m[0] - 1.0, m[1], m[2], m[3], m[4] - 1.0, m[5], m[6], m[7], m[8] - 1.0

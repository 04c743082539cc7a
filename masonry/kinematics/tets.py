"""Blocks of constant-strain tets, linear elastic, small strains: 3 dofs a node; one thread owns a block."""

from typing import NamedTuple

import numpy as np
from numba import prange

from masonry.jit.compiler import jit
from masonry.jit.extending import register_jitable
from masonry.kinematics.affine import hooke
from masonry.kinematics.motion import advance, keep
from masonry.simd import (
    EIGHT,
    FOUR,
    eight,
    four,
    gather_corners,
    pack,
    part,
    plus,
    put,
    scatter,
    take,
    take_row,
    take_slopes,
    total,
)


class Tets(NamedTuple):
    """Arrays of B meshed blocks with N nodes and T tets; node k is row k of u.

    v, dt_over_mass (N, 3) velocity, and dt/mass (0 = prescribed)
    contact, hold   (N, 3) forces at the last step: contacts; damping or reaction
    inner           (N, 3) force of the tets
    start, code     contact sides of each node, as for rigid blocks
    node_start      (B + 1,)
    group_start     (B + 1,) tets are worked off in groups of eight of one block; the last is filled up with flat ones
    corner          (G, 4, 8) nodes
    slope           (G, 9, 8) sqrt(volume) times the gradients of the last three shape functions; 0 where filled up
    lame            (B, 2) Pa, lambda and mu
    work, load, guess, change  (B, 3), three times (N, 3), as for rigid blocks; None where absent

    Contact points that lie between nodes, in a surface triangle; None where there are none:
    corner_between, fraction_between  (S, 3) nodes of the triangle, and their shape functions at the point
    start_between   (B + 1,) sides of each block
    first_between   row of u at which these sides begin
    pull_start, pull_code, pull_fraction  (N + 1,), (3 S,), (3 S,) the same by nodes: sides, and the fraction of each
    """

    v: np.ndarray
    dt_over_mass: np.ndarray
    contact: np.ndarray
    hold: np.ndarray
    inner: np.ndarray
    start: np.ndarray
    code: np.ndarray
    node_start: np.ndarray
    group_start: np.ndarray
    corner: np.ndarray
    slope: np.ndarray
    lame: np.ndarray
    work: np.ndarray | None = None
    load: np.ndarray | None = None
    guess: np.ndarray | None = None
    change: np.ndarray | None = None
    corner_between: np.ndarray | None = None
    fraction_between: np.ndarray | None = None
    start_between: np.ndarray | None = None
    first_between: np.uint32 | None = None
    pull_start: np.ndarray | None = None
    pull_code: np.ndarray | None = None
    pull_fraction: np.ndarray | None = None


@register_jitable(inline="always")
def gradient(corners, g):
    """sqrt(volume) times the displacement gradient, row by row, of the corners' displacements and the slopes."""
    o, a, b, c = corners
    ax, ay, az = a[0] - o[0], a[1] - o[1], a[2] - o[2]
    bx, by, bz = b[0] - o[0], b[1] - o[1], b[2] - o[2]
    cx, cy, cz = c[0] - o[0], c[1] - o[1], c[2] - o[2]
    return (
        *(ax * g[0] + bx * g[3] + cx * g[6], ax * g[1] + bx * g[4] + cx * g[7], ax * g[2] + bx * g[5] + cx * g[8]),
        *(ay * g[0] + by * g[3] + cy * g[6], ay * g[1] + by * g[4] + cy * g[7], ay * g[2] + by * g[5] + cy * g[8]),
        *(az * g[0] + bz * g[3] + cz * g[6], az * g[1] + bz * g[4] + cz * g[7], az * g[2] + bz * g[5] + cz * g[8]),
    )


@register_jitable(inline="always")
def _push(s, x, y, z):
    """Force of a tet's stress s against the node whose shape function has the gradient (x, y, z)."""
    return s[0] * x + s[5] * y + s[4] * z, s[5] * x + s[1] * y + s[3] * z, s[4] * x + s[3] * y + s[2] * z


def update_positions(body, dt, u):
    """Advance the nodes by dt v, and with them the points between nodes."""
    v, start = body.v, body.node_start
    corner, fraction, begin, first = body.corner_between, body.fraction_between, body.start_between, body.first_between
    for b in prange(len(body.lame)):
        for n in range(start[b], start[b + 1]):
            for i in range(0, 3, FOUR):
                put(u, (n, i), take(u, (n, i), four()) + dt * take(v, (n, i), four()))
        interpolate(corner, fraction, begin, first, b, u)


@register_jitable
def interpolate(corner, fraction, start, first, b, u):
    """Displacement of the contact points of block b that lie between nodes: sum of N_j u_j."""
    if start is None:
        return
    for k in range(start[b], start[b + 1]):
        p, q, r = corner[k, 0], corner[k, 1], corner[k, 2]
        for i in range(3):
            u[first + k, i] = fraction[k, 0] * u[p, i] + fraction[k, 1] * u[q, i] + fraction[k, 2] * u[r, i]


@register_jitable
def pulled(start, code, fraction, n, force, contact):
    """The force on node n with what the contact points between nodes add to it: N_j times their force."""
    if start is None:
        return contact
    for k in range(start[n], start[n + 1]):
        contact = plus(contact, fraction[k] * (1.0 - 2.0 * (code[k] & 1)), take_row(force, code[k] >> 1))
    return contact


def move(body, dt, damping, loading, force, u):
    """Eq. (4): stress of every tet to its corners; then contacts, damping and motion of the block's nodes."""
    inner, corner, slope, lame, start, code = body.inner, body.corner, body.slope, body.lame, body.start, body.code
    pull_start, pull_code, pull_fraction = body.pull_start, body.pull_code, body.pull_fraction
    for b in prange(len(lame)):
        first, last = body.node_start[b], body.node_start[b + 1]
        for n in range(first, last):
            for i in range(0, 3, FOUR):
                put(inner, (n, i), four())
        for t in range(body.group_start[b], body.group_start[b + 1]):
            for j in range(0, 8, EIGHT):
                g = take_slopes(slope, t, j, eight())
                h = gradient(gather_corners(u, corner, t, j, eight()), g)
                s = hooke(h, -lame[b, 0], -lame[b, 1])
                px, py, pz = _push(s, g[0], g[1], g[2])
                qx, qy, qz = _push(s, g[3], g[4], g[5])
                rx, ry, rz = _push(s, g[6], g[7], g[8])
                scatter(inner, corner, (t, 0, j), -(px + qx + rx), -(py + qy + ry), -(pz + qz + rz))
                scatter(inner, corner, (t, 1, j), px, py, pz)
                scatter(inner, corner, (t, 2, j), qx, qy, qz)
                scatter(inner, corner, (t, 3, j), rx, ry, rz)
        done = four(), four(), four()
        for n in range(first, last):
            contact = pack((0.0, 0.0, 0.0, 0.0))
            for k in range(start[n], start[n + 1]):
                contact = plus(contact, 1.0 - 2.0 * (code[k] & 1), take_row(force, code[k] >> 1))
            contact = pulled(pull_start, pull_code, pull_fraction, n, force, contact)
            for i in range(0, 3, FOUR):
                done = advance(body, (n, i), part(contact, i), take(inner, (n, i), four()), dt, damping, loading, done)
        keep(body.work, b, done)


@jit
def observe(body, u, stress):
    """Write the integral of the stress (B, 6) Pa m3 over every block; return the elastic energy (J), from the state."""
    energy = 0.0
    for b in range(len(body.lame)):
        stress[b] = 0.0
        for t in range(body.group_start[b], body.group_start[b + 1]):
            for j in range(0, 8, EIGHT):
                g = take_slopes(body.slope, t, j, eight())
                h = gradient(gather_corners(u, body.corner, t, j, eight()), g)
                s = hooke(h, body.lame[b, 0], body.lame[b, 1])
                root = _root_of_volume(g)
                for i in range(6):
                    stress[b, i] += total(s[i] * root)
                shear = s[3] * (h[5] + h[7]) + s[4] * (h[2] + h[6]) + s[5] * (h[1] + h[3])
                energy += 0.5 * total(s[0] * h[0] + s[1] * h[4] + s[2] * h[8] + shear)
    return energy


@jit
def mean_rotation(body, u, rotation):
    """Write the mean small rotation (B, 3) rad of every block: the antisymmetric part of its displacement gradient."""
    for b in range(len(body.lame)):
        volume, x, y, z = 0.0, 0.0, 0.0, 0.0
        for t in range(body.group_start[b], body.group_start[b + 1]):
            for j in range(0, 8, EIGHT):
                g = take_slopes(body.slope, t, j, eight())
                h = gradient(gather_corners(u, body.corner, t, j, eight()), g)
                root = _root_of_volume(g)
                volume += total(root * root)
                x += 0.5 * total(root * (h[7] - h[5]))
                y += 0.5 * total(root * (h[2] - h[6]))
                z += 0.5 * total(root * (h[3] - h[1]))
        rotation[b, 0], rotation[b, 1], rotation[b, 2] = x / volume, y / volume, z / volume


@register_jitable
def _root_of_volume(g):
    """sqrt(V) from sqrt(V) grad N: det(grad N) = 1/(6 V), so det(slope) = sqrt(V)/6."""
    det = g[0] * (g[4] * g[8] - g[5] * g[7]) - g[1] * (g[3] * g[8] - g[5] * g[6]) + g[2] * (g[3] * g[7] - g[4] * g[6])
    return 6.0 * det

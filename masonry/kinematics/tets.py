"""Blocks of constant-strain tets, linear elastic, small strains: 3 freedoms a node; one thread owns a block."""

from typing import NamedTuple

import numpy as np
from numba import prange
from numba.extending import register_jitable

from masonry.kernels.compiler import jit
from masonry.kernels.freedom import advance
from masonry.kinematics.affine import hooke


class Tets(NamedTuple):
    """Arrays of B meshed blocks with N nodes and T tets; node k is row k of u.

    v, pace         (N, 3) velocity, and dt/mass (0 = prescribed)
    contact, hold   (N, 3) forces at the last step: contacts; damping or reaction
    inner           (N, 3) force of the tets
    start, code     contact sides of each node, as for rigid blocks
    node_start, tet_start  (B + 1,)
    corner          (T, 4) nodes
    slope           (T, 9) sqrt(volume) times the gradients of the last three shape functions
    lame            (B, 2) Pa, lambda and mu
    work, load, guess  (B, 3), (N, 3) and (N, 3), as for rigid blocks; None where absent

    Contact points that lie between nodes, in a surface triangle; None where there are none:
    corner_between, share_between  (S, 3) nodes of the triangle, and their shape functions at the point
    start_between   (B + 1,) sides of each block
    first_between   row of u at which these sides begin
    pull_start, pull_code, pull_share  (N + 1,), (3 S,), (3 S,) the same by nodes: sides, and the share of each
    """

    v: np.ndarray
    pace: np.ndarray
    contact: np.ndarray
    hold: np.ndarray
    inner: np.ndarray
    start: np.ndarray
    code: np.ndarray
    node_start: np.ndarray
    tet_start: np.ndarray
    corner: np.ndarray
    slope: np.ndarray
    lame: np.ndarray
    work: np.ndarray | None = None
    load: np.ndarray | None = None
    guess: np.ndarray | None = None
    corner_between: np.ndarray | None = None
    share_between: np.ndarray | None = None
    start_between: np.ndarray | None = None
    first_between: int | None = None
    pull_start: np.ndarray | None = None
    pull_code: np.ndarray | None = None
    pull_share: np.ndarray | None = None


@register_jitable
def gradient(corner, g, e, u):
    """sqrt(volume) times the displacement gradient of tet e, row by row; g: slopes of all tets."""
    o, a, b, c = corner[e, 0], corner[e, 1], corner[e, 2], corner[e, 3]
    ax, ay, az = u[a, 0] - u[o, 0], u[a, 1] - u[o, 1], u[a, 2] - u[o, 2]
    bx, by, bz = u[b, 0] - u[o, 0], u[b, 1] - u[o, 1], u[b, 2] - u[o, 2]
    cx, cy, cz = u[c, 0] - u[o, 0], u[c, 1] - u[o, 1], u[c, 2] - u[o, 2]
    return (
        ax * g[e, 0] + bx * g[e, 3] + cx * g[e, 6],
        ax * g[e, 1] + bx * g[e, 4] + cx * g[e, 7],
        ax * g[e, 2] + bx * g[e, 5] + cx * g[e, 8],
        ay * g[e, 0] + by * g[e, 3] + cy * g[e, 6],
        ay * g[e, 1] + by * g[e, 4] + cy * g[e, 7],
        ay * g[e, 2] + by * g[e, 5] + cy * g[e, 8],
        az * g[e, 0] + bz * g[e, 3] + cz * g[e, 6],
        az * g[e, 1] + bz * g[e, 4] + cz * g[e, 7],
        az * g[e, 2] + bz * g[e, 5] + cz * g[e, 8],
    )


@register_jitable
def _push(inner, node, s, x, y, z):
    """Force of a tet's stress s on a node whose shape function has the gradient (x, y, z)."""
    fx = s[0] * x + s[5] * y + s[4] * z
    fy = s[5] * x + s[1] * y + s[3] * z
    fz = s[4] * x + s[3] * y + s[2] * z
    inner[node, 0] -= fx
    inner[node, 1] -= fy
    inner[node, 2] -= fz
    return fx, fy, fz


def place(body, dt, u):
    """Advance the nodes by dt v, and with them the points between nodes."""
    v, start = body.v, body.node_start
    corner, share, own, first = body.corner_between, body.share_between, body.start_between, body.first_between
    for b in prange(len(body.lame)):
        for n in range(start[b], start[b + 1]):
            u[n, 0] += dt * v[n, 0]
            u[n, 1] += dt * v[n, 1]
            u[n, 2] += dt * v[n, 2]
        _interpolate(corner, share, own, first, b, u)


@register_jitable
def _interpolate(corner, share, start, first, b, u):
    """Displacement of the contact points of block b that lie between nodes: sum of N_j u_j."""
    if start is None:
        return
    for k in range(start[b], start[b + 1]):
        p, q, r = corner[k, 0], corner[k, 1], corner[k, 2]
        for i in range(3):
            u[first + k, i] = share[k, 0] * u[p, i] + share[k, 1] * u[q, i] + share[k, 2] * u[r, i]


@register_jitable
def _pulled(start, code, share, n, force, x, y, z):
    """(x, y, z) and what the contact points between nodes add to node n: N_j times their force."""
    if start is None:
        return x, y, z
    for k in range(start[n], start[n + 1]):
        c = code[k] >> 1
        part = share[k] * (1.0 - 2.0 * (code[k] & 1))
        x += part * force[c, 0]
        y += part * force[c, 1]
        z += part * force[c, 2]
    return x, y, z


def move(body, dt, damping, clock, force, u):
    """Eq. (4): stress of every tet to its corners; then contacts, damping and motion of the block's nodes."""
    inner, corner, g, lame, start, code = body.inner, body.corner, body.slope, body.lame, body.start, body.code
    pull_start, pull_code, pull_share = body.pull_start, body.pull_code, body.pull_share
    for b in prange(len(lame)):
        first, last = body.node_start[b], body.node_start[b + 1]
        for n in range(first, last):
            inner[n, 0], inner[n, 1], inner[n, 2] = 0.0, 0.0, 0.0
        for e in range(body.tet_start[b], body.tet_start[b + 1]):
            s = hooke(gradient(corner, g, e, u), lame[b, 0], lame[b, 1])
            px, py, pz = _push(inner, corner[e, 1], s, g[e, 0], g[e, 1], g[e, 2])
            qx, qy, qz = _push(inner, corner[e, 2], s, g[e, 3], g[e, 4], g[e, 5])
            rx, ry, rz = _push(inner, corner[e, 3], s, g[e, 6], g[e, 7], g[e, 8])
            o = corner[e, 0]
            inner[o, 0] += px + qx + rx
            inner[o, 1] += py + qy + ry
            inner[o, 2] += pz + qz + rz
        for n in range(first, last):
            fx, fy, fz = 0.0, 0.0, 0.0
            for k in range(start[n], start[n + 1]):
                c = code[k] >> 1
                side = 1.0 - 2.0 * (code[k] & 1)
                fx += side * force[c, 0]
                fy += side * force[c, 1]
                fz += side * force[c, 2]
            fx, fy, fz = _pulled(pull_start, pull_code, pull_share, n, force, fx, fy, fz)
            advance(body, n, 0, b, fx, inner[n, 0], dt, damping, clock)
            advance(body, n, 1, b, fy, inner[n, 1], dt, damping, clock)
            advance(body, n, 2, b, fz, inner[n, 2], dt, damping, clock)


@jit
def observe(body, u, stress):
    """Write the integral of the stress (B, 6) Pa m3 over every block; return the elastic energy (J), from the state."""
    energy = 0.0
    for b in range(len(body.lame)):
        stress[b] = 0.0
        for e in range(body.tet_start[b], body.tet_start[b + 1]):
            h = gradient(body.corner, body.slope, e, u)
            s = hooke(h, body.lame[b, 0], body.lame[b, 1])
            root = _root_of_volume(body.slope, e)
            for i in range(6):
                stress[b, i] += s[i] * root
            shear = s[3] * (h[5] + h[7]) + s[4] * (h[2] + h[6]) + s[5] * (h[1] + h[3])
            energy += 0.5 * (s[0] * h[0] + s[1] * h[4] + s[2] * h[8] + shear)
    return energy


@jit
def mean_turn(body, u, turn):
    """Write the mean small rotation (B, 3) rad of every block: the antisymmetric part of its displacement gradient."""
    for b in range(len(body.lame)):
        volume, x, y, z = 0.0, 0.0, 0.0, 0.0
        for e in range(body.tet_start[b], body.tet_start[b + 1]):
            h = gradient(body.corner, body.slope, e, u)
            root = _root_of_volume(body.slope, e)
            volume += root * root
            x += 0.5 * root * (h[7] - h[5])
            y += 0.5 * root * (h[2] - h[6])
            z += 0.5 * root * (h[3] - h[1])
        turn[b, 0], turn[b, 1], turn[b, 2] = x / volume, y / volume, z / volume


@register_jitable
def _root_of_volume(g, e):
    """sqrt(V) from sqrt(V) grad N: det(grad N) = 1/(6 V), so det(slope) = sqrt(V)/6."""
    det = (
        g[e, 0] * (g[e, 4] * g[e, 8] - g[e, 5] * g[e, 7])
        - g[e, 1] * (g[e, 3] * g[e, 8] - g[e, 5] * g[e, 6])
        + g[e, 2] * (g[e, 3] * g[e, 7] - g[e, 4] * g[e, 6])
    )
    return 6.0 * det

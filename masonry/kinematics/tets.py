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
    work, load      (B, 3) and (N, 3), as for rigid blocks; None where absent
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


@register_jitable
def gradient(corner, slope, e, u):
    """sqrt(volume) times the displacement gradient of tet e, row by row."""
    o, a, b, c = corner[e, 0], corner[e, 1], corner[e, 2], corner[e, 3]
    ax, ay, az = u[a, 0] - u[o, 0], u[a, 1] - u[o, 1], u[a, 2] - u[o, 2]
    bx, by, bz = u[b, 0] - u[o, 0], u[b, 1] - u[o, 1], u[b, 2] - u[o, 2]
    cx, cy, cz = u[c, 0] - u[o, 0], u[c, 1] - u[o, 1], u[c, 2] - u[o, 2]
    g = slope[e]
    return (
        ax * g[0] + bx * g[3] + cx * g[6],
        ax * g[1] + bx * g[4] + cx * g[7],
        ax * g[2] + bx * g[5] + cx * g[8],
        ay * g[0] + by * g[3] + cy * g[6],
        ay * g[1] + by * g[4] + cy * g[7],
        ay * g[2] + by * g[5] + cy * g[8],
        az * g[0] + bz * g[3] + cz * g[6],
        az * g[1] + bz * g[4] + cz * g[7],
        az * g[2] + bz * g[5] + cz * g[8],
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
    """Advance the nodes by dt v."""
    for n in prange(len(body.v)):
        u[n, 0] += dt * body.v[n, 0]
        u[n, 1] += dt * body.v[n, 1]
        u[n, 2] += dt * body.v[n, 2]


def move(body, dt, damping, factor, factor_before, force, u):
    """Eq. (4): stress of every tet to its corners; then contacts, damping and motion of the block's nodes."""
    inner = body.inner
    for b in prange(len(body.lame)):
        first, last = body.node_start[b], body.node_start[b + 1]
        inner[first:last] = 0.0
        for e in range(body.tet_start[b], body.tet_start[b + 1]):
            s = hooke(gradient(body.corner, body.slope, e, u), body.lame[b, 0], body.lame[b, 1])
            g, corner = body.slope[e], body.corner[e]
            px, py, pz = _push(inner, corner[1], s, g[0], g[1], g[2])
            qx, qy, qz = _push(inner, corner[2], s, g[3], g[4], g[5])
            rx, ry, rz = _push(inner, corner[3], s, g[6], g[7], g[8])
            inner[corner[0], 0] += px + qx + rx
            inner[corner[0], 1] += py + qy + ry
            inner[corner[0], 2] += pz + qz + rz
        for n in range(first, last):
            fx, fy, fz = 0.0, 0.0, 0.0
            for k in range(body.start[n], body.start[n + 1]):
                c = body.code[k] >> 1
                side = 1.0 - 2.0 * (body.code[k] & 1)
                fx += side * force[c, 0]
                fy += side * force[c, 1]
                fz += side * force[c, 2]
            advance(body, n, 0, b, fx, inner[n, 0], dt, damping, factor, factor_before)
            advance(body, n, 1, b, fy, inner[n, 1], dt, damping, factor, factor_before)
            advance(body, n, 2, b, fz, inner[n, 2], dt, damping, factor, factor_before)


@jit
def observe(body, u, stress):
    """Write the integral of the stress (B, 6) Pa m3 over every block; return the elastic energy (J), from the state."""
    energy = 0.0
    for b in range(len(body.lame)):
        stress[b] = 0.0
        for e in range(body.tet_start[b], body.tet_start[b + 1]):
            h = gradient(body.corner, body.slope, e, u)
            s = hooke(h, body.lame[b, 0], body.lame[b, 1])
            root = _root_of_volume(body.slope[e])
            for i in range(6):
                stress[b, i] += s[i] * root
            shear = s[3] * (h[5] + h[7]) + s[4] * (h[2] + h[6]) + s[5] * (h[1] + h[3])
            energy += 0.5 * (s[0] * h[0] + s[1] * h[4] + s[2] * h[8] + shear)
    return energy


@register_jitable
def _root_of_volume(g):
    """sqrt(V) from sqrt(V) grad N: det(grad N) = 1/(6 V), so det(slope) = sqrt(V)/6."""
    det = g[0] * (g[4] * g[8] - g[5] * g[7]) - g[1] * (g[3] * g[8] - g[5] * g[6]) + g[2] * (g[3] * g[7] - g[4] * g[6])
    return 6.0 * det

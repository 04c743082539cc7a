"""Rigid and deforming blocks side by side, for what blocks meet: gathered from the bodies, and forces handed back.

A block of tets is as many bodies as it has tets at its surface: each moves as an affine block, x = sum of N_i x_i, and
hands a force at its material point X to its nodes as N_i(X) times that.

Scenes of rigid blocks alone do without: there the arrays of the bodies are those of BlockMotion.
"""

from math import sqrt
from typing import NamedTuple

import numpy as np

from masonry.jit.compiler import inner
from masonry.kinematics.levers import axial
from masonry.kinematics.matrices import (
    inverse,
    matrix_at,
    nearest_rotation,
    product,
    put_matrix,
    put_vector,
    transposed,
    vector_at,
)


class Members(NamedTuple):
    """Which blocks are rigid, affine and of tets, as numbers among all blocks; (0,) where there are none.

    reach  (B,) m, from the centroid of every body to its farthest corner at the start
    node   (T, 4) of the tets at the surface, which are the last T bodies    slope (T, 4, 3) 1/m, of shape functions
    """

    rigid: np.ndarray
    affine: np.ndarray
    tets: np.ndarray
    reach: np.ndarray
    node: np.ndarray
    slope: np.ndarray


@inner
def gather_velocities(motion, members, rigid, affine, tets):
    """Velocities, spins, rates of F and of stretching of all bodies, and the radii that they have now."""
    v, rate, radius, reach = motion.v, motion.rate, motion.radius, members.reach
    if rigid is not None:
        for k in range(len(members.rigid)):
            b = members.rigid[k]
            for i in range(6):
                v[b, i] = rigid.v[k, i]
            x, y, z = vector_at(v, b, 3)
            put_matrix(rate, b, product((0.0, -z, y, z, 0.0, -x, -y, x, 0.0), matrix_at(rigid.frame, k)))
    if affine is not None:
        for k in range(len(members.affine)):
            b = members.affine[k]
            put_vector(v, b, 0, vector_at(affine.v, k, 0))
            gradient_rate = in_space(affine.axes, k, affine.v)
            put_matrix(rate, b, gradient_rate)
            stretching(motion, b, gradient_rate)
            radius[b] = longest(matrix_at(affine.frame, k)) * reach[b]
    if tets is not None:
        first = len(v) - len(members.node)
        for t in range(len(members.node)):
            b = first + t
            mean, gradient_rate = spread(members, t, tets.v)
            put_vector(v, b, 0, mean)
            put_matrix(rate, b, gradient_rate)
            stretching(motion, b, gradient_rate)
            radius[b] = longest(matrix_at(motion.frame, b)) * reach[b]


@inner
def gather_places(motion, members, rigid, affine, tets, bonds):
    """Places, deformation gradients and their inverses of all bodies, and the rotations that the bonds turn with."""
    moved, frame, dual = motion.moved, motion.frame, motion.dual
    turning = len(bonds.rows) > 0
    if rigid is not None:
        for k in range(len(members.rigid)):
            b = members.rigid[k]
            put_vector(moved, b, 0, vector_at(rigid.q, k, 0))
            gradient = matrix_at(rigid.frame, k)
            put_matrix(frame, b, gradient)
            put_matrix(dual, b, gradient)
            put_matrix(bonds.frames, b, gradient)
    if affine is not None:
        for k in range(len(members.affine)):
            b = members.affine[k]
            put_vector(moved, b, 0, vector_at(affine.q, k, 0))
            gradient = matrix_at(affine.frame, k)
            put_matrix(frame, b, gradient)
            put_matrix(dual, b, transposed(inverse(gradient)))
            if turning:
                put_matrix(bonds.frames, b, nearest_rotation(gradient))
    if tets is not None:
        first = len(moved) - len(members.node)
        for t in range(len(members.node)):
            b = first + t
            mean, h = spread(members, t, bonds.u)
            gradient = 1.0 + h[0], h[1], h[2], h[3], 1.0 + h[4], h[5], h[6], h[7], 1.0 + h[8]
            put_vector(moved, b, 0, mean)
            put_matrix(frame, b, gradient)
            put_matrix(dual, b, transposed(inverse(gradient)))
        for k in range(len(members.tets)):
            if turning:
                put_matrix(bonds.frames, members.tets[k], nearest_rotation(matrix_at(tets.frame, k)))


@inner
def hand_over(motion, members, rigid, affine, tets):
    """Give the bodies the forces of the patches: rigid blocks moments, affine ones first moments, nodes forces."""
    push = motion.push
    if rigid is not None:
        for k in range(len(members.rigid)):
            b = members.rigid[k]
            put_vector(rigid.patches, k, 0, vector_at(push, b, 0))
            put_vector(rigid.patches, k, 3, axial(first_moments(push, b)))
    if affine is not None:
        for k in range(len(members.affine)):
            b = members.affine[k]
            for i in range(12):
                affine.patches[k, i] = push[b, i]
    if tets is not None:
        for n in range(len(tets.patches)):
            put_vector(tets.patches, n, 0, (0.0, 0.0, 0.0))
        first = len(push) - len(members.node)
        for t in range(len(members.node)):
            b = first + t
            if push[b, 0] == 0.0 and push[b, 1] == 0.0 and push[b, 2] == 0.0:
                continue
            m = product(first_moments(push, b), matrix_at(motion.dual, b))
            for c in range(4):
                n, x, y, z = members.node[t, c], members.slope[t, c, 0], members.slope[t, c, 1], members.slope[t, c, 2]
                for i in range(3):
                    tets.patches[n, i] += 0.25 * push[b, i]
                tets.patches[n, 0] += m[0] * x + m[1] * y + m[2] * z
                tets.patches[n, 1] += m[3] * x + m[4] * y + m[5] * z
                tets.patches[n, 2] += m[6] * x + m[7] * y + m[8] * z


@inner
def first_moments(push, b):
    """Those of a row of `push`."""
    return *vector_at(push, b, 3), *vector_at(push, b, 6), *vector_at(push, b, 9)


@inner
def spread(members, t, values):
    """Mean (3) and gradient (9) over a tet of a field with values (., 3) at the nodes."""
    node, slope = members.node, members.slope
    mx = my = mz = a = b = c = d = e = f = g = h = i = 0.0
    for k in range(4):
        n, x, y, z = node[t, k], slope[t, k, 0], slope[t, k, 1], slope[t, k, 2]
        vx, vy, vz = values[n, 0], values[n, 1], values[n, 2]
        mx, my, mz = mx + 0.25 * vx, my + 0.25 * vy, mz + 0.25 * vz
        a, b, c = a + vx * x, b + vx * y, c + vx * z
        d, e, f = d + vy * x, e + vy * y, f + vy * z
        g, h, i = g + vz * x, h + vz * y, i + vz * z
    return (mx, my, mz), (a, b, c, d, e, f, g, h, i)


@inner
def in_space(axes, k, v):
    """F' of an affine block, with derivatives along x, y, z."""
    h = v[k, 3], v[k, 4], v[k, 5], v[k, 6], v[k, 7], v[k, 8], v[k, 9], v[k, 10], v[k, 11]
    if axes is None:
        return h
    return product(h, transposed(matrix_at(axes, k)))


@inner
def stretching(motion, b, rate):
    """Write the spin of block b and the norm of its rate of stretching, from its F'."""
    g = product(rate, transposed(matrix_at(motion.dual, b)))
    x, y, z = axial(g)
    put_vector(motion.v, b, 3, (0.5 * x, 0.5 * y, 0.5 * z))
    p, q, r = g[5] + g[7], g[2] + g[6], g[1] + g[3]
    motion.strain[b] = sqrt(g[0] * g[0] + g[4] * g[4] + g[8] * g[8] + 0.5 * (p * p + q * q + r * r))


@inner
def longest(f):
    """A bound on the stretch of any line, the same from wherever one looks: |F x|^2 <= 1 + norm of F^T F - 1."""
    c = product(transposed(f), f)
    x, y, z = c[0] - 1.0, c[4] - 1.0, c[8] - 1.0
    return sqrt(1.0 + sqrt(x * x + y * y + z * z + 2.0 * (c[1] * c[1] + c[2] * c[2] + c[5] * c[5])))

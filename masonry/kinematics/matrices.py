"""Matrices of 3 x 3 numbers or lanes, nine in a tuple row by row, and the rotations among them."""

from math import cos, sin, sqrt

import numpy as np
from numba.core import types

from masonry.jit.compiler import jit
from masonry.jit.extending import overload, register_jitable
from masonry.simd import any_lane, maximum, where

SMALL_ANGLE_SQUARED = 0.01
"""rad2: below, five terms of the series are exact to round-off."""
SINE = -1.0 / 6.0, 1.0 / 120.0, -1.0 / 5040.0, 1.0 / 362880.0
COSINE = -1.0 / 24.0, 1.0 / 720.0, -1.0 / 40320.0, 1.0 / 3628800.0
"""Of sin(x) / x and (1 - cos x) / x2, in powers of x2."""


@register_jitable
def times(m, a):
    """Matrix times vector."""
    x, y, z = a
    return (
        m[0] * x + m[1] * y + m[2] * z,
        m[3] * x + m[4] * y + m[5] * z,
        m[6] * x + m[7] * y + m[8] * z,
    )


@register_jitable
def transposed_times(m, a):
    """Transposed matrix times vector."""
    x, y, z = a
    return (
        m[0] * x + m[3] * y + m[6] * z,
        m[1] * x + m[4] * y + m[7] * z,
        m[2] * x + m[5] * y + m[8] * z,
    )


@register_jitable
def cross(a, b):
    """Vector product."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@register_jitable
def dot(a, b):
    """Scalar product of two vectors."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@register_jitable
def added(a, b):
    """Sum of two vectors."""
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


@register_jitable
def minus(a, b):
    """Difference of two vectors."""
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


@register_jitable
def scaled(factor, a):
    """Number times vector."""
    return factor * a[0], factor * a[1], factor * a[2]


@register_jitable
def each(a, b):
    """Products of the components of two vectors."""
    return a[0] * b[0], a[1] * b[1], a[2] * b[2]


@register_jitable
def vector_at(array, b, i):
    """array[b, i:i + 3] as a tuple."""
    return array[b, i], array[b, i + 1], array[b, i + 2]


def vector_or_zero(array, b, i):
    """`vector_at`; 0 where the array is absent."""
    return (0.0, 0.0, 0.0) if array is None else vector_at(array, b, i)


@overload(vector_or_zero)
def _vector_or_zero(array, b, i):
    if isinstance(array, types.Array):
        return lambda array, b, i: vector_at(array, b, i)
    return lambda array, b, i: (0.0, 0.0, 0.0)


@register_jitable
def put_vector(array, b, i, a):
    """Write array[b, i:i + 3]."""
    array[b, i], array[b, i + 1], array[b, i + 2] = a[0], a[1], a[2]


@register_jitable
def transposed(m):
    """Transposed matrix."""
    return m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8]


@register_jitable
def product(m, a):
    """Product of two matrices."""
    return (
        *(m[0] * a[0] + m[1] * a[3] + m[2] * a[6], m[0] * a[1] + m[1] * a[4] + m[2] * a[7]),
        *(m[0] * a[2] + m[1] * a[5] + m[2] * a[8], m[3] * a[0] + m[4] * a[3] + m[5] * a[6]),
        *(m[3] * a[1] + m[4] * a[4] + m[5] * a[7], m[3] * a[2] + m[4] * a[5] + m[5] * a[8]),
        *(m[6] * a[0] + m[7] * a[3] + m[8] * a[6], m[6] * a[1] + m[7] * a[4] + m[8] * a[7]),
        m[6] * a[2] + m[7] * a[5] + m[8] * a[8],
    )


@register_jitable
def determinant(m):
    """Determinant."""
    return m[0] * (m[4] * m[8] - m[5] * m[7]) + m[1] * (m[5] * m[6] - m[3] * m[8]) + m[2] * (m[3] * m[7] - m[4] * m[6])


@register_jitable
def inverse(m):
    """The inverse, by cofactors."""
    a, b, c = m[4] * m[8] - m[5] * m[7], m[2] * m[7] - m[1] * m[8], m[1] * m[5] - m[2] * m[4]
    d, e, f = m[5] * m[6] - m[3] * m[8], m[0] * m[8] - m[2] * m[6], m[2] * m[3] - m[0] * m[5]
    g, h, i = m[3] * m[7] - m[4] * m[6], m[1] * m[6] - m[0] * m[7], m[0] * m[4] - m[1] * m[3]
    s = 1.0 / (m[0] * a + m[1] * d + m[2] * g)
    return s * a, s * b, s * c, s * d, s * e, s * f, s * g, s * h, s * i


@register_jitable
def strain(h):
    """Green's strain (xx yy zz yz xz xy) of the displacement gradient h: (h + h^T + h^T h) / 2."""
    return (
        h[0] + 0.5 * (h[0] * h[0] + h[3] * h[3] + h[6] * h[6]),
        h[4] + 0.5 * (h[1] * h[1] + h[4] * h[4] + h[7] * h[7]),
        h[8] + 0.5 * (h[2] * h[2] + h[5] * h[5] + h[8] * h[8]),
        0.5 * (h[5] + h[7] + h[1] * h[2] + h[4] * h[5] + h[7] * h[8]),
        0.5 * (h[2] + h[6] + h[0] * h[2] + h[3] * h[5] + h[6] * h[8]),
        0.5 * (h[1] + h[3] + h[0] * h[1] + h[3] * h[4] + h[6] * h[7]),
    )


@register_jitable
def second_piola(e, lame, mu):
    """St Venant-Kirchhoff: S = lambda tr(E) 1 + 2 mu E (xx yy zz yz xz xy) of Green's strain E."""
    pressure, two_mu = lame * (e[0] + e[1] + e[2]), 2.0 * mu
    return (
        *(pressure + two_mu * e[0], pressure + two_mu * e[1], pressure + two_mu * e[2]),
        *(two_mu * e[3], two_mu * e[4], two_mu * e[5]),
    )


@register_jitable
def times_symmetric(m, s):
    """Matrix times a symmetric one (xx yy zz yz xz xy)."""
    return (
        *(m[0] * s[0] + m[1] * s[5] + m[2] * s[4], m[0] * s[5] + m[1] * s[1] + m[2] * s[3]),
        *(m[0] * s[4] + m[1] * s[3] + m[2] * s[2], m[3] * s[0] + m[4] * s[5] + m[5] * s[4]),
        *(m[3] * s[5] + m[4] * s[1] + m[5] * s[3], m[3] * s[4] + m[4] * s[3] + m[5] * s[2]),
        *(m[6] * s[0] + m[7] * s[5] + m[8] * s[4], m[6] * s[5] + m[7] * s[1] + m[8] * s[3]),
        m[6] * s[4] + m[7] * s[3] + m[8] * s[2],
    )


@register_jitable
def work_density(s, e):
    """S : E / 2 of two symmetric matrices (xx yy zz yz xz xy): the energy of St Venant-Kirchhoff."""
    return 0.5 * (s[0] * e[0] + s[1] * e[1] + s[2] * e[2]) + s[3] * e[3] + s[4] * e[4] + s[5] * e[5]


@register_jitable
def largest_stretch(e):
    """A bound on the stretch of any line, from Green's strain: C = 1 + 2 E has no eigenvalue above its row sums."""
    x = abs(1.0 + 2.0 * e[0]) + 2.0 * (abs(e[5]) + abs(e[4]))
    y = abs(1.0 + 2.0 * e[1]) + 2.0 * (abs(e[5]) + abs(e[3]))
    z = abs(1.0 + 2.0 * e[2]) + 2.0 * (abs(e[4]) + abs(e[3]))
    return sqrt(maximum(x, maximum(y, z)))


@register_jitable
def exponential(rotation):
    """The rotation by a vector of rad (Rodrigues)."""
    x, y, z = rotation
    square = x * x + y * y + z * z
    s = 1.0 + square * (SINE[0] + square * (SINE[1] + square * (SINE[2] + square * SINE[3])))
    c = 0.5 + square * (COSINE[0] + square * (COSINE[1] + square * (COSINE[2] + square * COSINE[3])))
    large = square >= SMALL_ANGLE_SQUARED
    if any_lane(large):
        angle = sqrt(square)
        s, c = where(large, sin(angle) / angle, s), where(large, (1.0 - cos(angle)) / square, c)
    xy, xz, yz = c * x * y, c * x * z, c * y * z
    x2, y2, z2 = c * x * x, c * y * y, c * z * z
    return (
        *(1.0 - (y2 + z2), xy - s * z, xz + s * y),
        *(xy + s * z, 1.0 - (x2 + z2), yz - s * x),
        *(xz - s * y, yz + s * x, 1.0 - (x2 + y2)),
    )


@register_jitable
def straightened(r):
    """The rotation next to r, one but for round-off: r (3 - r^T r) / 2. That turns nothing, so no energy drifts."""
    a, b, c, d, e, f = strain((r[0] - 1.0, r[1], r[2], r[3], r[4] - 1.0, r[5], r[6], r[7], r[8] - 1.0))
    rest = times_symmetric(r, (a, b, c, d, e, f))
    return (
        *(r[0] - rest[0], r[1] - rest[1], r[2] - rest[2], r[3] - rest[3], r[4] - rest[4], r[5] - rest[5]),
        *(r[6] - rest[6], r[7] - rest[7], r[8] - rest[8]),
    )


@register_jitable
def _mean(m, t):
    """Of two matrices."""
    return (
        *(0.5 * (m[0] + t[0]), 0.5 * (m[1] + t[1]), 0.5 * (m[2] + t[2]), 0.5 * (m[3] + t[3]), 0.5 * (m[4] + t[4])),
        *(0.5 * (m[5] + t[5]), 0.5 * (m[6] + t[6]), 0.5 * (m[7] + t[7]), 0.5 * (m[8] + t[8])),
    )


@register_jitable
def nearest_rotation(m):
    """The rotation of the polar decomposition, for det m > 0: Newton's iteration r <- (r + r^-T) / 2 (Higham 1986)."""
    for _ in range(30):
        t = transposed(inverse(m))
        m, last = _mean(m, t), m
        change = 0.0
        for i in range(9):
            change += (m[i] - last[i]) ** 2
        if change < 1e-17:  # the next change is about its square, and nothing
            break
    return m


@register_jitable
def matrix_at(array, b):
    """array[b] of an array (B, 3, 3) as a tuple."""
    return (
        *(array[b, 0, 0], array[b, 0, 1], array[b, 0, 2], array[b, 1, 0], array[b, 1, 1], array[b, 1, 2]),
        *(array[b, 2, 0], array[b, 2, 1], array[b, 2, 2]),
    )


@register_jitable
def put_matrix(array, b, m):
    """Write array[b] of an array (B, 3, 3)."""
    array[b, 0, 0], array[b, 0, 1], array[b, 0, 2] = m[0], m[1], m[2]
    array[b, 1, 0], array[b, 1, 1], array[b, 1, 2] = m[3], m[4], m[5]
    array[b, 2, 0], array[b, 2, 1], array[b, 2, 2] = m[6], m[7], m[8]


@jit
def _rotations(frame, found):
    for b in range(len(frame)):
        put_matrix(found, b, nearest_rotation(matrix_at(frame, b)))


def rotations(frame: np.ndarray) -> np.ndarray:
    """(B, 3, 3) rotations of deformation gradients (B, 3, 3): of the `frame` of deforming blocks."""
    found = np.empty(frame.shape)
    _rotations(frame, found)
    return found


def rotation_angles(frame: np.ndarray) -> np.ndarray:
    """(B,) rad of rotations (B, 3, 3)."""
    sine = np.stack([frame[:, 2, 1] - frame[:, 1, 2], frame[:, 0, 2] - frame[:, 2, 0], frame[:, 1, 0] - frame[:, 0, 1]])
    return np.arctan2(np.linalg.norm(sine, axis=0), np.einsum("bii->b", frame) - 1.0)

"""The overlap of two faces seen along the common normal, and the planes of both faces above it."""

from math import inf, sqrt
from typing import NamedTuple

import numpy as np

from masonry.detection.clip import clip
from masonry.detection.features import OTHER
from masonry.detection.pieces import ConvexPieces
from masonry.jit.compiler import inlined, inner


class Scratch(NamedTuple):
    """Room for one pair at a time; each thread needs its own.

    u, v, label (2, K) polygons; wu, wv (K,) a window; weight, name (K,) of corners; edges (2, E) candidates;
    edge_u, edge_v (2, K) two patches that are compared
    """

    u: np.ndarray
    v: np.ndarray
    label: np.ndarray
    wu: np.ndarray
    wv: np.ndarray
    weight: np.ndarray
    name: np.ndarray
    edges: np.ndarray
    edge_u: np.ndarray
    edge_v: np.ndarray


class Common(NamedTuple):
    """Axes of a common plane, its origin from the position of the first body, and the heights of both faces above it.

    s, t   in the plane; n across it, from the first piece to the second
    a, b   height of the first and the second face at (u, v): a_u u + a_v v, and b_0 + b_u u + b_v v, m
    """

    ox: float
    oy: float
    oz: float
    sx: float
    sy: float
    sz: float
    tx: float
    ty: float
    tz: float
    nx: float
    ny: float
    nz: float
    au: float
    av: float
    b0: float
    bu: float
    bv: float


def most_points(pieces: ConvexPieces) -> int:
    """The most contact points that one pair of pieces can have."""
    return 2 * int(np.diff(pieces.loop_start).max(initial=3)) + 1


def scratch_of(pieces: ConvexPieces) -> Scratch:
    """Room for any pair of these pieces."""
    k = 2 * most_points(pieces)
    numbers = np.zeros((2, k)), np.zeros((2, k)), np.zeros((2, k), dtype=np.int64), np.zeros(k), np.zeros(k)
    edges = np.zeros((2, int(np.diff(pieces.edge_start).max(initial=1))), dtype=np.int64)
    return Scratch(*numbers, np.zeros(k), np.zeros(k, dtype=np.int64), edges, np.zeros((2, k)), np.zeros((2, k)))


@inlined
def common_plane(vertex, loop, loop_start, normal, offset, fa, fb, dx, dy, dz, nx, ny, nz):
    """The plane across n through the first corner of face fa; face fb belongs to a body at d."""
    if abs(nx) <= abs(ny) and abs(nx) <= abs(nz):
        sx, sy, sz = 0.0, nz, -ny
    elif abs(ny) <= abs(nz):
        sx, sy, sz = -nz, 0.0, nx
    else:
        sx, sy, sz = ny, -nx, 0.0
    scale = 1.0 / sqrt(sx * sx + sy * sy + sz * sz)
    sx, sy, sz = scale * sx, scale * sy, scale * sz
    tx, ty, tz = ny * sz - nz * sy, nz * sx - nx * sz, nx * sy - ny * sx
    o = loop[loop_start[fa]]
    ox, oy, oz = vertex[o, 0], vertex[o, 1], vertex[o, 2]
    ax, ay, az = normal[fa, 0], normal[fa, 1], normal[fa, 2]
    bx, by, bz = normal[fb, 0], normal[fb, 1], normal[fb, 2]
    along_a = -1.0 / (ax * nx + ay * ny + az * nz)
    along_b = -1.0 / (bx * nx + by * ny + bz * nz)
    return Common(
        ox, oy, oz, sx, sy, sz, tx, ty, tz, nx, ny, nz,
        along_a * (ax * sx + ay * sy + az * sz), along_a * (ax * tx + ay * ty + az * tz),
        along_b * (bx * (ox - dx) + by * (oy - dy) + bz * (oz - dz) - offset[fb]),
        along_b * (bx * sx + by * sy + bz * sz), along_b * (bx * tx + by * ty + bz * tz),
    )  # fmt: skip


@inlined
def overlap(vertex, loop, loop_start, fa, fb, dx, dy, dz, plane, snap, u, v, label, height, wu, wv):
    """The overlap polygon of faces fa and fb in the axes of the plane: its row in u, v and number of corners."""
    ox, oy, oz = plane.ox, plane.oy, plane.oz
    sx, sy, sz, tx, ty, tz = plane.sx, plane.sy, plane.sz, plane.tx, plane.ty, plane.tz
    first, count = loop_start[fa], loop_start[fa + 1] - loop_start[fa]
    for k in range(count):
        i = loop[first + k]
        x, y, z = vertex[i, 0] - ox, vertex[i, 1] - oy, vertex[i, 2] - oz
        u[0, k], v[0, k], label[0, k] = sx * x + sy * y + sz * z, tx * x + ty * y + tz * z, k
    ox, oy, oz = ox - dx, oy - dy, oz - dz
    first, window = loop_start[fb], loop_start[fb + 1] - loop_start[fb]
    for k in range(window):
        i = loop[first + k]
        x, y, z = vertex[i, 0] - ox, vertex[i, 1] - oy, vertex[i, 2] - oz
        wu[k], wv[k] = sx * x + sy * y + sz * z, tx * x + ty * y + tz * z
    return clip(u, v, label, height, count, wu, wv, window, OTHER, snap)


@inner
def beside(vertex, loop, loop_start, fa, fb, dx, dy, dz, plane):
    """How far (m) faces fa and fb are apart along a line of the plane, at least: 0 where no edge of them parts them."""
    sx, sy, sz, tx, ty, tz = plane.sx, plane.sy, plane.sz, plane.tx, plane.ty, plane.tz
    widest = 0.0
    for side in range(2):
        face, other, sign = (fa, fb, 1.0) if side == 0 else (fb, fa, -1.0)
        first, last = loop_start[face], loop_start[face + 1]
        for k in range(first, last):
            i, j = loop[k], loop[k + 1 if k + 1 < last else first]
            x, y, z = vertex[j, 0] - vertex[i, 0], vertex[j, 1] - vertex[i, 1], vertex[j, 2] - vertex[i, 2]
            eu, ev = sx * x + sy * y + sz * z, tx * x + ty * y + tz * z
            size = sqrt(eu * eu + ev * ev)
            nearest = inf
            for m in range(loop_start[other], loop_start[other + 1]):
                o = loop[m]
                x = vertex[o, 0] + sign * dx - vertex[i, 0]
                y = vertex[o, 1] + sign * dy - vertex[i, 1]
                z = vertex[o, 2] + sign * dz - vertex[i, 2]
                u, v = sx * x + sy * y + sz * z, tx * x + ty * y + tz * z
                nearest = min(nearest, sign * (ev * u - eu * v))  # the second face is seen from behind
            widest = max(widest, nearest / size)
    return widest


@inlined
def point_of(plane, u, v, h):
    """Where (u, v) of a plane at height h is, from the position of the first body."""
    return (
        plane.ox + u * plane.sx + v * plane.tx + h * plane.nx,
        plane.oy + u * plane.sy + v * plane.ty + h * plane.ny,
        plane.oz + u * plane.sz + v * plane.tz + h * plane.nz,
    )


@inlined
def heights(plane, u, v):
    """Heights (m) of the first and the second face at (u, v) of a plane."""
    return plane.au * u + plane.av * v, plane.b0 + plane.bu * u + plane.bv * v

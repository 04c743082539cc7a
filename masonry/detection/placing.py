"""Pieces turned as their bodies are now. Places stay apart from turns, so that far from the origin no digit is lost."""

from math import sqrt
from typing import NamedTuple

import numpy as np

from masonry.detection.pieces import ConvexPieces
from masonry.jit.compiler import inner, jit

ALIKE = 1e-6
"""Of their size: difference of two blocks that are as large as each other."""


class TurnedPieces(NamedTuple):
    """Corners (V, 3) and centres (P, 3), m from the position of their body, turned; normals (F, 3) and offsets (F,):
    normal . corner = offset on face f. For V corners, P pieces, F faces of `ConvexPieces`.
    """

    vertex: np.ndarray
    centre: np.ndarray
    normal: np.ndarray
    offset: np.ndarray


def turned_of(pieces: ConvexPieces) -> TurnedPieces:
    """The pieces as they were built, frame = 1."""
    first = pieces.vertex[pieces.loop[pieces.loop_start[:-1]]]
    offset = np.einsum("fi,fi->f", pieces.normal, first)
    return TurnedPieces(pieces.vertex.copy(), pieces.centre.copy(), pieces.normal.copy(), offset)


@inner
def cofactor(frame, out):
    """Cofactor matrix (3, 3) of a frame into out: a rotation is its own, normals turn with it."""
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        for a in range(3):
            b, c = (a + 1) % 3, (a + 2) % 3
            out[i, a] = frame[j, b] * frame[k, c] - frame[j, c] * frame[k, b]


@inner
def update_piece(pieces, piece, frame, turned):
    """Write corners, centre, normals and offsets of one piece for the frame (3, 3) of its body into `turned`."""
    vertex, centre, normal, offset = turned.vertex, turned.centre, turned.normal, turned.offset
    vertex_0, centre_0, normal_0, loop = pieces.vertex, pieces.centre, pieces.normal, pieces.loop
    loop_start = pieces.loop_start
    a, b, c = frame[0, 0], frame[0, 1], frame[0, 2]
    d, e, f = frame[1, 0], frame[1, 1], frame[1, 2]
    g, h, i = frame[2, 0], frame[2, 1], frame[2, 2]
    for v in range(pieces.vertex_start[piece], pieces.vertex_start[piece + 1]):
        x, y, z = vertex_0[v, 0], vertex_0[v, 1], vertex_0[v, 2]
        vertex[v, 0] = a * x + b * y + c * z
        vertex[v, 1] = d * x + e * y + f * z
        vertex[v, 2] = g * x + h * y + i * z
    x, y, z = centre_0[piece, 0], centre_0[piece, 1], centre_0[piece, 2]
    centre[piece, 0] = a * x + b * y + c * z
    centre[piece, 1] = d * x + e * y + f * z
    centre[piece, 2] = g * x + h * y + i * z
    a, b, c, d, e, f, g, h, i = (
        e * i - f * h, f * g - d * i, d * h - e * g,
        h * c - i * b, i * a - g * c, g * b - h * a,
        b * f - c * e, c * d - a * f, a * e - b * d,
    )  # fmt: skip
    for k in range(pieces.face_start[piece], pieces.face_start[piece + 1]):
        x, y, z = normal_0[k, 0], normal_0[k, 1], normal_0[k, 2]
        nx, ny, nz = a * x + b * y + c * z, d * x + e * y + f * z, g * x + h * y + i * z
        scale = 1.0 / sqrt(nx * nx + ny * ny + nz * nz)
        nx, ny, nz = scale * nx, scale * ny, scale * nz
        normal[k, 0], normal[k, 1], normal[k, 2] = nx, ny, nz
        v = loop[loop_start[k]]
        offset[k] = nx * vertex[v, 0] + ny * vertex[v, 1] + nz * vertex[v, 2]


@jit
def update_pieces(pieces, frame, turned):
    """`update_piece` of every piece; frame (N, 3, 3) of the bodies."""
    body = pieces.body
    for piece in range(len(body)):
        update_piece(pieces, piece, frame[body[piece]], turned)


@inner
def owner(pieces, i, j, blend):
    """Which of two pieces the points belong to, 0 or 1: the one that meets a face of the other.

    Where they lie face on face it is the smaller one, or of two alike the first by its rank: a choice that neither
    their numbers nor rounding changes.
    """
    if abs(blend - 0.5) > 0.25:
        return 1 if blend > 0.5 else 0
    radius_i, radius_j = pieces.radius[i], pieces.radius[j]
    if abs(radius_i - radius_j) > ALIKE * (radius_i + radius_j):
        return 1 if radius_j < radius_i else 0
    return 1 if pieces.rank[i] <= pieces.rank[j] else 0

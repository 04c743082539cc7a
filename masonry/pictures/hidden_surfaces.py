"""Blocks seen from one side, as plain arrays: the faces that can be seen, farthest first, and the edges of units."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from geometry.blocks import Blocks, Joints
from geometry.joints.covered import covered_fractions
from geometry.polyhedra.indexing import following, ranges
from geometry.polyhedra.measures import face_areas_normals_centroids
from geometry.polyhedra.polygons import areas_normals_centroids, pad
from masonry.pictures.camera import Camera

MOST_PLANES = 300
"""Faces in more planes than this are drawn by the depth of their middles alone."""
SAME_PLANE, BENT = 1.0 - 1e-6, 0.93
"""Cosines: two faces of a unit that share an edge lie in one plane; two of a block are facets of a curved surface."""
COVERED = 1 - 1e-6
"""Share of a face in joints from which on it is hidden."""
SMOOTH = np.radians(3.0)
"""Two faces of a block that meet at less than this are drawn as one."""
PIECES = 12
"""Large faces are drawn in pieces, at most so many along an edge, so that their depth can be told."""


@dataclass(frozen=True)
class Piece:
    """A face or a part of one: its corners (n, 3), and which of the edges from them bound the unit and the block.

    Where a block goes on beyond an edge without a turn, as between the triangles of a face, the edge bounds neither.
    """

    face: int
    corners: np.ndarray
    unit_edge: np.ndarray
    block_edge: np.ndarray


def visible_pieces(blocks: Blocks, joints: Joints, camera: Camera) -> list[Piece]:
    """The faces toward the viewer that no joint covers wholly, in pieces, farthest first."""
    _, normal, _ = face_areas_normals_centroids(blocks)
    seen = np.flatnonzero((normal @ camera.toward > 1e-6) & (covered_fractions(blocks, joints) < COVERED))
    corners = [blocks.face(f) for f in seen.tolist()]
    if not corners:
        return []
    edge = np.median([np.linalg.norm(np.roll(c, -1, axis=0) - c, axis=1).max() for c in corners])
    ends = np.cumsum(np.diff(blocks.face_start)[seen])[:-1]
    outer, turns = (np.split(of(blocks, seen, normal), ends) for of in (unit_edges, turning_edges))
    pieces = [
        piece
        for f, c, bounds, turning in zip(seen.tolist(), corners, outer, turns, strict=True)
        for piece in _cut(f, c, bounds & turning, turning, 1.5 * float(edge))
    ]
    size = float(np.ptp(blocks.points, axis=0).max())
    return _farthest_first(pieces, normal[[piece.face for piece in pieces]], camera, 1e-6 * size)


def hidden(point: np.ndarray, pieces: list[Piece], camera: Camera, width: float) -> bool:
    """Whether a point (3,) lies more than width (m) behind a piece as seen by the viewer."""
    return bool(behind(point[None], pieces, camera, width).any())


def behind(points: np.ndarray, pieces: list[Piece], camera: Camera, width: float = 0.0) -> np.ndarray:
    """(n, N) whether a point (n, 3) lies more than width (m) behind a piece (N) as seen by the viewer."""
    corners, _ = pad(*_joined(pieces))
    _, normal, middle = areas_normals_centroids(corners)
    edge = np.roll(corners, -1, axis=1) - corners
    is_behind = np.zeros((len(points), len(pieces)), dtype=bool)
    for n, point in enumerate(points):
        along = ((middle - point) * normal).sum(axis=1) / (normal @ camera.toward)
        reached = point + along[:, None] * camera.toward
        inside = np.einsum(
            "nki,nki->nk", np.cross(edge, reached[:, None] - corners), np.broadcast_to(normal[:, None], corners.shape)
        )
        is_behind[n] = (along > width) & np.all(inside >= -1e-12, axis=1)
    return is_behind


def behind_others(
    points: np.ndarray, units: np.ndarray, pieces: list[Piece], blocks: Blocks, camera: Camera
) -> np.ndarray:
    """(n,) whether points (n, 3) in joints of units (n, 2) lie behind a piece of another unit than these two."""
    unit = blocks.unit[blocks.face_block()[[piece.face for piece in pieces]]]
    others = (units[:, :, None] != unit).all(axis=1)
    return np.asarray((behind(points, pieces, camera) & others).any(axis=1))


def _joined(pieces: list[Piece]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    start = np.concatenate([[0], np.cumsum([len(piece.corners) for piece in pieces])])
    return np.concatenate([piece.corners for piece in pieces]), start, np.arange(start[-1])


def _farthest_first(pieces: list[Piece], normal: np.ndarray, camera: Camera, width: float) -> list[Piece]:
    """By planes, so that what stands in front of a plane comes after it (Newell 1972); within a plane by depth.

    Where neither of two planes comes first by this rule, and in a cycle, the depth of their middles decides.
    """
    middle = np.array([piece.corners.mean(axis=0) for piece in pieces])
    depth = np.round(middle @ camera.toward, 12)
    order = np.argsort(depth, kind="stable")
    key = np.column_stack([np.round(normal, 6), np.round(np.einsum("ni,ni->n", middle, normal) / (10 * width))])
    _, plane = np.unique(key, axis=0, return_inverse=True)
    plane = plane.ravel()
    count = int(plane.max()) + 1
    if count > MOST_PLANES:
        return [pieces[i] for i in order]
    points, start, _ = _joined(pieces)
    owner = np.repeat(plane, np.diff(start))
    above, below = np.zeros((count, count)), np.zeros((count, count))
    for q in range(count):
        first = int(np.argmax(plane == q))
        height = (points - middle[first]) @ normal[first]
        above[:, q], below[:, q] = -np.inf, np.inf
        np.maximum.at(above[:, q], owner, height)
        np.minimum.at(below[:, q], owner, height)
    before = (above <= width) | (-width <= below.T)  # p lies behind the plane of q, or q in front of that of p
    before &= ~before.T
    mean_depth = np.bincount(plane, depth) / np.bincount(plane)
    drawn: list[int] = []
    waiting = before.sum(axis=0).astype(float)
    for _ in range(count):
        ready = waiting == waiting.min()
        chosen = int(np.argmin(np.where(ready, mean_depth, np.inf)))
        drawn.append(chosen)
        waiting -= before[chosen]
        waiting[chosen] = np.inf
    rank = np.argsort(drawn)
    return [pieces[i] for i in order[np.argsort(rank[plane[order]], kind="stable")]]


class _Edges(NamedTuple):
    """The edges of some faces, one face after another: the face (E,), and the pairs (n, 2) of edges that lie at one
    place in one body, as numbers of edges."""

    face: np.ndarray
    pairs: np.ndarray


def _edges(blocks: Blocks, faces: np.ndarray, body: np.ndarray) -> _Edges:
    """The edges of some faces; body (F,) of every face."""
    size = float(np.ptp(blocks.points, axis=0).max())
    place, corner = ranges(blocks.face_start[faces], np.diff(blocks.face_start)[faces])
    count = np.diff(blocks.face_start)[faces]
    points = np.round(blocks.points[blocks.face_points[corner]] / (1e-6 * size)).astype(np.int64)
    point = np.unique(points, axis=0, return_inverse=True)[1].reshape(-1)
    after = point[following(np.append(0, np.cumsum(count)))]
    face = faces[place]
    ends = np.minimum(point, after) * len(point) + np.maximum(point, after)
    key = body[face] * len(ends) + np.unique(ends, return_inverse=True)[1].reshape(-1)
    order = np.argsort(key, kind="stable")
    last = np.flatnonzero(np.append(np.diff(key[order]) != 0, True)) + 1
    end = np.repeat(last, np.diff(last, prepend=0))
    pair_a, pair_b = ranges(np.arange(len(key)) + 1, end - np.arange(len(key)) - 1)
    return _Edges(face, np.stack([order[pair_a], order[pair_b]], axis=1))


def unit_edges(blocks: Blocks, faces: np.ndarray, normal: np.ndarray) -> np.ndarray:
    """(E,) of the edges of some faces, face by face: true unless a face of the same unit goes on beyond it in the same
    plane, or one of the same block in nearly the same, as on the facets of a curved surface."""
    block = blocks.face_block()
    body = np.unique(np.stack([blocks.unit[block], blocks.group[block]]), axis=1, return_inverse=True)[1].reshape(-1)
    edges = _edges(blocks, faces, body)
    f, o = edges.face[edges.pairs].T
    near = np.einsum("ni,ni->n", normal[f], normal[o]) > np.where(block[f] == block[o], BENT, SAME_PLANE)
    outer = np.ones(len(edges.face), dtype=bool)
    outer[edges.pairs[near & (f != o)]] = False
    return outer


def turning_edges(blocks: Blocks, faces: np.ndarray, normal: np.ndarray) -> np.ndarray:
    """(E,) of the edges of some faces, face by face: true unless a face of the same block goes on beyond it, turned by
    less than SMOOTH."""
    edges = _edges(blocks, faces, blocks.face_block())
    f, o = edges.face[edges.pairs].T
    alone = np.bincount(edges.pairs.ravel(), minlength=len(edges.face)) == 1  # of two edges, not of more
    smooth = alone[edges.pairs].all(axis=1) & (np.einsum("ni,ni->n", normal[f], normal[o]) > np.cos(SMOOTH))
    turns = np.ones(len(edges.face), dtype=bool)
    turns[edges.pairs[smooth]] = False
    return turns


def _cut(face: int, corners: np.ndarray, outer: np.ndarray, every: np.ndarray, longest: float) -> list[Piece]:
    """A four-sided face in parts with edges no longer than `longest` (m); any other face as it is."""
    if len(corners) != 4:
        return [Piece(face, corners, outer, every)]
    length = np.linalg.norm(np.roll(corners, -1, axis=0) - corners, axis=1)
    m, n = (min(int(np.ceil(length[[k, k + 2]].max() / longest)), PIECES) for k in (0, 1))
    parts = []
    for i in range(m):
        for j in range(n):
            s = np.array([i, i + 1, i + 1, i])[:, None] / m
            t = np.array([j, j, j + 1, j + 1])[:, None] / n
            part = (1 - t) * ((1 - s) * corners[0] + s * corners[1]) + t * ((1 - s) * corners[3] + s * corners[2])
            at_end = np.array([j == 0, i == m - 1, j == n - 1, i == 0])
            parts.append(Piece(face, part, outer & at_end, every & at_end))
    return parts

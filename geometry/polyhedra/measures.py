"""Volumes, centroids and second moments of blocks, exact for any polyhedron with planar faces (sums of signed tets)."""

from math import acos, degrees

import numpy as np

from geometry.blocks import Blocks
from geometry.polyhedra.indexing import following, ranges
from geometry.polyhedra.polygons import areas_normals_centroids, pad

SAME_PLACE = 1e-6
"""Of the extent: corners that are nearer are at one place."""
FACES, MOST = 64, 1_000_000
"""Faces of a block between which its least width is sought; corners of faces that are looked at in one go."""


def _tets(blocks: Blocks, origin: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Tets between origin (B, 3) of each block and its faces' triangles: block (T,), arms (T, 3, 3), volume (T,)."""
    count = np.diff(blocks.face_start) - 2
    face, second = ranges(blocks.face_start[:-1] + 1, count)
    corner = np.stack([blocks.face_start[face], second, second + 1], axis=1)
    block = blocks.face_block()[face]
    arm = blocks.points[blocks.face_points[corner]] - origin[block][:, None]
    return block, arm, np.einsum("ti,ti->t", arm[:, 0], np.cross(arm[:, 1], arm[:, 2])) / 6


def _first_corners(blocks: Blocks) -> np.ndarray:
    return blocks.points[blocks.face_points[blocks.face_start[blocks.block_face_start[:-1]]]]


def sum_by_block(blocks: Blocks, block: np.ndarray, values: np.ndarray) -> np.ndarray:
    """(B, ...) sums of values (n, ...) over those that belong to each block; block (n,)."""
    columns = values.reshape(len(values), -1).T
    total = np.stack([np.bincount(block, column, blocks.count) for column in columns], axis=1)
    return total.reshape(blocks.count, *values.shape[1:])


def volumes(blocks: Blocks) -> np.ndarray:
    """(B,) m3."""
    block, _, volume = _tets(blocks, _first_corners(blocks))
    return sum_by_block(blocks, block, volume)


def centroids(blocks: Blocks) -> np.ndarray:
    """(B, 3) m."""
    return _volumes_centroids(blocks)[1]


def _volumes_centroids(blocks: Blocks) -> tuple[np.ndarray, np.ndarray]:
    origin = _first_corners(blocks)
    block, arm, part = _tets(blocks, origin)
    moment = sum_by_block(blocks, block, part[:, None] * arm.sum(axis=1) / 4)
    volume = sum_by_block(blocks, block, part)
    return volume, origin + moment / volume[:, None]


def moments(blocks: Blocks) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Volumes, centroids, and (B, 3, 3) m5 the integral of r r^T over each block, r from its centroid."""
    volume, centroid = _volumes_centroids(blocks)
    block, arm, part = _tets(blocks, centroid)
    total = arm.sum(axis=1)
    outer = np.einsum("tci,tcj->tij", arm, arm) + np.einsum("ti,tj->tij", total, total)
    return volume, centroid, sum_by_block(blocks, block, part[:, None, None] * outer / 20)


def face_areas_normals_centroids(blocks: Blocks) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Area (F,) m2, outward unit normal (F, 3), centroid (F, 3) m of every face."""
    return areas_normals_centroids(pad(blocks.points, blocks.face_start, blocks.face_points)[0])


def bounds(blocks: Blocks) -> tuple[np.ndarray, np.ndarray]:
    """Lowest and highest coordinates of each block, both (B, 3) m."""
    start = blocks.face_start[blocks.block_face_start[:-1]]
    corners = blocks.points[blocks.face_points]
    return np.minimum.reduceat(corners, start), np.maximum.reduceat(corners, start)


def extents(blocks: Blocks, block: np.ndarray, direction: np.ndarray) -> np.ndarray:
    """(n,) m, how far some blocks (n,) reach from end to end along directions (n, 3) of length 1."""
    extent = np.empty(len(block))
    first, last = (blocks.face_start[blocks.block_face_start[block + i]] for i in (0, 1))
    ends = np.searchsorted(np.cumsum(last - first), np.arange(MOST, (last - first).sum() + MOST, MOST), side="right")
    for part in np.split(np.arange(len(block)), ends):
        if len(part):
            owner, corner = ranges(first[part], (last - first)[part])
            along = np.einsum("ci,ci->c", blocks.points[blocks.face_points[corner]], direction[part][owner])
            start = np.cumsum((last - first)[part]) - (last - first)[part]
            extent[part] = np.maximum.reduceat(along, start) - np.minimum.reduceat(along, start)
    return extent


def widths(blocks: Blocks) -> np.ndarray:
    """(B,) m, the least width of each block: between its own faces, the largest FACES of them where it has more."""
    area, normal, _ = face_areas_normals_centroids(blocks)
    owner = blocks.face_block()
    order = np.lexsort((-area, owner))
    large = order[np.arange(len(order)) - blocks.block_face_start[owner] < FACES]
    start = np.searchsorted(owner[large], np.arange(blocks.count))
    return np.asarray(np.minimum.reduceat(extents(blocks, owner[large], normal[large]), start))


def extent(blocks: Blocks) -> float:
    """Longest side of the box round all blocks, m: what relative tolerances refer to."""
    corners = blocks.points[blocks.face_points]
    return float(np.max(np.ptp(corners, axis=0))) if len(corners) else 1.0


def edges_by_place(blocks: Blocks) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Of each edge of a face, numbered by its first corner in face_points: the face (E,), the corner at its other end
    (E,), and both ends (E, 2) as numbers of places, the lower first: corners that nearly coincide are one place."""
    face = np.repeat(np.arange(len(blocks.face_start) - 1), np.diff(blocks.face_start))
    other = following(blocks.face_start)
    place = np.round(blocks.points[blocks.face_points] / (SAME_PLACE * extent(blocks))).astype(np.int64)
    corner = np.unique(place, axis=0, return_inverse=True)[1].ravel()
    return face, other, np.sort(np.column_stack([corner, corner[other]]), axis=1)


def sharpest_edge(blocks: Blocks, which: np.ndarray) -> tuple[int, float]:
    """The block, of those in which (B,), with the sharpest edge that sticks out, and the angle there in degrees."""
    _, normal, centre = face_areas_normals_centroids(blocks)
    owner = blocks.face_block()
    face, _, ends = edges_by_place(blocks)
    keys = np.column_stack([owner[face], ends])
    order = np.lexsort(keys.T)
    same = np.flatnonzero(np.all(keys[order[1:]] == keys[order[:-1]], axis=1))
    one, two = face[order[same]], face[order[same + 1]]
    out = np.einsum("ni,ni->n", normal[one], centre[two] - centre[one]) < 0.0
    one, two = one[out & which[owner[one]]], two[out & which[owner[one]]]
    if not len(one):
        return 0, 180.0
    cosine = np.einsum("ni,ni->n", normal[one], normal[two])
    sharpest = int(np.argmin(cosine))
    return int(owner[one[sharpest]]), 180.0 - degrees(acos(float(np.clip(cosine[sharpest], -1.0, 1.0))))

"""Blocks from polygons of the (x, z) plane, each drawn out along y."""

from collections.abc import Sequence

import numpy as np

from geometry.blocks import Blocks
from geometry.polyhedra.indexing import ranges


def extrude(
    loops: Sequence[np.ndarray], low: np.ndarray, high: np.ndarray, unit: np.ndarray, groups: Sequence[str]
) -> Blocks:
    """One block for each loop (k, 2) m, convex, x to z counter-clockwise, between y = low and high (B,); group 0.

    Faces in the order y-, y+, then one over each edge.
    """
    count = np.array([len(loop) for loop in loops])
    flat = np.concatenate(loops)
    owner, k = ranges(np.zeros(len(loops), dtype=np.int64), count)
    corners = len(flat)
    points = np.concatenate([np.insert(flat, 1, y[owner], axis=1) for y in (low, high)])
    start = np.cumsum(count) - count
    here, after = np.arange(corners), start[owner] + (k + 1) % count[owner]
    backwards = start[owner] + count[owner] - 1 - k + corners
    sides = np.stack([after, here, here + corners, after + corners], axis=1)
    size = np.ones(int(count.sum()) + 2 * len(loops), dtype=np.int64) * 4
    first = start + 2 * np.arange(len(loops))  # number of each block's face y-
    size[first], size[first + 1] = count, count
    face_start = np.concatenate([[0], np.cumsum(size)])
    face_points = np.empty(face_start[-1], dtype=np.int64)
    face_points[face_start[first][owner] + k] = here
    face_points[face_start[first + 1][owner] + k] = backwards
    face_points[face_start[first[owner] + 2 + k][:, None] + np.arange(4)] = sides
    return Blocks(
        points=points,
        face_start=face_start,
        face_points=face_points,
        block_face_start=np.concatenate([[0], np.cumsum(count + 2)]),
        unit=np.asarray(unit, dtype=np.int64),
        group=np.zeros(len(loops), dtype=np.int64),
        groups=tuple(groups),
    )

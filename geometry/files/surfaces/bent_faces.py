"""Polygons whose corners lie in no plane: cut into the triangles that have the least area together.

Neighbours that share such a polygon, with the same corners, cut it along the same diagonals. For a polygon that is bent
along a line this is the line. Of the triangulations of n corners the best is found in n^3 steps (Klincsek 1980).
"""

import numpy as np

from geometry.blocks import GeometryError
from geometry.polyhedra.convexity import triangles
from geometry.polyhedra.polygons import areas_normals_centroids

MOST = 40
"""Corners of a polygon that is not flat."""
ALIKE = 1e-12
"""Two areas that differ by less, over the larger one, are the same; then the first corner by its place decides."""


def height_of(corners: np.ndarray) -> float:
    """How far (m) a corner of a polygon (n, 3) stands off its mean plane."""
    _, normal, centroid = areas_normals_centroids(corners[None])
    middle = centroid[0] if normal[0].any() else corners.mean(axis=0)
    return float(np.abs((corners - middle) @ normal[0]).max()) if normal[0].any() else np.inf


def bent_triangles(corners: np.ndarray, face: str) -> np.ndarray:
    """(n - 2, 3) corner numbers of the triangles of least area that span a polygon (n, 3), in its sense of rotation.

    Raises GeometryError, with the words `face`, where the polygon crosses itself as seen along its normal.
    """
    count = len(corners)
    if not np.isfinite(height_of(corners)):
        raise GeometryError(f"{face}: its edges cross, or its corners lie on a line")
    if count > MOST:
        raise GeometryError(f"{face} has {count} corners in no plane; at most {MOST}: give it in triangles")
    try:
        triangles(corners)  # refuses what crosses itself
    except GeometryError as error:
        raise GeometryError(f"{face}: {error}") from None
    order = np.lexsort(corners.T[::-1])
    rank = np.empty(count, dtype=np.int64)
    rank[order] = np.arange(count)
    start = int(order[0])
    ring = np.roll(np.arange(count), -start)
    if rank[ring[1]] > rank[ring[-1]]:  # a neighbour, who sees the polygon the other way round, goes the same way
        ring = np.roll(ring[::-1], 1)
        return ring[_least(corners[ring])][:, ::-1]
    return ring[_least(corners[ring])]


def _least(corners: np.ndarray) -> np.ndarray:
    count = len(corners)
    i, j, k = np.meshgrid(*[np.arange(count)] * 3, indexing="ij")
    area = np.linalg.norm(np.cross(corners[j] - corners[i], corners[k] - corners[i]), axis=-1)
    minimum_area = np.zeros((count, count))
    apex = np.zeros((count, count), dtype=np.int64)
    for width in range(2, count):
        for first in range(count - width):
            last = first + width
            whole = [
                minimum_area[first, m] + minimum_area[m, last] + area[first, m, last] for m in range(first + 1, last)
            ]
            best = min(whole)
            at = next(n for n, value in enumerate(whole) if value <= best * (1 + ALIKE))
            minimum_area[first, last], apex[first, last] = whole[at], first + 1 + at
    triangles, waiting = [], [(0, count - 1)]
    while waiting:
        first, last = waiting.pop()
        if last - first >= 2:
            m = int(apex[first, last])
            triangles.append([first, m, last])
            waiting += [(first, m), (m, last)]
    return np.array(triangles)

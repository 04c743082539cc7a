"""Flat faces that are not convex, cut into triangles by their ears (Meisters 1975)."""

import numpy as np

from geometry.blocks import GeometryError
from geometry.polyhedra.polygons import areas_normals_centroids

STRAIGHT = 1e-12
"""Sine of the turn below which a corner counts as straight."""


def reflex(corners: np.ndarray, count: np.ndarray) -> np.ndarray:
    """(N,) whether a padded polygon (N, K, 3) turns the wrong way at a corner, or goes round more than once."""
    normal = areas_normals_centroids(corners)[1]
    column = np.arange(corners.shape[1])
    after = np.roll(corners, -1, axis=1) - corners
    last = np.take_along_axis(corners, np.maximum(count - 1, 0)[:, None, None], axis=1)
    before = corners - np.where((column == 0)[:, None], last, np.roll(corners, 1, axis=1))
    turn = np.einsum("nki,ni->nk", np.cross(before, after), normal)
    size = np.linalg.norm(before, axis=2) * np.linalg.norm(after, axis=2)
    used = column < count[:, None]
    angle = np.arctan2(turn, np.einsum("nki,nki->nk", before, after))
    return np.any((turn < -STRAIGHT * size) & used, axis=1) | (np.sum(angle, axis=1, where=used) > 3 * np.pi)


def triangles(corners: np.ndarray) -> np.ndarray:
    """(n - 2, 3) corner numbers of triangles that fill a flat polygon (n, 3), in its sense of rotation.

    Raises GeometryError if its edges cross.
    """
    normal = areas_normals_centroids(corners[None])[1][0]
    helper = np.eye(3)[np.argmin(np.abs(normal))]
    across = np.cross(normal, helper)
    flat = (corners - corners[0]) @ np.stack([across, np.cross(normal, across)], axis=1)
    if _crosses(flat):
        raise GeometryError("a face whose edges cross cannot be cut into triangles")
    left, found = list(range(len(corners))), []
    while len(left) > 3:
        ears = [k for k in range(len(left)) if _is_ear(flat, left, k)]
        if not ears:
            raise GeometryError("a face has corners on its own edges and cannot be cut into triangles")
        best = max(ears, key=lambda k: _narrowest(flat, left, k))
        found.append([left[best - 1], left[best], left[(best + 1) % len(left)]])
        del left[best]
    return np.array([*found, left])


def _crosses(flat: np.ndarray) -> bool:
    """Whether two edges of a closed polygon (n, 2) cross."""
    start, end = flat, np.roll(flat, -1, axis=0)
    side = _cross((end - start)[:, None], flat[None] - start[:, None])  # [i, j]: corner j beside edge i
    apart = side * np.roll(side, -1, axis=1) < 0
    return bool(np.any(apart & apart.T))


def _is_ear(flat: np.ndarray, left: list[int], k: int) -> bool:
    a, b, c = flat[left[k - 1]], flat[left[k]], flat[left[(k + 1) % len(left)]]
    if _cross(b - a, c - b) <= STRAIGHT * np.linalg.norm(b - a) * np.linalg.norm(c - b):
        return False
    others = flat[[v for i, v in enumerate(left) if i not in (k, (k - 1) % len(left), (k + 1) % len(left))]]
    inside = (_cross(b - a, others - a) >= 0) & (_cross(c - b, others - b) >= 0) & (_cross(a - c, others - c) >= 0)
    return not inside.any()


def _narrowest(flat: np.ndarray, left: list[int], k: int) -> float:
    """Height over longest side of the triangle at k, squared units cancelled: larger is rounder."""
    a, b, c = flat[left[k - 1]], flat[left[k]], flat[left[(k + 1) % len(left)]]
    longest = max(float(np.sum((p - q) ** 2)) for p, q in ((a, b), (b, c), (c, a)))
    return float(_cross(b - a, c - a)) / longest


def _cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]

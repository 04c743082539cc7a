"""Many convex planar polygons in space at once: areas, clipping, tidying.

Polygons are padded arrays: corners (N, K, 3) and count (N,), where the slots beyond count repeat the first corner, so
that closing edges come by themselves and padded edges have no length.
"""

import numpy as np


def pad(points: np.ndarray, start: np.ndarray, index: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Corners (N, K, 3) and count (N,) of the polygons index[start[i]:start[i + 1]] into points."""
    count = np.diff(start)
    column = np.arange(count.max(initial=1))
    take = start[:-1, None] + np.where(column < count[:, None], column, 0)
    return points[index[take]], count


def unpad(corners: np.ndarray, count: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Start (N + 1,) and corners (., 3) of the same polygons without the padding."""
    used = np.arange(corners.shape[1]) < count[:, None]
    return np.concatenate([[0], np.cumsum(count)]), corners[used]


def areas_normals_centroids(corners: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Area (N,), unit normal (N, 3) by the right-hand rule (zero where there is no area), centroid (N, 3)."""
    arm = corners - corners[:, :1]
    following = np.roll(arm, -1, axis=1)
    triangle = np.cross(arm, following) / 2
    vector = triangle.sum(axis=1)
    area = np.linalg.norm(vector, axis=1)
    safe = np.where(area > 0, area, 1.0)[:, None]
    normal = vector / safe
    fraction = np.einsum("nki,ni->nk", triangle, normal) / safe
    centroid = corners[:, 0] + np.einsum("nk,nki->ni", fraction, arm + following) / 3
    return area, normal, centroid


def compact(corners: np.ndarray, keep: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The corners marked in keep (N, K), moved to the front and padded again."""
    count = keep.sum(axis=1)
    column = np.arange(max(int(count.max(initial=0)), 1))
    used = column < count[:, None]
    moved = np.flatnonzero((keep[:, : len(column)] != used).any(axis=1))  # of the others the first ones stay
    order = np.argsort(~keep[moved], axis=1, kind="stable")[:, : len(column)]
    order = np.where(used[moved], order, order[:, :1])
    placed = np.take_along_axis(corners[moved], order[:, :, None], axis=1)
    corners = corners[:, : len(column)]
    if not used.all():
        corners = np.where(used[:, :, None], corners, corners[:, :1])
    elif len(moved):
        corners = corners.copy()
    corners[moved] = placed
    return corners, count


def clip(
    corners: np.ndarray, count: np.ndarray, window: np.ndarray, window_normal: np.ndarray, tolerance: float
) -> tuple[np.ndarray, np.ndarray]:
    """Part of each polygon within its coplanar window (N, M, 3), by Sutherland and Hodgman (1974).

    The window runs counter-clockwise about window_normal (N, 3). Corners within tolerance of its edges count as inside
    and stay as they are. A polygon that does not even touch its window keeps 0 corners.
    """
    count = count.copy()
    for j in range(window.shape[1]):
        edge = window[:, (j + 1) % window.shape[1]] - window[:, j]
        length = np.linalg.norm(edge, axis=1)
        inward = np.cross(window_normal, edge) / np.where(length > 0, length, 1.0)[:, None]
        distance = np.einsum("nki,ni->nk", corners - window[:, j, None], inward)
        distance[np.abs(distance) <= tolerance] = 0.0
        crossed = np.flatnonzero((distance < 0).any(axis=1))
        if len(crossed):
            part, count[crossed] = cut(corners[crossed], count[crossed], distance[crossed])
            width = max(corners.shape[1], part.shape[1])
            corners = widen(corners, width)
            corners[crossed] = widen(part, width)
    return corners[:, : max(int(count.max(initial=0)), 1)], count


def cut(corners: np.ndarray, count: np.ndarray, distance: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Part of each polygon where the distance (N, K) is not negative."""
    following = np.roll(distance, -1, axis=1)
    used = np.arange(corners.shape[1]) < count[:, None]
    crosses = used & (distance * following < 0)
    fraction = np.divide(distance, distance - following, out=np.zeros_like(distance), where=crosses)
    crossing = corners + fraction[:, :, None] * (np.roll(corners, -1, axis=1) - corners)
    slots = 2 * corners.shape[1]
    both = np.stack([corners, crossing], axis=2).reshape(len(corners), slots, 3)
    keep = np.stack([used & (distance >= 0), crosses], axis=2).reshape(len(corners), slots)
    return compact(both, keep)


def widen(corners: np.ndarray, width: int) -> np.ndarray:
    """A copy of the polygons (N, K, 3) with room for `width` corners."""
    more = np.repeat(corners[:, :1], max(width - corners.shape[1], 0), axis=1)
    return np.concatenate([corners, more], axis=1)


def tidy(corners: np.ndarray, count: np.ndarray, tolerance: float) -> tuple[np.ndarray, np.ndarray]:
    """The same polygons without doubled corners and corners on the line between their neighbours; lines vanish."""
    column = np.arange(corners.shape[1])
    step = np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2)
    corners, count = compact(corners, (column < count[:, None]) & ((step > tolerance) | (count[:, None] == 1)))
    column = np.arange(corners.shape[1])
    before = np.where(column == 0, np.maximum(count[:, None] - 1, 0), column - 1)
    behind = np.take_along_axis(corners, before[:, :, None], axis=1)
    chord = np.roll(corners, -1, axis=1) - behind
    length = np.linalg.norm(chord, axis=2)
    height = np.linalg.norm(np.cross(chord, corners - behind), axis=2) / np.where(length > 0, length, 1.0)
    return compact(corners, (column < count[:, None]) & (height > tolerance))

"""Each joint polygon shared out among its contact points: what lies nearer to one than to any other of the polygon."""

import numpy as np

from geometry.blocks import Joints
from geometry.jit_cache import compiled
from geometry.polyhedra.polygons import pad, unpad, widen

NEIGHBOURS = 8
"""So many of the nearest points are looked at first; twice as many where these leave a doubt, and so on."""
FEW = 400
"""Points up to which all distances are quicker found than the library of trees is loaded."""


def tiles(joints: Joints) -> tuple[np.ndarray, np.ndarray]:
    """Start (C + 1,) and corners (., 3) m of a convex polygon for each contact point, round about its normal.

    The tiles of a joint polygon cover it once (Voronoi 1908). Points that coincide have the same tile.
    """
    polygon, sides = pad(joints.patch_points, joints.patch_start, np.arange(len(joints.patch_points)))
    corners, count = polygon[joints.patch], sides[joints.patch]
    most = int(np.bincount(joints.patch).max(initial=1))
    open_, seen = np.arange(len(joints.point)), 1
    while len(open_) and seen < most:
        near_by = min(most, max(seen * 2, NEIGHBOURS))
        distance, near = _nearest(joints, open_, near_by)
        corners = widen(corners, int(count.max()) + near_by - seen)  # a cut adds one at most
        reach = _cut_at_neighbours(corners, count, joints.point, open_, near[:, seen:], distance[:, seen:])
        corners = corners[:, : int(count.max())]
        open_, seen = open_[distance[:, -1] < reach], near_by
    start, points = unpad(corners, count)
    return start, points


@compiled
def _cut_at_neighbours(corners, count, point, which, near, distance):
    """Cut the polygons of some points (n,), corners (C, K, 3) with count (C,), halfway to their neighbours (n, m), the
    nearest first, as far as these are near enough to matter; returns twice how far each then reaches (n,) m. As `cut`
    does, polygon by polygon: many are cut, and few corners are left of each."""
    beyond, before = np.empty(corners.shape[1]), np.empty((corners.shape[1], 3))
    reach = np.empty(len(which))
    for n in range(len(which)):
        own = which[n]
        reach[n] = _twice_farthest(corners[own], count[own], point[own])
        for m in range(near.shape[1]):
            if not 0.0 < distance[n, m] < reach[n]:
                continue
            sides, other = count[own], near[n, m]
            for k in range(sides):
                beyond[k] = 0.0
                for i in (0, 2, 1):
                    middle = 0.5 * (point[own, i] + point[other, i])
                    beyond[k] += (middle - corners[own, k, i]) * (point[other, i] - point[own, i])
                before[k] = corners[own, k]
            left = 0
            for k in range(sides):
                after = (k + 1) % sides
                if beyond[k] >= 0.0:
                    corners[own, left] = before[k]
                    left += 1
                if beyond[k] * beyond[after] < 0.0:
                    fraction = beyond[k] / (beyond[k] - beyond[after])
                    for i in range(3):
                        corners[own, left, i] = before[k, i] + fraction * (before[after, i] - before[k, i])
                    left += 1
            count[own] = left
            reach[n] = _twice_farthest(corners[own], left, point[own])
    return reach


@compiled
def _twice_farthest(corners, count, point):
    """Twice the distance (m) of the farthest of the first corners (K, 3) from a point (3,)."""
    largest = 0.0
    for k in range(count):
        x, y, z = corners[k, 0] - point[0], corners[k, 1] - point[1], corners[k, 2] - point[2]
        largest = max(largest, (x * x + y * y) + z * z)
    return 2.0 * np.sqrt(largest)


def _nearest(joints: Joints, which: np.ndarray, number: int) -> tuple[np.ndarray, np.ndarray]:
    """Distance and index (n, number) of the points nearest to some, the nearest first; others' polygons are far."""
    apart = 10.0 * float(np.ptp(joints.point, axis=0).max())  # a fourth axis on which other polygons are out of reach
    place = np.column_stack([joints.point, apart * joints.patch])
    if len(place) <= FEW:
        between = np.linalg.norm(place[which][:, None] - place, axis=2)
        near = np.argsort(between, axis=1, kind="stable")[:, :number]
        return np.take_along_axis(between, near, axis=1), near
    from scipy.spatial import cKDTree

    distance, near = cKDTree(place).query(place[which], k=number)
    return distance.reshape(len(which), -1), near.reshape(len(which), -1)

"""Polygons of contact points cut halfway to their neighbours, in one compiled loop."""

import numpy as np

from geometry.jit_cache import compiled


@compiled
def cut_at_neighbours(corners, count, point, which, near, distance):
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

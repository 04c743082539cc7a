"""Corners that lie in the planes of all their faces: planes are fitted to corners and corners moved to planes in turn.

A corner goes to the nearest place where its planes meet, in the sense of least squares. Where no corner has more than
three planes, as in most blocks, one round is exact; else the rounds come ever nearer to corners and planes that agree,
if there are some near by.
"""

import numpy as np

ROUNDS = 200
PATIENCE = 20
"""Rounds in which the largest distance must halve, or corners and planes do not come to agree. In a dome, where each
corner has four planes, it takes eight."""
SETTLED = 1e-3
"""Of the width: corners that are so near to all their planes stay where they are, bit for bit."""
LEAST = 1e-6
"""Of the largest eigenvalue: directions in which the planes of a corner hardly differ, along which it does not move."""


def meet(
    points: np.ndarray, corner: np.ndarray, plane: np.ndarray, width: float, alike: float
) -> tuple[np.ndarray, np.ndarray]:
    """Points (P, 3) that lie in their planes, as nearly as can be, and how far (m) each plane (K,) is missed.

    corner, plane (N,): point corner[n] is to lie in plane plane[n], numbered from 0. width (m): near enough. Where all
    miss their planes by no more than `alike` (m) they stay where they are, bit for bit.
    """
    if len(plane) == 0:
        return points, np.zeros(0)
    order = np.argsort(plane, kind="stable")
    corner, plane = corner[order], plane[order]
    start = np.flatnonzero(np.diff(plane, prepend=-1))
    count = np.diff(np.append(start, len(plane)))
    by_corner = np.argsort(corner, kind="stable")
    first = np.flatnonzero(np.diff(corner[by_corner], prepend=-1))
    moved = corner[by_corner][first]
    points, off, before = points.copy(), np.zeros(0), np.inf
    for n in range(ROUNDS):
        normal, height = _fitted(points[corner], start, count)
        off = np.maximum.reduceat(np.abs(height), start)
        if off.max() <= (width if n else alike):
            break
        if n % PATIENCE == 0:
            if off.max() > 0.5 * before:
                break
            before = off.max()
        axis = np.repeat(normal, count, axis=0)[by_corner]
        lacking = height[by_corner]
        matrix = np.add.reduceat(axis[:, :, None] * axis[:, None], first)
        vector = np.add.reduceat(axis * lacking[:, None], first)
        step = _solved(matrix, vector)
        step[np.maximum.reduceat(np.abs(lacking), first) <= SETTLED * width] = 0.0
        points[moved] -= step
    return points, off


def _fitted(place: np.ndarray, start: np.ndarray, count: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Unit normals (K, 3) of the planes nearest to groups of points (N, 3), and the heights (N,) of these over them."""
    middle = np.add.reduceat(place, start) / count[:, None]
    arm = place - np.repeat(middle, count, axis=0)
    normal = np.linalg.eigh(np.add.reduceat(arm[:, :, None] * arm[:, None], start))[1][:, :, 0]
    return normal, np.einsum("ni,ni->n", arm, np.repeat(normal, count, axis=0))


def _solved(matrix: np.ndarray, vector: np.ndarray) -> np.ndarray:
    """(n, 3) the shortest steps that solve symmetric systems (n, 3, 3) but for directions that hardly count."""
    value, axes = np.linalg.eigh(matrix)
    along = np.einsum("nij,ni->nj", axes, vector)
    good = value > LEAST * value[:, -1:]
    return np.einsum("nij,nj->ni", axes, np.where(good, along / np.where(good, value, 1.0), 0.0))

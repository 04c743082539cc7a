"""Corners that lie in the planes of all their faces: planes are fitted to corners and corners moved to planes in turn.

A corner goes to the nearest place where its planes meet, in the sense of least squares. Where no corner has more than
three planes, as in most blocks, one round is exact; else the rounds come ever nearer to corners and planes that agree,
if there are some near by.
"""

from typing import NamedTuple

import numpy as np

ROUNDS = 200
PATIENCE = 20
"""Rounds in which the largest distance must halve, or corners and planes do not come to agree. In a dome, where each
corner has four planes, it takes eight."""
SETTLED = 1e-3
"""Of the width: corners that are so near to all their planes stay where they are, bit for bit."""
LEAST = 1e-6
"""Of the largest eigenvalue: directions in which the planes of a corner hardly differ, along which it does not move."""


class _Incidence(NamedTuple):
    """Corners (N,) in planes (N,), in the order of planes: where each plane begins, how many corners it has, which one
    it is; and the same in the order of corners: the order, where each corner begins, which one it is."""

    corner: np.ndarray
    plane: np.ndarray
    start: np.ndarray
    corners_of: np.ndarray
    planes: np.ndarray
    by_corner: np.ndarray
    first: np.ndarray
    corners: np.ndarray


def meet(
    points: np.ndarray,
    corner: np.ndarray,
    plane: np.ndarray,
    width: np.ndarray | float,
    alike: np.ndarray | float,
    body: np.ndarray | None = None,
) -> tuple[np.ndarray, np.ndarray]:
    """Points (P, 3) that lie in their planes, as nearly as can be, and how far (m) each plane (K,) is missed.

    corner, plane (N,): point corner[n] is to lie in plane plane[n], numbered from 0. width (m, of each plane or of
    all): near enough. Where all planes of a body are missed by no more than `alike` (m) its points stay where they are,
    bit for bit. body (K,) of each plane, which shares no point with those of other bodies; None: all are of one.
    """
    if len(plane) == 0:
        return points, np.zeros(0)
    planes = int(plane.max()) + 1
    body = np.zeros(planes, dtype=np.int64) if body is None else body
    width, alike = np.broadcast_to(width, planes), np.broadcast_to(alike, planes)
    points, error, before = points.copy(), np.zeros(planes), np.full(int(body.max()) + 1, np.inf)
    of = _incidence(corner, plane)
    for n in range(ROUNDS):
        normal, height = _fitted(points[of.corner], of.start, of.corners_of)
        error[of.planes] = np.maximum.reduceat(np.abs(height), of.start)
        ended = np.ones(len(before), dtype=bool)
        ended[body[error > (width if n else alike)]] = False
        if n % PATIENCE == 0:
            worst = np.zeros(len(before))
            np.maximum.at(worst, body, error)
            ended |= worst > 0.5 * before
            before = worst
        if (going := ~ended[body[of.plane]]).any() and not going.all():
            of = _incidence(of.corner[going], of.plane[going])
            normal, height = _fitted(points[of.corner], of.start, of.corners_of)
        elif not going.any():
            break
        axis = np.repeat(normal, of.corners_of, axis=0)[of.by_corner]
        lacking = height[of.by_corner]
        matrix = np.add.reduceat(axis[:, :, None] * axis[:, None], of.first)
        vector = np.add.reduceat(axis * lacking[:, None], of.first)
        step = _solved(matrix, vector)
        settled = np.abs(lacking) <= SETTLED * width[of.plane[of.by_corner]]
        step[np.logical_and.reduceat(settled, of.first)] = 0.0
        points[of.corners] -= step
    return points, error


def _incidence(corner: np.ndarray, plane: np.ndarray) -> _Incidence:
    order = np.argsort(plane, kind="stable")
    corner, plane = corner[order], plane[order]
    start = np.flatnonzero(np.diff(plane, prepend=-1))
    by_corner = np.argsort(corner, kind="stable")
    first = np.flatnonzero(np.diff(corner[by_corner], prepend=-1))
    count = np.diff(np.append(start, len(plane)))
    return _Incidence(corner, plane, start, count, plane[start], by_corner, first, corner[by_corner][first])


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

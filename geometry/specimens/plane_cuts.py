"""Convex bodies cut by planes across an axis: regular divisions of blocks that are no boxes."""

from collections.abc import Sequence

import numpy as np

from geometry.polyhedra.weld import weld

Body = list[np.ndarray]
"""The faces (n, 3) of a convex body, counter-clockwise seen from outside."""
NEAR = 1e-10
"""Of the longest side of a body: corners that are nearer to a plane lie in it."""


def in_grid(body: Body, divisions: Sequence[int]) -> list[Body]:
    """A body cut into (nx, ny, nz) parts of equal width along x, y, z; the parts fill it and meet in whole faces."""
    parts = [body]
    for axis, count in enumerate(divisions):
        corners = np.concatenate(body)[:, axis]
        levels = np.linspace(corners.min(), corners.max(), count + 1)[1:-1]
        width = NEAR * float(np.ptp(np.concatenate(body), axis=0).max())
        parts = [piece for part in parts for piece in _slices(part, axis, levels, width)]
    return parts


def _slices(body: Body, axis: int, levels: np.ndarray, width: float) -> list[Body]:
    slices = []
    for level in levels.tolist():
        below, body = _halves(body, axis, level, width)
        slices.append(below)
    return [part for part in (*slices, body) if len(part) >= 4]


def _halves(body: Body, axis: int, level: float, width: float) -> tuple[Body, Body]:
    """Parts below and above a level (m) of an axis; empty where there is nothing."""
    below: Body = []
    above: Body = []
    rim = []
    for face in body:
        side = face[:, axis] - level
        side[np.abs(side) <= width] = 0.0
        low, high, cut = _split(face, side, axis, level)
        below += [low] if np.any(side < 0) else []
        above += [high] if np.any(side > 0) else []
        rim.append(cut)
    if not below or not above:
        return (body, []) if below else ([], body)
    cap = _round(np.concatenate(rim), axis, width)
    return [*below, cap], [*above, cap[::-1]]


def _split(face: np.ndarray, side: np.ndarray, axis: int, level: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Corners of a face below and above a level, and those in it; side (n,) m is the height of each corner."""
    low, high, cut = [], [], []
    for i, j in enumerate([*range(1, len(face)), 0]):
        if side[i] <= 0:
            low.append(face[i])
        if side[i] >= 0:
            high.append(face[i])
        if side[i] == 0:
            cut.append(face[i])
        if side[i] * side[j] < 0:
            a, b = (i, j) if side[i] < 0 else (j, i)  # the same bits, whichever way round the edge is gone along
            point = face[a] + (face[b] - face[a]) * (side[a] / (side[a] - side[b]))
            point[axis] = level
            for corners in (low, high, cut):
                corners.append(point)
    return np.array(low), np.array(high), np.array(cut).reshape(-1, 3)


def _round(rim: np.ndarray, axis: int, width: float) -> np.ndarray:
    """Corners of the convex polygon in the cut, counter-clockwise seen from above."""
    corners = rim[weld(rim, width)[0]]
    across = [(axis + 1) % 3, (axis + 2) % 3]
    arm = corners[:, across] - corners[:, across].mean(axis=0)
    return corners[np.argsort(np.arctan2(arm[:, 1], arm[:, 0]))]

"""Corners that lie on an edge of a neighbour without being corners of it: they are put into the neighbour's edge."""

from collections import Counter

import numpy as np

Loops = list[np.ndarray]


def with_corners_on_edges(points: np.ndarray, loops: Loops, width: float) -> tuple[Loops, int]:
    """The faces, whose free edges have each corner of another free edge that lies on them within a width, and how many
    corners were put in.

    Only edges that belong to one face are looked at, so what is closed stays as it is.
    """
    edges = Counter(
        (min(edge), max(edge)) for loop in loops for edge in zip(loop.tolist(), np.roll(loop, -1).tolist(), strict=True)
    )
    free = {edge for edge, times in edges.items() if times == 1}
    ends = np.array(sorted({v for edge in free for v in edge}), dtype=np.int64)
    rings, count = [], 0
    for loop in loops:
        ring: list[int] = []
        for i, j in zip(loop.tolist(), np.roll(loop, -1).tolist(), strict=True):
            ring.append(i)
            if (min(i, j), max(i, j)) in free:
                between = _between(points, ends, i, j, width)
                ring += between
                count += len(between)
        rings.append(np.array(ring, dtype=np.int64))
    return rings, count


def _between(points: np.ndarray, among: np.ndarray, i: int, j: int, width: float) -> list[int]:
    """Those of some corners that lie on the edge from i to j, in order."""
    edge = points[j] - points[i]
    length = float(np.linalg.norm(edge))
    arm = points[among] - points[i]
    along = arm @ edge / length
    distance = np.linalg.norm(arm - along[:, None] * edge / length, axis=1)
    on = np.flatnonzero((distance <= width) & (along > width) & (along < length - width))
    return [int(v) for v in among[on[np.argsort(along[on])]]]

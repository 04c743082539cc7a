"""Triangles of flat faces merged into convex polygons, after Hertel and Mehlhorn (1983)."""

import math
from collections.abc import Sequence

import numpy as np

Polygon = list[int]
Edge = tuple[int, int]
STRAIGHT = 1e-10  # rad, a corner that turns right by less goes straight on


def convex_pieces(points: np.ndarray, triangles: np.ndarray, width: float) -> list[Polygon]:
    """Convex polygons of corner numbers in place of triangles (T, 3) into points (P, 3), the same way round.

    Neighbouring triangles are merged where they lie in one plane within width (m), so triangles of a curved face stay
    by themselves. At most four times the least number of pieces. Corners along a straight edge are kept.
    """
    pieces = []
    for part in _flat_parts(points, triangles, width):
        normal = np.cross(*(points[part[:, k]] - points[part[:, 0]] for k in (1, 2))).sum(axis=0)
        pieces += _merged(points, part.tolist(), normal / np.linalg.norm(normal))
    return pieces


def _flat_parts(points: np.ndarray, triangles: np.ndarray, width: float) -> list[np.ndarray]:
    """Triangles that hang together in one plane, grown from the largest triangle that is left."""
    corner = points[triangles]
    vector = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
    size = np.linalg.norm(vector, axis=1)
    sharing: dict[Edge, list[int]] = {}
    for t, loop in enumerate(triangles.tolist()):
        for edge in _undirected(loop):
            sharing.setdefault(edge, []).append(t)
    parts, free = [], np.ones(len(triangles), dtype=bool)
    for seed in np.argsort(-size, kind="stable").tolist():
        if not free[seed]:
            continue
        normal = vector[seed] / size[seed] if size[seed] > 0 else np.zeros(3)
        part, waiting = [], [seed]
        free[seed] = False
        while waiting:
            t = waiting.pop()
            part.append(t)
            for edge in _undirected(triangles[t].tolist()):
                for other in sharing[edge]:
                    if free[other] and _is_in_plane(corner[other] - corner[seed, 0], vector[other], normal, width):
                        free[other] = False
                        waiting.append(other)
        parts.append(triangles[sorted(part)])
    return parts


def _is_in_plane(arm: np.ndarray, vector: np.ndarray, normal: np.ndarray, width: float) -> bool:
    """Whether a triangle lies in the plane and looks the way of its normal; one without area looks any way."""
    return bool(np.abs(arm @ normal).max() <= width and (vector @ normal > 0 or vector @ vector <= width**4))


def _merged(points: np.ndarray, loops: list[Polygon], normal: np.ndarray) -> list[Polygon]:
    """The polygons of one plane with every inner edge taken away that convexity does not need; longest edges first."""
    piece = dict(enumerate(loops))
    place = _in_plane(points, loops, normal)
    side = {edge: n for n, loop in piece.items() for edge in _directed(loop)}
    inner = [edge for edge in side if edge[0] < edge[1] and edge[::-1] in side]
    length = {edge: math.dist(place[edge[0]], place[edge[1]]) for edge in inner}
    for edge in sorted(inner, key=lambda e: (-length[e], e)):
        a, b = side[edge], side[edge[::-1]]
        if a == b:
            continue
        union = _spliced(piece[a], piece[b], edge)
        if len(set(union)) == len(union) and _is_convex([place[v] for v in union]):
            piece[a] = union
            for moved in _directed(piece.pop(b)):
                side[moved] = a
    return list(piece.values())


def _spliced(one: Polygon, two: Polygon, edge: Edge) -> Polygon:
    """Both polygons as one, without the edge that one has as (a, b) and two as (b, a)."""
    i, j = one.index(edge[1]), two.index(edge[0])
    ring, other = one[i:] + one[:i], two[j:] + two[:j]
    return ring + other[1:-1]


def _in_plane(points: np.ndarray, loops: list[Polygon], normal: np.ndarray) -> dict[int, tuple[float, float]]:
    """Coordinates in right-handed axes across the normal, of every corner."""
    used = sorted({v for loop in loops for v in loop})
    across = np.cross(normal, np.eye(3)[np.argmin(np.abs(normal))])
    across /= np.linalg.norm(across)
    flat = points[used] @ np.stack([across, np.cross(normal, across)], axis=1)
    return dict(zip(used, map(tuple, flat.tolist()), strict=True))


def _is_convex(corner: list[tuple[float, float]]) -> bool:
    """Whether a polygon turns left or goes straight on at every corner."""
    before, here = corner[-2], corner[-1]
    for after in corner:
        ax, ay, bx, by = here[0] - before[0], here[1] - before[1], after[0] - here[0], after[1] - here[1]
        if ax * by - ay * bx < -STRAIGHT * math.hypot(ax, ay) * math.hypot(bx, by):
            return False
        before, here = here, after
    return True


def _directed(loop: Sequence[int]) -> list[Edge]:
    return list(zip(loop, [*loop[1:], loop[0]], strict=True))


def _undirected(loop: Sequence[int]) -> list[Edge]:
    return [(min(edge), max(edge)) for edge in _directed(loop)]

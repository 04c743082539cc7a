"""Flat faces cut into convex ones: triangles by ears (Meisters 1975), merged (Hertel and Mehlhorn 1983)."""

import math
from collections.abc import Sequence

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
    bend = np.einsum("nki,ni->nk", np.cross(before, after), normal)
    size = np.linalg.norm(before, axis=2) * np.linalg.norm(after, axis=2)
    used = column < count[:, None]
    angle = np.arctan2(bend, np.einsum("nki,nki->nk", before, after))
    return np.any((bend < -STRAIGHT * size) & used, axis=1) | (np.sum(angle, axis=1, where=used) > 3 * np.pi)


def outside(corners: np.ndarray, count: np.ndarray) -> np.ndarray:
    """(N,) how far (m) a corner of a padded polygon (N, K, 3) lies outside of an edge next to it; 0 where it is convex.

    An edge that runs back along the one before counts with its length. To clip something by a polygon with such an edge
    may leave nothing of it, however short the edge is.
    """
    normal = areas_normals_centroids(corners)[1]
    column = np.arange(corners.shape[1])
    last = np.take_along_axis(corners, np.maximum(count - 1, 0)[:, None, None], axis=1)
    before = corners - np.where((column == 0)[:, None], last, np.roll(corners, 1, axis=1))
    after = np.roll(corners, -1, axis=1) - corners
    bend = np.einsum("nki,ni->nk", np.cross(before, after), normal)
    long, short = np.sort([np.linalg.norm(before, axis=2), np.linalg.norm(after, axis=2)], axis=0)[::-1]
    distance = -bend / np.where(short > 0, short, 1.0)
    back = (np.einsum("nki,nki->nk", before, after) < 0) & (bend <= STRAIGHT * long * short)
    distance = np.where(back, np.maximum(distance, short), distance)
    return np.max(distance, axis=1, initial=0.0, where=column < count[:, None])


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
    remaining, cut = list(range(len(corners))), []
    while len(remaining) > 3:
        ears = [k for k in range(len(remaining)) if _is_ear(flat, remaining, k)]
        if not ears:
            raise GeometryError("a face has corners on its own edges and cannot be cut into triangles")
        best = max(ears, key=lambda k: _narrowest(flat, remaining, k))
        cut.append([remaining[best - 1], remaining[best], remaining[(best + 1) % len(remaining)]])
        del remaining[best]
    return np.array([*cut, remaining])


def _crosses(flat: np.ndarray) -> bool:
    """Whether two edges of a closed polygon (n, 2) cross."""
    start, end = flat, np.roll(flat, -1, axis=0)
    side = _cross((end - start)[:, None], flat[None] - start[:, None])  # [i, j]: corner j beside edge i
    apart = side * np.roll(side, -1, axis=1) < 0
    return bool(np.any(apart & apart.T))


def _is_ear(flat: np.ndarray, remaining: list[int], k: int) -> bool:
    a, b, c = flat[remaining[k - 1]], flat[remaining[k]], flat[remaining[(k + 1) % len(remaining)]]
    if _cross(b - a, c - b) <= STRAIGHT * np.linalg.norm(b - a) * np.linalg.norm(c - b):
        return False
    others = flat[
        [v for i, v in enumerate(remaining) if i not in (k, (k - 1) % len(remaining), (k + 1) % len(remaining))]
    ]
    inside = (_cross(b - a, others - a) >= 0) & (_cross(c - b, others - b) >= 0) & (_cross(a - c, others - c) >= 0)
    return not inside.any()


def _narrowest(flat: np.ndarray, remaining: list[int], k: int) -> float:
    """Height over longest side of the triangle at k, squared units cancelled: larger is rounder."""
    a, b, c = flat[remaining[k - 1]], flat[remaining[k]], flat[remaining[(k + 1) % len(remaining)]]
    longest = max(float(np.sum((p - q) ** 2)) for p, q in ((a, b), (b, c), (c, a)))
    return float(_cross(b - a, c - a)) / longest


def _cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


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


def _spliced(first: Polygon, second: Polygon, edge: Edge) -> Polygon:
    """Both polygons as one, without the edge that the first has as (a, b) and the second as (b, a)."""
    i, j = first.index(edge[1]), second.index(edge[0])
    ring, other = first[i:] + first[:i], second[j:] + second[:j]
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

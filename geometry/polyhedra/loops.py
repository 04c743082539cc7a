"""Rest of a flat face beside the polygons that cover it, as outlines with holes."""

import numpy as np

Loop = list[int]
Plane = dict[int, np.ndarray]


def reverse(loop: Loop) -> Loop:
    """The loop the other way round."""
    return loop[::-1]


def free_regions(vertices: np.ndarray, outline: Loop, covering: list[Loop], normal: np.ndarray) -> list[list[Loop]]:
    """Regions of the outline that no covering polygon takes up: for each, its outer loop and then its holes.

    The outline and the polygons run counter-clockwise about normal (3,), over all vertices (V, 3) that lie on them, so
    that edges cancel: outline less covering polygons, as chains of directed edges. A region that touches itself in a
    point has a loop that comes through this point twice.
    """
    if not covering:
        return [[outline]]
    edges = dict.fromkeys(_directed(outline))
    for polygon in covering:
        for start, end in _directed(polygon):
            if (start, end) in edges:
                del edges[start, end]
            else:
                edges[end, start] = None
    if not edges:
        return []
    used = np.unique([v for edge in edges for v in edge]).astype(np.int64)
    flat = dict(zip(used.tolist(), _in_plane(vertices[used], normal), strict=True))
    loops = _chain(flat, list(edges))
    outer = [[loop] for loop in loops if _signed_area(flat, loop) > 0]
    for loop in loops:
        if _signed_area(flat, loop) <= 0:
            next(region for region in outer if len(outer) == 1 or _contains(flat, region[0], loop)).append(loop)
    return outer


def _directed(loop: Loop) -> list[tuple[int, int]]:
    return list(zip(loop, loop[1:] + loop[:1], strict=True))


def _in_plane(vertices: np.ndarray, normal: np.ndarray) -> np.ndarray:
    """Coordinates (V, 2) in right-handed axes across the normal."""
    helper = np.eye(3)[np.argmin(np.abs(normal))]
    across = np.cross(normal, helper)
    across /= np.linalg.norm(across)
    return vertices @ np.stack([across, np.cross(normal, across)], axis=1)


def _chain(flat: Plane, edges: list[tuple[int, int]]) -> list[Loop]:
    """Closed loops of directed edges; where several begin, the sharpest left turn, which keeps regions apart."""
    leaving: dict[int, Loop] = {}
    for start, end in edges:
        leaving.setdefault(start, []).append(end)
    following = {}
    for start, end in edges:
        angles = [_clockwise(flat[start] - flat[end], flat[after] - flat[end]) for after in leaving[end]]
        following[start, end] = (end, leaving[end][int(np.argmin(angles))])
    loops = []
    while following:
        edge = next(iter(following))
        loop = []
        while edge in following:
            loop.append(edge[0])
            edge = following.pop(edge)
        loops.append(loop)
    return loops


def _clockwise(start: np.ndarray, end: np.ndarray) -> float:
    """Angle in (0, 2 pi] from start clockwise to end."""
    angle = np.arctan2(start[1] * end[0] - start[0] * end[1], start @ end)
    return float(angle) if angle > 0 else float(angle) + 2 * np.pi


def _signed_area(flat: Plane, loop: Loop) -> float:
    corner = np.array([flat[v] - flat[loop[0]] for v in loop])
    after = np.roll(corner, -1, axis=0)
    return float(np.sum(corner[:, 0] * after[:, 1] - corner[:, 1] * after[:, 0])) / 2


def _contains(flat: Plane, outer: Loop, hole: Loop) -> bool:
    """Whether the middle of the hole's first edge lies within the outer loop (crossings of a ray)."""
    x, y = (flat[hole[0]] + flat[hole[1]]) / 2
    corner = np.array([flat[v] for v in outer])
    after = np.roll(corner, -1, axis=0)
    straddles = (corner[:, 1] > y) != (after[:, 1] > y)
    a, b = corner[straddles], after[straddles]
    return bool(np.sum(a[:, 0] + (y - a[:, 1]) / (b[:, 1] - a[:, 1]) * (b[:, 0] - a[:, 0]) > x) % 2)

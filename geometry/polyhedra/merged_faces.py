"""Triangles of a surface mesh put together where they lie in one plane: flat convex faces, each as large as it goes."""

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from geometry.polyhedra.convexity import convex_pieces, reflex
from geometry.polyhedra.indexing import following
from geometry.polyhedra.polygons import areas_normals_centroids, pad

FLAT = 2e-10
"""Of the longest side: how far corners may stand off the plane of a face made of triangles."""
STRAIGHT = 1e-12
"""Of the longest side: corners that stand less than this off the line between their neighbours are left out."""


def merged_faces(
    points: np.ndarray, triangle: np.ndarray, block: np.ndarray, face: np.ndarray | None = None
) -> tuple[list[np.ndarray], np.ndarray]:
    """Faces as loops of points (P, 3), and the block of each, from the surface triangles (T, 3) of each block (T,).

    face  (T,) the same number for triangles that are known to lie in one plane, however slender they are
    Faces come in the order of blocks. Triangles whose union is not convex become convex pieces of it.
    """
    size = float(np.ptp(points, axis=0).max()) if len(points) else 1.0
    region = _regions(points, triangle, block, size, np.arange(len(triangle)) if face is None else face)
    order = np.argsort(region, kind="stable")
    parts = np.split(order, np.cumsum(np.bincount(region))[:-1])
    faces, owner = [], []
    loops = [_outline(triangle[part]) if len(part) > 1 else None for part in parts]
    whole = _convex(points, loops, size)
    for part, loop in zip(parts, whole, strict=True):
        pieces = [loop] if loop is not None else _pieces(points, triangle[part], size)
        faces += pieces
        owner += [block[part[0]]] * len(pieces)
    by_block = np.argsort(owner, kind="stable")
    return [faces[i] for i in by_block], np.array(owner, dtype=np.int64)[by_block]


def _regions(points: np.ndarray, triangle: np.ndarray, block: np.ndarray, size: float, face: np.ndarray) -> np.ndarray:
    """(T,) the same number for triangles of a face, or of a block if they hang together over edges in one plane."""
    _, normal, centroid = areas_normals_centroids(points[triangle])
    edge = np.sort(np.concatenate([triangle[:, [0, 1]], triangle[:, [1, 2]], triangle[:, [2, 0]]]), axis=1)
    of = np.tile(np.arange(len(triangle)), 3)
    key = np.stack([block[of], edge[:, 0], edge[:, 1]], axis=1)
    order = np.lexsort(key.T[::-1])
    key, of = key[order], of[order]
    same = np.all(key[1:] == key[:-1], axis=1)
    times = np.diff(np.flatnonzero(np.concatenate([[True], ~same, [True]])))
    twice = np.repeat(times, times) == 2
    first = np.flatnonzero(same & twice[1:])
    a, b = of[first], of[first + 1]
    height = np.abs(np.einsum("nki,ni->nk", points[triangle[b]] - centroid[a][:, None], normal[a])).max(axis=1)
    level = (height <= FLAT * size) & (np.einsum("ni,ni->n", normal[a], normal[b]) > 0.999)
    _, leader, number = np.unique(face, return_index=True, return_inverse=True)
    a, b = np.append(a[level], np.arange(len(triangle))), np.append(b[level], leader[number.reshape(-1)])
    link = coo_array((np.ones(len(a)), (a, b)), shape=(len(triangle),) * 2)
    return connected_components(link, directed=False)[1]


def _outline(triangle: np.ndarray) -> np.ndarray | None:
    """The one loop round some triangles; None if there are several, if it touches itself or if triangles are folded."""
    edges = {(a, b) for t in triangle.tolist() for a, b in zip(t, [*t[1:], t[0]], strict=True)}
    following = {}
    for a, b in edges:
        if (b, a) not in edges:
            if a in following:
                return None
            following[a] = b
    start = min(following)
    loop, at = [start], following[start]
    while at != start:
        if at not in following:
            return None
        loop.append(at)
        at = following[at]
    return np.array(loop) if len(loop) == len(following) else None


def _convex(points: np.ndarray, loops: list[np.ndarray | None], size: float) -> list[np.ndarray | None]:
    """The loops without corners on straight edges; None for those that are not flat and convex."""
    loops = _corners(points, loops, size)
    which = [i for i, loop in enumerate(loops) if loop is not None]
    if not which:
        return loops
    polygon, count = _padded(points, [loop for loop in loops if loop is not None])
    _, normal, centroid = areas_normals_centroids(polygon)
    height = np.abs(np.einsum("nki,ni->nk", polygon - centroid[:, None], normal)).max(axis=1)
    refused = reflex(polygon, count) | (height > FLAT * size)
    for i in np.flatnonzero(refused):
        loops[which[i]] = None
    return loops


def _padded(points: np.ndarray, loops: list[np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    start = np.concatenate([[0], np.cumsum([len(loop) for loop in loops])])
    return pad(points, start, np.concatenate(loops))


def _pieces(points: np.ndarray, triangle: np.ndarray, size: float) -> list[np.ndarray]:
    if len(triangle) == 1:
        return [triangle[0]]
    loops: list[np.ndarray | None] = [np.array(loop) for loop in convex_pieces(points, triangle, FLAT * size)]
    flat = [loop for loop in _convex(points, list(loops), size) if loop is not None]
    return flat if len(flat) == len(loops) else list(triangle)


def _corners(points: np.ndarray, loops: list[np.ndarray | None], size: float) -> list[np.ndarray | None]:
    """The loops without corners on straight edges; None for those with fewer than three others."""
    which = [i for i, loop in enumerate(loops) if loop is not None]
    chosen = [loop for loop in loops if loop is not None]
    if not which:
        return loops
    ring, last = np.concatenate(chosen), np.cumsum([len(loop) for loop in chosen])
    after = following(np.append(0, last))
    before = np.empty_like(after)
    before[after] = np.arange(len(after))
    place = points[ring]
    chord = place[after] - place[before]
    length = np.linalg.norm(chord, axis=1)
    height = np.linalg.norm(np.cross(chord, place - place[before]), axis=1) / np.where(length > 0, length, 1.0)
    corner = height > STRAIGHT * size
    result: list[np.ndarray | None] = [None] * len(loops)
    for i, loop, bends in zip(which, chosen, np.split(corner, last[:-1]), strict=True):
        if np.count_nonzero(bends) >= 3:
            result[i] = loop[bends]
    return result

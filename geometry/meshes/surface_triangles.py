"""Flat surfaces of a skeleton cut into triangles, the same for both blocks that share a surface."""

import numpy as np

from geometry.blocks import GeometryError
from geometry.polyhedra.convexity import reflex, triangles
from geometry.polyhedra.indexing import Lists
from geometry.polyhedra.polygons import areas_normals_centroids

NARROW = 0.5
"""Least quality of a fan from a corner, over that of the fan from the centroid, at which it is taken."""
FLAT = 1e-9
"""Height over longest side below which a triangle has no area."""


def surface_triangles(vertices: np.ndarray, outlines: Lists) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Vertices with added centroids (V', 3), triangles (M, 3) in the surface's sense, and the surface of each (M,).

    outlines  the loop of vertices round each surface
    Convex surfaces get a fan from the corner that suits best, or from their centroid where every corner gives narrow
    triangles. Surfaces have no holes. Raises GeometryError for one that is not convex and that no triangles fit to.
    """
    parts: list[tuple[np.ndarray, np.ndarray]] = []
    added: list[np.ndarray] = []
    count = len(vertices)
    for n in np.unique(outlines.lengths).tolist():
        which = np.flatnonzero(outlines.lengths == n)
        loop = outlines.entry[outlines.start[which][:, None] + np.arange(n)]
        bent = reflex(vertices[loop], np.full(len(loop), n))
        parts += [(triangle, np.full(n - 2, s)) for s, triangle in _ears(vertices, loop[bent], which[bent])]
        loop, which = loop[~bent], which[~bent]
        corner = vertices[loop]
        middle = areas_normals_centroids(corner)[2]
        apex, quality = _best_corner(corner)
        central = quality < NARROW * _central_quality(corner, middle)
        turned = np.take_along_axis(loop, (apex[:, None] + np.arange(n)) % n, axis=1)[~central]
        parts.append(_corner_fans(turned, which[~central]))
        number = count + np.arange(int(central.sum()))
        count += len(number)
        added.append(middle[central])
        parts.append(_central_fans(loop[central], number, which[central]))
    triangle, surface = (np.concatenate([part[k] for part in parts]) for k in (0, 1))
    return np.concatenate([vertices, *added]), triangle, surface


def _best_corner(corner: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(m,) the corner of each polygon (m, n, 3) whose fan has the best worst triangle, and the quality of that."""
    n = corner.shape[1]
    minimum = np.empty((len(corner), n))
    for apex in range(n):
        rest = np.roll(corner, -apex - 1, axis=1)[:, :-1]
        minimum[:, apex] = _quality(corner[:, apex, None], rest[:, :-1], rest[:, 1:]).min(axis=1)
    best = np.argmax(np.round(minimum, 9), axis=1)  # rounded: equal corners give the same choice on every machine
    return best, minimum[np.arange(len(corner)), best]


def _central_quality(corner: np.ndarray, middle: np.ndarray) -> np.ndarray:
    return _quality(middle[:, None], corner, np.roll(corner, -1, axis=1)).min(axis=1)


def _quality(a: np.ndarray, b: np.ndarray, c: np.ndarray) -> np.ndarray:
    """Twice the area over the square of the longest side."""
    longest = np.max([np.sum((p - q) ** 2, axis=-1) for p, q in ((a, b), (b, c), (c, a))], axis=0)
    return np.linalg.norm(np.cross(b - a, c - a), axis=-1) / longest


def _corner_fans(loop: np.ndarray, which: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    n = loop.shape[1]
    fan = np.stack([np.zeros(n - 2, dtype=np.int64), np.arange(1, n - 1), np.arange(2, n)], axis=1)
    return loop[:, fan].reshape(-1, 3), np.repeat(which, n - 2)


def _central_fans(loop: np.ndarray, centre: np.ndarray, which: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    n = loop.shape[1]
    fan = np.stack([np.repeat(centre[:, None], n, axis=1), loop, np.roll(loop, -1, axis=1)], axis=2)
    return fan.reshape(-1, 3), np.repeat(which, n)


def _ears(vertices: np.ndarray, loops: np.ndarray, which: np.ndarray) -> list[tuple[int, np.ndarray]]:
    """Surfaces that are not convex, one by one."""
    ears = []
    for loop, s in zip(loops, which.tolist(), strict=True):
        triangle = loop[triangles(vertices[loop])]
        if _quality(*(vertices[triangle[:, k]] for k in range(3))).min() < FLAT:
            raise GeometryError(
                "a fan of tets: no triangles fit to a free part of a face that is not convex; mesh by mesh_size"
            )
        ears.append((s, triangle))
    return ears

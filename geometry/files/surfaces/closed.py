"""Surfaces that are closed as they stand, as most are: their bodies, of all surfaces of a file at once."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from geometry.files.surfaces.closing import ROUNDING, ClosedBody
from geometry.files.surfaces.surface import Surface
from geometry.polyhedra.indexing import following, ranges


class _OwnFaces(NamedTuple):
    """Points (P, 3) of all surfaces, each with its own, and the surface (P,) of each; corners (N,) of all faces as
    numbers of points, and where each face begins (F + 1,)."""

    points: np.ndarray
    surface: np.ndarray
    corner: np.ndarray
    start: np.ndarray


def closed_parts(surfaces: Sequence[tuple[str, Surface]], flat: float) -> list[list[ClosedBody] | None]:
    """The bodies of each surface that is closed as it stands, as `parts_of` gives them; None for any other surface.

    surfaces  with what a message calls each      flat  as in `parts_of`
    """
    faces = _faces([surface for _, surface in surfaces])
    first = np.searchsorted(faces.surface, np.arange(len(surfaces)))
    low, high = np.minimum.reduceat(faces.points, first), np.maximum.reduceat(faces.points, first)
    with np.errstate(invalid="ignore", over="ignore"):
        size = (high - low).max(axis=1)
    closed = np.isfinite(size) & (size > 0)
    closed[faces.surface[faces.corner[_doubtful(faces)]]] = False
    allowed = np.maximum(flat, ROUNDING * np.maximum(np.abs(low), np.abs(high)).max(axis=1))
    parts: list[list[ClosedBody] | None] = [[] if is_closed else None for is_closed in closed]
    for surface, points, loops in _bodies(faces):
        if (mine := parts[surface]) is not None:
            mine.append(ClosedBody(surfaces[surface][0], points, loops, float(allowed[surface])))
    return [_told_apart(mine) if mine else mine for mine in parts]


def _told_apart(parts: list[ClosedBody]) -> list[ClosedBody]:
    if len(parts) == 1:
        return parts
    return [part._replace(called=f"{part.called}, body {n}") for n, part in enumerate(parts, 1)]


def _faces(surfaces: Sequence[Surface]) -> _OwnFaces:
    arrays = {id(surface.points): surface.points for surface in surfaces}  # those of an OBJ file share one
    before = dict(zip(arrays, np.cumsum([0, *(len(points) for points in arrays.values())]).tolist(), strict=False))
    every = np.concatenate(list(arrays.values()))
    length = np.array([len(face) for surface in surfaces for face in surface.faces])
    owner = np.repeat(np.arange(len(surfaces)), [len(surface.faces) for surface in surfaces])
    corner = np.concatenate([face for surface in surfaces for face in surface.faces])
    corner = corner + np.repeat(np.array([before[id(surface.points)] for surface in surfaces])[owner], length)
    used, place = np.unique(np.repeat(owner, length) * len(every) + corner, return_inverse=True)
    start = np.concatenate([[0], np.cumsum(length)])
    return _OwnFaces(every[used % len(every)], used // len(every), place.reshape(-1), start)


def _doubtful(faces: _OwnFaces) -> np.ndarray:
    """Where in `corner` there is one that its face has twice in a row, one at an edge that has not got two faces, or
    one of a face that is there twice."""
    corner = faces.corner
    after = corner[following(faces.start)]
    edge = np.minimum(corner, after) * len(faces.points) + np.maximum(corner, after)
    _, number, times = np.unique(edge, return_inverse=True, return_counts=True)
    return np.append(np.flatnonzero((corner == after) | (times[number.reshape(-1)] != 2)), _doubled(faces))


def _doubled(faces: _OwnFaces) -> np.ndarray:
    """Where in `corner` faces begin that have the same corners as another one."""
    length = np.diff(faces.start)
    doubled = []
    for n in np.unique(length):
        first = faces.start[:-1][length == n]
        corners = np.sort(faces.corner[first[:, None] + np.arange(n)], axis=1)
        order = np.lexsort(corners.T)
        doubled.append(first[order[1:][(np.diff(corners[order], axis=0) == 0).all(axis=1)]])
    return np.concatenate(doubled)


def _bodies(faces: _OwnFaces) -> Iterator[tuple[int, np.ndarray, list[np.ndarray]]]:
    """The surface, the points (P, 3) and the faces, as numbers of these, of each body, in the order of first faces."""
    points, _, corner, start = faces
    head, length = corner[start[:-1]], np.diff(start)
    link = coo_array((np.ones(len(corner)), (np.repeat(head, length), corner)), shape=(len(points),) * 2)
    label = connected_components(link, directed=False)[1]
    _, first, of_loop = np.unique(label[head], return_index=True, return_inverse=True)
    rank = np.empty(len(first), dtype=np.int64)
    rank[np.argsort(first)] = np.arange(len(first))
    of_loop, of_point = rank[of_loop.reshape(-1)], np.empty(len(points), dtype=np.int64)
    of_point[corner] = np.repeat(of_loop, length)
    ends = np.cumsum(np.bincount(of_point))
    order = np.argsort(of_point, kind="stable")
    number = np.empty(len(points), dtype=np.int64)
    number[order] = np.arange(len(points)) - np.append(0, ends)[of_point[order]]
    by_body = np.argsort(of_loop, kind="stable")
    _, where = ranges(start[by_body], length[by_body])
    loops = np.split(number[corner[where]], np.cumsum(length[by_body])[:-1])
    last = np.cumsum(np.bincount(of_loop))
    parts = np.split(points[order], ends[:-1])
    for b, (begin, end) in enumerate(zip(np.append(0, last), last, strict=False)):
        yield int(faces.surface[head[by_body[begin]]]), parts[b], loops[begin:end]

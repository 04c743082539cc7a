"""Triangles of a surface that lie in one plane but for noise, grown from the largest face.

Noise and curvature are told apart by size: noise lifts a corner by the same amount however large a face is, while a
curved surface leaves its plane the more the farther one goes. A sliver at an edge lies in both planes but for noise; it
goes to the nearer one.
"""

from typing import Any, NamedTuple

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from geometry.polyhedra.indexing import ranges
from geometry.polyhedra.polygons import areas_normals_centroids

TILT = 5e-3
"""Sine of the angle by which a face may lean off the plane of its neighbours, unless its corners stand off by a
FAINT part of the tolerance only: the angles of small faces are noise."""
FAINT = 0.2
CURVED = 1e-3
"""Of the side of a square as large as a region: regions of several faces whose corners stand off by more are curved."""
MANY = 20_000
"""Neighbours that may lie in one plane, up to which all of them are tried."""
BENT = 1e-2
"""The same of a region that is one face of the file."""
NEARER = 0.5
"""How far a face is off the plane of a neighbouring region, over how far off that of its own, for it to go over."""
ROUNDS = 10


class Mesh(NamedTuple):
    """Surfaces of one body or many: points (P, 3), each of one body; triangles (T, 3) into them; the face (T,), flat or
    not, that each is part of, and the body (T,), numbered from 0."""

    points: np.ndarray
    triangle: np.ndarray
    face: np.ndarray
    body: np.ndarray

    def sizes(self, bodies: int) -> np.ndarray:
        """(B,) m, the longest side of the box round each body."""
        corner, body = self.points[self.triangle], self.body
        low, high = np.full((bodies, 3), np.inf), np.full((bodies, 3), -np.inf)
        np.minimum.at(low, body, corner.min(axis=1))
        np.maximum.at(high, body, corner.max(axis=1))
        return np.asarray((high - low).max(axis=1))

    def places(self) -> np.ndarray:
        """(T, 3, 3) m, corners of the triangles, from the middle of the corners of their body."""
        count = int(self.body.max()) + 1
        of_point = np.full(len(self.points), count)
        of_point[self.triangle] = self.body[:, None]
        sums = np.stack([np.bincount(of_point, column, count + 1) for column in self.points.T], axis=1)
        middle = sums / np.maximum(np.bincount(of_point, minlength=count + 1), 1)[:, None]
        return np.asarray(self.points[self.triangle] - middle[self.body][:, None])


class _FlatFaces(NamedTuple):
    """Data of faces: corners (T, 3, 3) of all triangles, those of a face one after another; where each face begins (K +
    1,); its longest side (K,) along an axis; moments (K, 13) and vectors (K, 3) as `_moments` has them; the body
    (K,)."""

    place: np.ndarray
    start: np.ndarray
    side: np.ndarray
    moment: np.ndarray
    vector: np.ndarray
    body: np.ndarray

    def corners(self, f: int) -> np.ndarray:
        """(t, 3, 3) m of the triangles of a face."""
        return self.place[self.start[f] : self.start[f + 1]]


def flat_regions(mesh: Mesh, flat: np.ndarray) -> np.ndarray:
    """(T,) numbers from 0, the same for triangles of a region that is flat within `flat` (B,) m of its body."""
    face = np.unique(mesh.face, return_inverse=True)[1].reshape(-1)
    pairs = _leaning_on(mesh, face, flat)
    region = _grown(mesh, face, pairs, flat) if len(pairs) else face
    return _without_curved(mesh, face, region, flat)


def _leaning_on(mesh: Mesh, face: np.ndarray, flat: np.ndarray) -> np.ndarray:
    """Pairs (n, 2) of neighbouring faces whose two triangles at the edge may lie in one plane."""
    points, triangle = mesh.points, mesh.triangle
    edge = np.sort(np.concatenate([triangle[:, [0, 1]], triangle[:, [1, 2]], triangle[:, [2, 0]]]), axis=1)
    of = np.tile(np.arange(len(triangle)), 3)
    order = np.lexsort(edge.T[::-1])
    edge, of = edge[order], of[order]
    same = np.flatnonzero(np.all(edge[1:] == edge[:-1], axis=1))
    a, b = of[same], of[same + 1]
    other = face[a] != face[b]
    a, b = a[other], b[other]
    area, normals, _ = areas_normals_centroids(points[triangle])
    facing = np.einsum("ni,ni->n", normals[a], normals[b])
    corner = points[np.concatenate([triangle[a], triangle[b]], axis=1)]
    arm = corner - corner.mean(axis=1, keepdims=True)
    normal = np.linalg.eigh(np.einsum("nki,nkj->nij", arm, arm))[1][:, :, 0]
    height = np.abs(np.einsum("nki,ni->nk", arm, normal)).max(axis=1)
    allowed = flat[mesh.body[a]]
    tiny = height <= FAINT * allowed
    level = (height <= allowed) & (tiny | (facing > 1 - TILT**2 / 2))
    many = np.bincount(mesh.body[a][level], minlength=len(flat)) > MANY
    level &= ~many[mesh.body[a]] | (height <= CURVED * np.sqrt(area[a] + area[b]))  # a scan bends at every edge
    return np.stack([face[a[level]], face[b[level]]], axis=1)


def _grown(mesh: Mesh, face: np.ndarray, pairs: np.ndarray, flat: np.ndarray) -> np.ndarray:
    """(T,) regions of faces that hang together by pairs (n, 2), grown from the largest face that is left."""
    order = np.argsort(face, kind="stable")
    start = np.cumsum(np.append(0, np.bincount(face)))
    place = mesh.places()[order]
    side = np.maximum.reduceat(place.max(axis=1), start[:-1]) - np.minimum.reduceat(place.min(axis=1), start[:-1])
    faces = _FlatFaces(place, start, side.max(axis=1), *_moments(mesh, face), mesh.body[order][start[:-1]])
    region = np.arange(len(faces.moment))
    link = coo_array((np.ones(len(pairs)), tuple(pairs.T)), shape=(len(region),) * 2)
    label = connected_components(link, directed=False)[1]
    two = np.bincount(label)[label] == 2
    _join_pairs(region, np.unique(np.sort(pairs[two[pairs[:, 0]]], axis=1), axis=0), faces, flat)
    _grow(region, pairs[~two[pairs[:, 0]]], faces, flat)
    first, other = pairs[region[pairs[:, 0]] == region[pairs[:, 1]]].T
    link = coo_array((np.ones(len(first)), (first, other)), shape=(len(region),) * 2)
    return connected_components(link, directed=False)[1][face].astype(np.int64)


def _join_pairs(region: np.ndarray, pairs: np.ndarray, faces: _FlatFaces, flat: np.ndarray) -> None:
    """As `_grow`, for pairs (n, 2) of faces that lean on each other alone: all at once."""
    if not len(pairs):
        return
    area = faces.moment[pairs, 0]
    swapped = area[:, 1] > area[:, 0]
    seed, other = np.where(swapped, pairs[:, 1], pairs[:, 0]), np.where(swapped, pairs[:, 0], pairs[:, 1])
    normal, level = _planes(faces.moment[seed], faces.vector[seed])
    of, row = ranges(faces.start[other], np.diff(faces.start)[other])
    corner, first = faces.place[row], np.flatnonzero(np.diff(of, prepend=-1))
    height = np.abs(np.einsum("tki,ti->tk", corner, normal[of]) - level[of][:, None]).max(axis=1)
    height = np.maximum.reduceat(height, first)
    along = np.einsum("ni,ni->n", faces.vector[other], normal)
    size = np.linalg.norm(faces.vector[other], axis=1)
    joins = _looks_along(height, along, size, faces.side[other], flat[faces.body[seed]])
    region[other[joins]] = seed[joins]


def _grow(region: np.ndarray, pairs: np.ndarray, faces: _FlatFaces, flat: np.ndarray) -> None:
    """Give faces that lean on others, by pairs (n, 2), the number of the largest face of their region (K,)."""
    if not len(pairs):
        return
    moment, vector = faces.moment, faces.vector
    beside: dict[int, list[int]] = {}
    for face, neighbour in np.unique(np.concatenate([pairs, pairs[:, ::-1]]), axis=0).tolist():
        beside.setdefault(face, []).append(neighbour)
    free = dict.fromkeys(beside, True)
    normals, levels = _planes(moment, vector)
    for seed in sorted(beside, key=lambda f: (-moment[f, 0], f)):
        if not free[seed]:
            continue
        free[seed] = False
        total, looking = moment[seed].copy(), vector[seed].copy()
        normal, level, allowed = normals[seed], levels[seed], float(flat[faces.body[seed]])
        waiting = list(beside[seed])
        while waiting:
            f = waiting.pop()
            if not free[f] or not _is_level(faces, f, normal, level, allowed):
                continue
            region[f], free[f] = seed, False
            total += moment[f]
            looking += vector[f]
            normal, level = (values[0] for values in _planes(total[None], looking[None]))
            waiting += [g for g in beside[f] if free[g]]
    _go_over(region, beside, faces, flat)


def _go_over(region: np.ndarray, beside: dict[int, list[int]], faces: _FlatFaces, flat: np.ndarray) -> None:
    """Give faces, in region (K,), to the neighbouring region whose plane is clearly nearer, until none is.

    What is flat is grown from the largest face, which takes slivers at its edges that are part of its neighbours.
    """
    moment, vector = faces.moment, faces.vector
    for _ in range(ROUNDS):
        total, looking = (
            np.stack([np.bincount(region, column, len(region)) for column in of.T], axis=1) for of in (moment, vector)
        )
        normal, level = _planes(total, looking)
        before = region.copy()
        for f, near in beside.items():
            others = {r for r in region[near].tolist() if r != region[f] and total[r, 0] > moment[f, 0]}
            if not others:
                continue
            corners = faces.corners(f)
            own_distance, *distances = (
                float(np.abs(corners @ normal[r] - level[r]).max()) for r in (region[f], *others)
            )
            minimum, r = min(zip(distances, others, strict=True))
            if minimum < NEARER * own_distance and _is_level(faces, f, normal[r], level[r], float(flat[faces.body[f]])):
                region[f] = r
        if np.array_equal(region, before):
            return


def _is_level(faces: _FlatFaces, f: int, normal: np.ndarray, level: float, flat: float) -> bool:
    """Whether a face lies in a plane but for noise and looks the same way; a sliver may look any way."""
    height, vector = float(np.abs(faces.corners(f) @ normal - level).max()), faces.vector[f]
    if height > flat:
        return False
    return bool(_looks_along(height, vector @ normal, np.linalg.norm(vector), faces.side[f], flat))


def _looks_along(height: Any, along: Any, size: Any, side: Any, flat: Any) -> Any:
    """The same from numbers of faces, or arrays of them: height off the plane (m), vector of the area along its normal
    and whole (m2), longest side (m)."""
    faint = (along > 0.5 * size) | (2 * size <= FAINT * flat * side)
    return (height <= flat) & np.where(height > FAINT * flat, along > (1 - TILT**2 / 2) * size, faint)


def _moments(mesh: Mesh, group: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Of each group (T,) of triangles: area, its first and second moments about the middle of their body (K, 13), and
    the vector of its area (K, 3)."""
    count = int(group.max()) + 1
    place = mesh.places()
    cross = np.cross(place[:, 1] - place[:, 0], place[:, 2] - place[:, 0]) / 2
    area, total = np.linalg.norm(cross, axis=1), place.sum(axis=1)
    second = np.einsum("tci,tcj->tij", place, place) + total[:, :, None] * total[:, None]
    second = (area[:, None, None] * second / 12).reshape(-1, 9)
    columns = np.column_stack([area, area[:, None] * total / 3, second, cross]).T
    sums = np.stack([np.bincount(group, column, count) for column in columns], axis=1)
    return sums[:, :13], sums[:, 13:]


def _planes(moment: np.ndarray, looking: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The planes nearest to areas by their moments: unit normals (K, 3), turned as looking (K, 3), and levels (K,)."""
    area = np.where(moment[:, 0] > 0, moment[:, 0], 1.0)[:, None]
    middle = moment[:, 1:4] / area
    matrix = (moment[:, 4:] / area).reshape(-1, 3, 3) - middle[:, :, None] * middle[:, None]
    normal = np.linalg.eigh(matrix)[1][:, :, 0]
    normal *= np.where(np.einsum("ki,ki->k", normal, looking) < 0, -1.0, 1.0)[:, None]
    return normal, np.einsum("ki,ki->k", normal, middle)


def _without_curved(mesh: Mesh, face: np.ndarray, region: np.ndarray, flat: np.ndarray) -> np.ndarray:
    """The regions with those taken apart that are curved, or bent by more than flat: into faces, and into triangles."""
    several = np.bincount(np.unique(region * len(face) + face) // len(face)) > 1
    whole = _is_even(mesh, region, flat, np.where(several, CURVED, BENT))[region]
    alone = _is_even(mesh, face, flat, np.full(int(face.max()) + 1, BENT))[face]
    apart = np.where(alone, len(face) + face, 2 * len(face) + np.arange(len(face)))
    return np.unique(np.where(whole, region, apart), return_inverse=True)[1].reshape(-1)


def _is_even(mesh: Mesh, group: np.ndarray, flat: np.ndarray, fraction: np.ndarray) -> np.ndarray:
    """(K,) whether no corner of a group stands off its plane by more than flat (B,) m, and `fraction` of its side."""
    moment, vector = _moments(mesh, group)
    normal, level = _planes(moment, vector)
    place, allowed = mesh.places(), np.zeros(len(moment))
    height = np.abs(np.einsum("tki,ti->tk", place, normal[group]) - level[group][:, None]).max(axis=1)
    distance = np.zeros(len(moment))
    np.maximum.at(distance, group, height)
    allowed[group] = flat[mesh.body]
    return np.asarray(distance <= np.minimum(allowed, fraction * np.sqrt(moment[:, 0])))

"""Triangles of a surface that lie in one plane but for noise, grown from the largest face.

Noise and curvature are told apart by size: noise lifts a corner by the same amount however large a face is, while a
curved surface leaves its plane the more the farther one goes. A sliver at an edge lies in both planes but for noise; it
goes to the nearer one.
"""

from typing import NamedTuple

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

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
    """A surface: points (P, 3), triangles (T, 3) into them, and the face (T,), flat or not, that each is part of."""

    points: np.ndarray
    triangle: np.ndarray
    face: np.ndarray


def flat_regions(mesh: Mesh, flat: float) -> np.ndarray:
    """(T,) numbers from 0, the same for triangles of a region that is flat within `flat` (m)."""
    face = np.unique(mesh.face, return_inverse=True)[1].reshape(-1)
    pairs = _leaning_on(mesh, face, flat)
    region = _grown(mesh, face, pairs, flat) if len(pairs) else face
    return _without_curved(mesh, face, region, flat)


def _leaning_on(mesh: Mesh, face: np.ndarray, flat: float) -> np.ndarray:
    """Pairs (n, 2) of neighbouring faces whose two triangles at the edge may lie in one plane."""
    points, triangle, _ = mesh
    edge = np.sort(np.concatenate([triangle[:, [0, 1]], triangle[:, [1, 2]], triangle[:, [2, 0]]]), axis=1)
    of = np.tile(np.arange(len(triangle)), 3)
    order = np.lexsort(edge.T[::-1])
    edge, of = edge[order], of[order]
    same = np.flatnonzero(np.all(edge[1:] == edge[:-1], axis=1))
    a, b = of[same], of[same + 1]
    other = face[a] != face[b]
    a, b = a[other], b[other]
    corner = points[np.concatenate([triangle[a], triangle[b]], axis=1)]
    arm = corner - corner.mean(axis=1, keepdims=True)
    normal = np.linalg.eigh(np.einsum("nki,nkj->nij", arm, arm))[1][:, :, 0]
    height = np.abs(np.einsum("nki,ni->nk", arm, normal)).max(axis=1)
    area, normals, _ = areas_normals_centroids(points[triangle])
    facing = np.einsum("ni,ni->n", normals[a], normals[b])
    tiny = height <= FAINT * flat
    level = (height <= flat) & (tiny | (facing > 1 - TILT**2 / 2))
    if level.sum() > MANY:  # a scan: what bends from triangle to triangle is curved
        level &= height <= CURVED * np.sqrt(area[a] + area[b])
    return np.stack([face[a[level]], face[b[level]]], axis=1)


def _grown(mesh: Mesh, face: np.ndarray, pairs: np.ndarray, flat: float) -> np.ndarray:
    """(T,) regions of faces that hang together by pairs (n, 2), grown from the largest face that is left."""
    moment, vector = moments = _moments(mesh, face)
    beside: dict[int, list[int]] = {}
    for one, two in np.unique(np.concatenate([pairs, pairs[:, ::-1]]), axis=0).tolist():
        beside.setdefault(one, []).append(two)
    order = np.argsort(face, kind="stable")
    place = mesh.points[mesh.triangle] - mesh.points.mean(axis=0)
    corners = np.split(place[order], np.cumsum(np.bincount(face))[:-1])
    region = np.full(len(moment), -1)
    normals, levels = _planes(moment, vector)
    for seed in sorted(beside, key=lambda f: (-moment[f, 0], f)):
        if region[seed] >= 0:
            continue
        region[seed] = seed
        total, looking = moment[seed].copy(), vector[seed].copy()
        normal, level = normals[seed], levels[seed]
        waiting = list(beside[seed])
        while waiting:
            f = waiting.pop()
            if region[f] >= 0 or not _is_level(corners[f], vector[f], normal, level, flat):
                continue
            region[f] = seed
            total += moment[f]
            looking += vector[f]
            normal, level = (values[0] for values in _planes(total[None], looking[None]))
            waiting += [g for g in beside[f] if region[g] < 0]
    region = np.where(region < 0, np.arange(len(region)), region)
    _go_over(region, beside, corners, moments, flat)
    one, two = pairs[region[pairs[:, 0]] == region[pairs[:, 1]]].T
    link = coo_array((np.ones(len(one)), (one, two)), shape=(len(region),) * 2)
    return np.asarray(connected_components(link, directed=False)[1][face])


def _go_over(
    region: np.ndarray,
    beside: dict[int, list[int]],
    corners: list[np.ndarray],
    moments: tuple[np.ndarray, np.ndarray],
    flat: float,
) -> None:
    """Give faces, in region (K,), to the neighbouring region whose plane is clearly nearer, until none is.

    What is flat is grown from the largest face, which takes slivers at its edges that are part of its neighbours.
    """
    moment, vector = moments
    for _ in range(ROUNDS):
        total, looking = (
            np.stack([np.bincount(region, column, len(region)) for column in of.T], axis=1) for of in moments
        )
        normal, level = _planes(total, looking)
        before = region.copy()
        for f, near in beside.items():
            others = {r for r in region[near].tolist() if r != region[f] and total[r, 0] > moment[f, 0]}
            if not others:
                continue
            own, *off = (float(np.abs(corners[f] @ normal[r] - level[r]).max()) for r in (region[f], *others))
            least, r = min(zip(off, others, strict=True))
            if least < NEARER * own and _is_level(corners[f], vector[f], normal[r], level[r], flat):
                region[f] = r
        if np.array_equal(region, before):
            return


def _is_level(corners: np.ndarray, vector: np.ndarray, normal: np.ndarray, level: float, flat: float) -> bool:
    """Whether a face (t, 3, 3) lies in a plane but for noise and looks the same way; a sliver may look any way."""
    height = float(np.abs(corners @ normal - level).max())
    if height > flat:
        return False
    along, size = float(vector @ normal), float(np.linalg.norm(vector))
    if height > FAINT * flat:
        return along > (1 - TILT**2 / 2) * size
    return along > 0.5 * size or 2 * size <= FAINT * flat * float(np.ptp(corners, axis=(0, 1)).max())


def _moments(mesh: Mesh, group: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Of each group (T,) of triangles: area, its first and second moments about the middle of all points (K, 13), and
    the vector of its area (K, 3)."""
    count = int(group.max()) + 1
    place = mesh.points[mesh.triangle] - mesh.points.mean(axis=0)
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


def _without_curved(mesh: Mesh, face: np.ndarray, region: np.ndarray, flat: float) -> np.ndarray:
    """The regions with those taken apart that are curved, or bent by more than flat: into faces, and into triangles."""
    faces = np.unique(np.stack([region, face]), axis=1)
    several = np.bincount(faces[0]) > 1
    whole = _is_even(mesh, region, flat, np.where(several, CURVED, BENT))[region]
    alone = _is_even(mesh, face, flat, np.full(int(face.max()) + 1, BENT))[face]
    apart = np.where(alone, len(face) + face, 2 * len(face) + np.arange(len(face)))
    return np.unique(np.where(whole, region, apart), return_inverse=True)[1].reshape(-1)


def _is_even(mesh: Mesh, group: np.ndarray, flat: float, most: np.ndarray) -> np.ndarray:
    """(K,) whether no corner of a group stands off its plane by more than flat (m), and `most` (K,) of its side."""
    moment, vector = _moments(mesh, group)
    normal, level = _planes(moment, vector)
    place = mesh.points[mesh.triangle] - mesh.points.mean(axis=0)
    height = np.abs(np.einsum("tki,ti->tk", place, normal[group]) - level[group][:, None]).max(axis=1)
    off = np.zeros(len(moment))
    np.maximum.at(off, group, height)
    return np.asarray(off <= np.minimum(flat, most * np.sqrt(moment[:, 0])))

"""Closed bodies whose faces are flat and convex, as most are: turned outwards and looked at, many at once."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from geometry.files.surfaces.closing import ClosedBody
from geometry.files.surfaces.crossings import crossings
from geometry.polyhedra.flat.regions import BENT
from geometry.polyhedra.polygons import areas_normals_centroids
from geometry.polyhedra.validate import FLAT
from geometry.specimens.from_arrays import Shell

TURN = 1e-6
"""Sine of the angle by which a face turns at each of its corners at least."""
DEEP = 1e-7
"""Of the longest side: a surface that goes through itself by less does not."""


class Outward(NamedTuple):
    """A body: the triangles round it, its volume in the unit of the file, whether it was turned to look outwards."""

    shell: Shell
    volume: float
    turned: bool


class _ManyBodies(NamedTuple):
    """Points (P, 3) of all bodies; where those of each begin (B + 1,); corners (N,) of all faces as numbers of points;
    where each face begins (F + 1,), and its body (F,); longest side (B,) and how flat (B,) a face must be."""

    points: np.ndarray
    first: np.ndarray
    corner: np.ndarray
    start: np.ndarray
    body: np.ndarray
    size: np.ndarray
    flat: np.ndarray


def flat_convex(parts: Sequence[ClosedBody]) -> list[Outward | None]:
    """Each body whose faces are flat and convex, look all outwards or all inwards, and go through each other nowhere;
    None for any other one, of which others find out what is wrong with it, if anything is."""
    if not parts:
        return []
    bodies = _bodies(parts)
    good = np.ones(len(parts), dtype=bool)
    triangle, face = _cut(bodies, good)
    of_face = bodies.body[face]
    _look_alike(triangle, of_face, len(bodies.points), good)
    volume = _volumes(bodies, triangle, of_face)
    turned = volume < 0
    good &= np.abs(volume) > 2 * FLAT * bodies.size**3
    triangle = np.where(turned[of_face][:, None], triangle[:, ::-1], triangle)
    sound = good[of_face]
    for crossed, _ in crossings(bodies.points, triangle[sound], of_face[sound], DEEP * bodies.size):
        good[crossed] = False
    count = np.bincount(of_face, minlength=len(parts))
    last = np.cumsum(count)
    local = triangle - bodies.first[of_face][:, None]
    number = face - np.searchsorted(bodies.body, of_face)
    return [
        Outward(Shell(part.points, local[end - n : end], number[end - n : end]), abs(float(volume[b])), bool(turned[b]))
        if good[b]
        else None
        for b, (part, n, end) in enumerate(zip(parts, count, last, strict=True))
    ]


def _bodies(parts: Sequence[ClosedBody]) -> _ManyBodies:
    points = np.concatenate([part.points for part in parts])
    first = np.cumsum([0, *(len(part.points) for part in parts)])
    length = np.array([len(loop) for part in parts for loop in part.loops])
    body = np.repeat(np.arange(len(parts)), [len(part.loops) for part in parts])
    corner = np.concatenate([loop for part in parts for loop in part.loops]) + np.repeat(first[body], length)
    spread = np.maximum.reduceat(points, first[:-1]) - np.minimum.reduceat(points, first[:-1])
    start = np.concatenate([[0], np.cumsum(length)])
    return _ManyBodies(points, first, corner, start, body, spread.max(axis=1), np.array([part.flat for part in parts]))


def _cut(bodies: _ManyBodies, good: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Triangles (T, 3) of all faces, and the face (T,) of each; bodies (B,) with one that is not flat, or not convex,
    are good no more."""
    cut, faces, length = [], [], np.diff(bodies.start)
    for n in np.unique(length):
        which = np.flatnonzero(length == n)
        ring = bodies.corner[bodies.start[which][:, None] + np.arange(n)]
        corners, body = bodies.points[ring], bodies.body[which]
        area, normal, centroid = areas_normals_centroids(corners)
        height = np.abs(np.einsum("nki,ni->nk", corners - centroid[:, None], normal)).max(axis=1)
        size, flat = bodies.size[body], bodies.flat[body]
        bad = ~(area > (FLAT * size) ** 2)
        if n > 3:
            bad |= ~(height <= np.maximum(FLAT * size, np.minimum(flat, BENT * np.sqrt(area))))
            bad |= ~_turns_left(corners, normal)
        good[body[bad]] = False
        taken = np.take_along_axis(ring[:, None], _ears(corners, normal), axis=2)
        cut.append(taken.reshape(-1, 3))
        faces.append(np.repeat(which, n - 2))
    face = np.concatenate(faces)
    order = np.argsort(face, kind="stable")
    return np.concatenate(cut)[order], face[order]


def _turns_left(corners: np.ndarray, normal: np.ndarray) -> np.ndarray:
    """(N,) whether polygons (N, n, 3) turn left at each corner, and once round in all."""
    before, after = corners - np.roll(corners, 1, axis=1), np.roll(corners, -1, axis=1) - corners
    bend = np.einsum("nki,ni->nk", np.cross(before, after), normal)
    length = np.linalg.norm(before, axis=2) * np.linalg.norm(after, axis=2)
    angle = np.arctan2(bend, np.einsum("nki,nki->nk", before, after))
    return np.asarray((bend > TURN * length).all(axis=1) & (angle.sum(axis=1) < 3 * np.pi))


def _ears(corners: np.ndarray, normal: np.ndarray) -> np.ndarray:
    """(N, n - 2, 3) corner numbers of the triangles that fill convex polygons (N, n, 3): the roundest corner is cut off
    first, as `triangles` does."""
    remaining = np.tile(np.arange(corners.shape[1]), (len(corners), 1))
    ears = []
    while remaining.shape[1] > 3:
        rings = np.stack([np.roll(remaining, 1, axis=1), remaining, np.roll(remaining, -1, axis=1)], axis=2)
        a, b, c = (np.take_along_axis(corners, rings[:, :, k, None], axis=1) for k in range(3))
        longest = np.max([np.einsum("nki,nki->nk", side, side) for side in (b - a, c - b, a - c)], axis=0)
        height = np.einsum("nki,ni->nk", np.cross(b - a, c - a), normal) / np.where(longest > 0, longest, 1.0)
        best = height.argmax(axis=1)
        ears.append(rings[np.arange(len(remaining)), best])
        remaining = remaining[np.arange(remaining.shape[1]) != best[:, None]].reshape(len(remaining), -1)
    return np.stack([*ears, remaining], axis=1)


def _look_alike(triangle: np.ndarray, body: np.ndarray, points: int, good: np.ndarray) -> None:
    """Bodies are good no more in which two triangles go along an edge the same way, or which do not hang together over
    edges."""
    start, end = triangle.ravel(), np.roll(triangle, -1, axis=1).ravel()
    there, back = start * points + end, end * points + start
    order = np.argsort(there, kind="stable")
    ahead = there[order]
    twice = np.flatnonzero(np.diff(ahead) == 0)
    beside = np.minimum(np.searchsorted(ahead, back), len(ahead) - 1)
    matched = ahead[beside] == back
    of = np.repeat(np.arange(len(triangle)), 3)
    good[body[of[order[twice]]]] = False
    good[body[of[~matched]]] = False
    link = coo_array((matched.astype(float), (of, of[order[beside]])), shape=(len(triangle),) * 2)
    label = connected_components(link, directed=False)[1]
    good[np.bincount(body[np.unique(label, return_index=True)[1]], minlength=len(good)) != 1] = False


def _volumes(bodies: _ManyBodies, triangle: np.ndarray, body: np.ndarray) -> np.ndarray:
    """(B,) volumes in the unit of the file, below 0 where triangles look inwards."""
    arm = bodies.points[triangle] - bodies.points[bodies.first[body]][:, None]
    part = np.einsum("ti,ti->t", arm[:, 0], np.cross(arm[:, 1], arm[:, 2])) / 6
    return np.bincount(body, part, len(bodies.size))

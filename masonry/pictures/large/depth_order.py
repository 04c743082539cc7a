"""Faces seen by a camera, in an order in which each may be drawn over those before it."""

import heapq

import numpy as np

from geometry.polyhedra.box_pairs import overlapping_boxes
from geometry.polyhedra.polygons import areas_normals_centroids
from masonry.pictures.camera import Camera

SHRUNK = 1e-3
"""Faces are shrunk by this share, so that those that only meet at an edge do not count as one before the other."""
LEVEL = 1e-7
"""Share of the size of the picture: faces whose depths differ by less lie in one plane."""
CHUNK = 10_000
"""Pairs of faces that are looked at together."""


def farthest_first(corners: np.ndarray, camera: Camera) -> np.ndarray:
    """(N,) the order in which to draw convex faces (N, K, 3) m, padded, that look toward the viewer.

    Of two faces that cover one another in the picture, the one that is nearer at the middle of what they share comes
    later: for planar faces that do not cross this holds all over it. A ring of such pairs is cut at its farthest face.
    """
    pair, nearer = overlaps(corners, camera)
    far, near = np.where(nearer, pair.T, pair.T[::-1])
    depth = (corners.mean(axis=1) @ camera.toward).tolist()
    return np.array(_sorted(far.tolist(), near.tolist(), depth), dtype=np.int64)


def overlaps(corners: np.ndarray, camera: Camera) -> tuple[np.ndarray, np.ndarray]:
    """Pairs (n, 2) of faces that cover one another in the picture, and whether the second is the nearer one."""
    flat = camera.project(corners)
    middle = flat.mean(axis=1, keepdims=True)
    flat = middle + (1.0 - SHRUNK) * (flat - middle)
    pairs = overlapping_boxes(flat.min(axis=1), flat.max(axis=1))
    _, normal, centre = areas_normals_centroids(corners)
    steep = normal @ camera.toward
    slope = -camera.project(normal) / steep[:, None]
    level = np.einsum("ni,ni->n", normal, centre) / steep
    ordered, second = [np.zeros((0, 2), dtype=np.int64)], [np.zeros(0, dtype=bool)]
    for begin in range(0, len(pairs), CHUNK):
        pair = pairs[begin : begin + CHUNK]
        place, covers = _shared_middle(flat[pair[:, 0]], flat[pair[:, 1]])
        depth = level[pair] + np.einsum("nki,ni->nk", slope[pair], place)
        gap = depth[:, 1] - depth[:, 0]
        is_clear = covers & (np.abs(gap) > LEVEL * camera.size)
        ordered.append(pair[is_clear])
        second.append(gap[is_clear] > 0.0)
    return np.concatenate(ordered), np.concatenate(second)


def _shared_middle(polygon_a: np.ndarray, polygon_b: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """A place (n, 2) within both of two convex polygons (n, K, 2), and whether there is any.

    It is the mean of the corners of what they share: corners of one within the other, and crossings of their edges.
    """
    first, second = np.roll(polygon_a, -1, axis=1) - polygon_a, np.roll(polygon_b, -1, axis=1) - polygon_b
    apart = polygon_b[:, None, :, :] - polygon_a[:, :, None, :]
    across = _cross(first[:, :, None], second[:, None, :])
    with np.errstate(divide="ignore", invalid="ignore"):
        s, t = _cross(apart, second[:, None, :]) / across, _cross(apart, first[:, :, None]) / across
        crosses = np.minimum(np.minimum(s, 1.0 - s), np.minimum(t, 1.0 - t)) > 0.0
    s = np.where(crosses, s, 0.0)
    crossing = np.where(crosses[..., None], polygon_a[:, :, None] + s[..., None] * first[:, :, None], 0.0)
    of_one = _cross(second[:, None, :], -apart).min(axis=2) >= 0.0
    of_two = _cross(first[:, :, None], apart).min(axis=1) >= 0.0
    total = (
        crossing.sum(axis=(1, 2))
        + (polygon_a * of_one[..., None]).sum(axis=1)
        + (polygon_b * of_two[..., None]).sum(axis=1)
    )
    number = crosses.sum(axis=(1, 2)) + of_one.sum(axis=1) + of_two.sum(axis=1)
    return total / np.maximum(number, 1)[:, None], number > 0


def _cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Of vectors (..., 2)."""
    return np.asarray(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0])


def _sorted(far: list[int], near: list[int], depth: list[float]) -> list[int]:
    """All numbers of depth: far[i] before near[i], and else by depth."""
    after: list[list[int]] = [[] for _ in depth]
    before: list[list[int]] = [[] for _ in depth]
    for a, b in zip(far, near, strict=True):
        after[a].append(b)
        before[b].append(a)
    waiting = [len(others) for others in before]
    ready = [(d, i) for i, d in enumerate(depth) if waiting[i] == 0]
    heapq.heapify(ready)
    drawn: dict[int, None] = {}
    farthest, at = np.argsort(depth, kind="stable").tolist(), 0
    while len(drawn) < len(depth):
        if not ready:
            while farthest[at] in drawn:
                at += 1
            ready = [(0.0, min(_ring(farthest[at], before, drawn), key=depth.__getitem__))]
        _, chosen = heapq.heappop(ready)
        if chosen in drawn:
            continue
        drawn[chosen] = None
        for i in after[chosen]:
            waiting[i] -= 1
            if waiting[i] == 0:
                heapq.heappush(ready, (depth[i], i))
    return list(drawn)


def _ring(start: int, before: list[list[int]], drawn: dict[int, None]) -> list[int]:
    """Numbers that wait for one another in a ring, reached from one that waits."""
    place: dict[int, int] = {}
    here = start
    while here not in place:
        place[here] = len(place)
        here = next(i for i in before[here] if i not in drawn)
    return list(place)[place[here] :]

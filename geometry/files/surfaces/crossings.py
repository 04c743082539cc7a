"""Triangles of one surface that cut through each other where they should not."""

from collections.abc import Iterator

import numpy as np

from geometry.polyhedra.box_pairs import overlapping_boxes

MOST_PAIRS = 5_000_000
"""Of triangles whose boxes meet, looked at in one go."""


def crossing(points: np.ndarray, triangle: np.ndarray, width: float) -> np.ndarray | None:
    """(3,) a place where an edge of a triangle (T, 3) goes through another one by more than width, or None."""
    body = np.zeros(len(triangle), dtype=np.int64)
    return next((place for _, place in crossings(points, triangle, body, np.array([width]))), None)


def crossings(
    points: np.ndarray, triangle: np.ndarray, body: np.ndarray, width: np.ndarray
) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Bodies (n,) with a triangle (T, 3) that an edge of the same body (T,) goes through by more than its width (B,),
    and the first place (3,); in several parts.
    """
    corner = points[triangle]
    body_coordinate = body[:, None].astype(float)  # as a fourth coordinate it keeps bodies apart
    boxes = (np.concatenate([ends, body_coordinate], axis=1) for ends in (corner.min(axis=1), corner.max(axis=1)))
    pairs = overlapping_boxes(*boxes)
    shared = (triangle[pairs[:, 0]][:, :, None] == triangle[pairs[:, 1]][:, None, :]).any(axis=(1, 2))
    pairs = pairs[~shared]
    for begin in range(0, len(pairs), MOST_PAIRS):
        first, second = pairs[begin : begin + MOST_PAIRS].T
        for edges, face in ((first, second), (second, first)):
            for k in range(3):
                start, end = corner[edges, k], corner[edges, (k + 1) % 3]
                place, through = _through(start, end, corner[face], width[body[edges]])
                if through.any():
                    yield np.unique(body[edges[through]]), place[np.argmax(through)]


def _through(start: np.ndarray, end: np.ndarray, face: np.ndarray, width: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Where edges (N, 3) meet the planes of triangles (N, 3, 3), and whether they go through these by width (N,)."""
    normal = np.cross(face[:, 1] - face[:, 0], face[:, 2] - face[:, 0])
    size = np.linalg.norm(normal, axis=1)
    normal /= np.where(size > 0, size, 1.0)[:, None]
    before = np.einsum("ni,ni->n", start - face[:, 0], normal)
    after = np.einsum("ni,ni->n", end - face[:, 0], normal)
    meets = (before * after < 0) & (np.minimum(np.abs(before), np.abs(after)) > width)
    fraction = np.divide(before, before - after, out=np.zeros_like(before), where=meets)
    place = start + fraction[:, None] * (end - start)
    inside = meets
    for k in range(3):
        edge = face[:, (k + 1) % 3] - face[:, k]
        inward = np.cross(normal, edge)
        inside = inside & (np.einsum("ni,ni->n", place - face[:, k], inward) > width * np.linalg.norm(edge, axis=1))
    return place, inside

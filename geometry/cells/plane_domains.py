"""Convex polygons to be divided, and the joints between them: walls of neighbours that lie on one line."""

from collections.abc import Sequence

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from geometry.cells.plane_energy import Domains

CLOSE = 1e-7
"""Distances below this share of h count as none."""


def plane_domains(polygons: Sequence[np.ndarray], counts: np.ndarray, h: float) -> Domains:
    """Polygons (k, 2) m, convex and counter-clockwise, as Domains in units of h (m), with counts (U,) cells."""
    corner = np.concatenate(polygons) / h
    after = np.concatenate([np.roll(p, -1, axis=0) for p in polygons]) / h
    along = (after - corner) / np.linalg.norm(after - corner, axis=1)[:, None]
    normal = np.stack([along[:, 1], -along[:, 0]], axis=1)
    wall_start = np.concatenate([[0], np.cumsum([len(p) for p in polygons])])
    line = _lines(corner, after, normal)
    backwards = (along[:, 0] < -1e-9) | ((np.abs(along[:, 0]) <= 1e-9) & (along[:, 1] < 0))
    return Domains(
        cell_start=np.concatenate([[0], np.cumsum(counts)]),
        wall_start=wall_start,
        corner=corner,
        normal=normal,
        offset=np.einsum("wi,wi->w", normal, corner),
        line=line,
        along=np.where(backwards[:, None], -along, along),
    )


def _lines(start: np.ndarray, end: np.ndarray, normal: np.ndarray) -> np.ndarray:
    """(W,) number of the joint of each wall: walls that face each other on one line and overlap; -1 for the others."""
    count = len(start)
    links = [np.zeros((0, 2), dtype=np.int64)]
    for w in range(count):
        opposite = np.flatnonzero(normal @ normal[w] < -1 + 1e-12)
        level = np.abs((start[opposite] - start[w]) @ normal[w])
        opposite = opposite[level < CLOSE]
        direction = end[w] - start[w]
        direction = direction / np.linalg.norm(direction)
        ends = np.stack([(start[opposite] - start[w]) @ direction, (end[opposite] - start[w]) @ direction], axis=1)
        shared = np.minimum(ends.max(axis=1), (end[w] - start[w]) @ direction) - np.maximum(ends.min(axis=1), 0.0)
        links.append(np.stack([np.full(len(opposite), w), opposite], axis=1)[shared > CLOSE])
    pairs = np.concatenate(links)
    graph = coo_array((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(count, count))
    line = connected_components(graph, directed=False)[1].astype(np.int64)
    alone = np.ones(count, dtype=bool)
    alone[pairs] = False
    return np.where(alone, -1, line)

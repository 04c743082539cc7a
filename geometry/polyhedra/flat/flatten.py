"""Surfaces whose faces are flat but for noise, as single precision leaves it, made flat to the last digits."""

import numpy as np

from geometry.polyhedra.flat.meeting import meet
from geometry.polyhedra.flat.regions import Mesh, flat_regions
from geometry.polyhedra.polygons import areas_normals_centroids

EXACT = 2e-10
"""Of the longest side: regions that are off their planes by less stay as they are."""
NEAR = 1e-13
"""Of the longest side: how near corners come to the planes of their faces."""
FARTHEST = 3.0
"""Times what counts as flat that a corner may move: along an edge between faces at a flat angle it moves more."""
TURNED = 0.9
"""Cosine of the angle by which a triangle of a face may turn as its corners move; slivers may turn any way."""


def flattened(mesh: Mesh, flat: float) -> tuple[np.ndarray, np.ndarray]:
    """Points (P, 3) and regions (T,) of triangles: those of one region lie in one plane.

    flat (m)  how far a corner of a face may stand off its plane
    A region whose corners cannot all lie in one plane without moving far comes apart into its triangles.
    """
    size = float(np.ptp(mesh.points, axis=0).max())
    region = flat_regions(mesh, flat)
    while True:
        corner, plane, owner = _incidence(mesh.triangle, region)
        points, off = meet(mesh.points, corner, plane, NEAR * size, EXACT * size)
        wrong = np.zeros(int(region.max()) + 1, dtype=bool)
        wrong[owner] = off > EXACT * size
        wrong |= _spoilt(mesh, points, region, flat)
        if not wrong.any():
            return points, region
        apart = wrong[region]
        region = np.unique(np.where(apart, len(region) + np.arange(len(region)), region), return_inverse=True)[1]
        region = region.reshape(-1)


def _incidence(triangle: np.ndarray, region: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Corners and planes (N,) that they lie in, of regions of several triangles, and the region of each plane."""
    several = np.bincount(region) > 1
    chosen = several[region]
    pair = np.unique(np.stack([np.repeat(region[chosen], 3), triangle[chosen].ravel()], axis=1), axis=0)
    owner, plane = np.unique(pair[:, 0], return_inverse=True)
    return pair[:, 1], plane.reshape(-1), owner


def _spoilt(mesh: Mesh, points: np.ndarray, region: np.ndarray, flat: float) -> np.ndarray:
    """(K,) regions with a corner that moved too far, or next to a triangle that its corners turned over."""
    moved = np.linalg.norm(points - mesh.points, axis=1)
    far = moved > FARTHEST * flat
    before, after = mesh.points[mesh.triangle], points[mesh.triangle]
    area, normal, _ = areas_normals_centroids(before)
    _, turned, _ = areas_normals_centroids(after)
    longest = np.linalg.norm(np.roll(before, -1, axis=1) - before, axis=2).max(axis=1)
    broad = 2 * area > 4 * moved[mesh.triangle].max(axis=1) * longest
    far[mesh.triangle[broad & (np.einsum("ti,ti->t", normal, turned) < TURNED)]] = True
    wrong = np.zeros(int(region.max()) + 1, dtype=bool)
    wrong[region[far[mesh.triangle].any(axis=1)]] = True
    return wrong & (np.bincount(region) > 1)

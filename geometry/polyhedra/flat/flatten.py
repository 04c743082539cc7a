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


def flattened(mesh: Mesh, flat: np.ndarray) -> Mesh:
    """The same surfaces with points moved so that all triangles of a face lie in one plane; faces as large as can be.

    flat (B,) m  how far a corner of a face of each body may stand off its plane
    A face whose corners cannot all lie in one plane without moving far comes apart into its triangles.
    """
    size = mesh.sizes(len(flat))
    region, points = flat_regions(mesh, flat), mesh.points.copy()
    remaining = np.ones(len(flat), dtype=bool)  # bodies with regions that are not flat yet
    while remaining.any():
        mine = remaining[mesh.body]
        wrong = np.zeros(int(region.max()) + 1, dtype=bool)
        corner, plane, owner = _incidence(mesh.triangle[mine], region[mine])
        of_region = np.zeros(len(wrong), dtype=np.int64)
        of_region[region] = mesh.body
        body = of_region[owner]
        moved, error = meet(mesh.points, corner, plane, NEAR * size[body], EXACT * size[body], body)
        points[mesh.triangle[mine]] = moved[mesh.triangle[mine]]
        wrong[owner] = error > EXACT * size[body]
        wrong |= _spoilt(mesh, points, region, flat) & remaining[of_region]
        apart = wrong[region]
        remaining[:] = False
        remaining[mesh.body[apart]] = True
        region = np.unique(np.where(apart, len(region) + np.arange(len(region)), region), return_inverse=True)[1]
        region = region.reshape(-1)
    return mesh._replace(points=points, face=region)


def _incidence(triangle: np.ndarray, region: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Corners and planes (N,) that they lie in, of regions of several triangles, and the region of each plane."""
    several = np.bincount(region) > 1
    chosen = several[region]
    stride = int(triangle.max(initial=0)) + 1
    pair = np.unique(np.repeat(region[chosen], 3) * stride + triangle[chosen].ravel())
    owner, plane = np.unique(pair // stride, return_inverse=True)
    return pair % stride, plane.reshape(-1), owner


def _spoilt(mesh: Mesh, points: np.ndarray, region: np.ndarray, flat: np.ndarray) -> np.ndarray:
    """(K,) regions with a corner that moved too far, or next to a triangle that its corners turned over."""
    moved = np.linalg.norm(points - mesh.points, axis=1)
    limit = np.full(len(points), np.inf)
    limit[mesh.triangle] = FARTHEST * flat[mesh.body][:, None]
    far = moved > limit
    before, after = mesh.points[mesh.triangle], points[mesh.triangle]
    area, normal, _ = areas_normals_centroids(before)
    _, turned, _ = areas_normals_centroids(after)
    longest = np.linalg.norm(np.roll(before, -1, axis=1) - before, axis=2).max(axis=1)
    broad = 2 * area > 4 * moved[mesh.triangle].max(axis=1) * longest
    far[mesh.triangle[broad & (np.einsum("ti,ti->t", normal, turned) < TURNED)]] = True
    wrong = np.zeros(int(region.max()) + 1, dtype=bool)
    wrong[region[far[mesh.triangle].any(axis=1)]] = True
    return wrong & (np.bincount(region) > 1)

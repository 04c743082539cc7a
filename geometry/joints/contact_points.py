"""Contact points on flat convex faces: where a joint is felt, and the area that each point stands for.

The areas of a polygon's points add up to its area, and all rules integrate linear fields exactly.
"""

import numpy as np

from geometry.joints.fan_points import fan_points
from geometry.joints.point_density import Density, edge_rule
from geometry.polyhedra.polygons import areas_normals_centroids

Points = tuple[np.ndarray, np.ndarray, np.ndarray]


def contact_points(corners: np.ndarray, count: np.ndarray, density: Density) -> Points:
    """Polygon (C,), point (C, 3) m and area (C,) m2 for padded polygons (N, K, 3) with count (N,) corners.

    Parallelograms: m x n points, "gauss" at the Gauss-Legendre places of both edges, "vertex" at those of Gauss and
    Lobatto, from end to end. Other polygons are split into triangles round their centroid, and these into smaller ones:
    "gauss" has points within each, "vertex" on their corners and in their middles. From two points of "gauss" along an
    edge on, and three of "vertex", second moments are exact.
    """
    regular = _parallelograms(corners, count)
    even, odd = np.flatnonzero(regular), np.flatnonzero(~regular)
    parts = [fan_points(corners, count, odd, density)]
    numbers = density.of_parallelograms(corners[even, :4]) if len(even) else np.zeros((0, 2), dtype=np.int64)
    for along, across in np.unique(numbers, axis=0).tolist():
        chosen = even[(numbers[:, 0] == along) & (numbers[:, 1] == across)]
        parts.append(_tensor(corners, chosen, edge_rule(density.rule, along), edge_rule(density.rule, across)))
    polygon, point, area = (np.concatenate(arrays) for arrays in zip(*parts, strict=True))
    order = np.argsort(polygon, kind="stable")
    return polygon[order], point[order], area[order]


def _parallelograms(corners: np.ndarray, count: np.ndarray) -> np.ndarray:
    if corners.shape[1] < 4:
        return np.zeros(len(count), dtype=bool)
    gap = np.linalg.norm(corners[:, 0] - corners[:, 1] + corners[:, 2] - corners[:, 3], axis=1)
    size = np.ptp(corners, axis=1).max(axis=1)
    rounding = 8 * np.finfo(float).eps * np.abs(corners).max(axis=(1, 2))
    return (count == 4) & (gap <= 1e-12 * size + rounding)


def _tensor(
    corners: np.ndarray, which: np.ndarray, along: tuple[np.ndarray, ...], across: tuple[np.ndarray, ...]
) -> Points:
    """Places and weights along both edges multiplied; the product of weights shares out the area."""
    s, t = (grid.ravel()[:, None] for grid in np.meshgrid(along[0], across[0], indexing="ij"))
    area = areas_normals_centroids(corners[which])[0]
    origin, first, _, last = np.split(corners[which][:, :4], 4, axis=1)
    point = origin + s * (first - origin) + t * (last - origin)
    weight = np.outer(along[1], across[1]).ravel()
    return np.repeat(which, len(s)), point.reshape(-1, 3), np.outer(area, weight).ravel()

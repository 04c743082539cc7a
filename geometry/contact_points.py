"""Contact points on flat convex faces: where a joint is felt, and the area that each point stands for.

The areas of a polygon's points add up to its area, and both rules integrate linear fields exactly.
"""

import numpy as np

from geometry.blocks import GeometryError
from geometry.polygons import areas_normals_centroids
from geometry.ragged import ranges

Points = tuple[np.ndarray, np.ndarray, np.ndarray]


def contact_points(corners: np.ndarray, count: np.ndarray, rule: str, points_per_edge: int) -> Points:
    """Polygon (C,), point (C, 3) m and area (C,) m2 for padded polygons (N, K, 3) with count (N,) corners.

    Parallelograms: n x n points, "gauss" at the Gauss-Legendre places of both edges, "vertex" at equal steps from end
    to end with trapezoid weights. Other polygons, split into triangles round their centroid: "gauss" three points in
    each triangle (exact to degree 2), "vertex" their corners alone.
    """
    place, weight = edge_rule(rule, points_per_edge)
    regular = _parallelograms(corners, count)
    even, odd = np.flatnonzero(regular), np.flatnonzero(~regular)
    on_fan = _inside_triangles if rule == "gauss" else _on_corners
    parts = [_tensor(corners, even, place, weight), on_fan(corners, count, odd)]
    polygon, point, area = (np.concatenate(arrays) for arrays in zip(*parts, strict=True))
    order = np.argsort(polygon, kind="stable")
    return polygon[order], point[order], area[order]


def edge_rule(rule: str, points_per_edge: int) -> tuple[np.ndarray, np.ndarray]:
    """Places in [0, 1] along an edge and their weights, which add up to 1; GeometryError for an unknown rule."""
    if rule not in ("gauss", "vertex"):
        raise GeometryError(f"contact points: rule {rule!r} is unknown; allowed: 'gauss', 'vertex'")
    least = 1 if rule == "gauss" else 2
    if points_per_edge != int(points_per_edge) or points_per_edge < least:
        raise GeometryError(
            f"contact points: points_per_edge is {points_per_edge:g}, rule {rule!r} needs a whole number of at least "
            f"{least}; nearest: {max(least, round(points_per_edge))}"
        )
    if rule == "gauss":
        place, weight = np.polynomial.legendre.leggauss(int(points_per_edge))
        return (place + 1) / 2, weight / 2
    place = np.linspace(0.0, 1.0, int(points_per_edge))
    weight = np.full(len(place), 1.0 / (len(place) - 1))
    weight[[0, -1]] /= 2
    return place, weight


def _parallelograms(corners: np.ndarray, count: np.ndarray) -> np.ndarray:
    if corners.shape[1] < 4:
        return np.zeros(len(count), dtype=bool)
    gap = np.linalg.norm(corners[:, 0] - corners[:, 1] + corners[:, 2] - corners[:, 3], axis=1)
    size = np.ptp(corners, axis=1).max(axis=1)
    rounding = 8 * np.finfo(float).eps * np.abs(corners).max(axis=(1, 2))
    return (count == 4) & (gap <= 1e-12 * size + rounding)


def _tensor(corners: np.ndarray, which: np.ndarray, place: np.ndarray, weight: np.ndarray) -> Points:
    s, t = (grid.ravel()[:, None] for grid in np.meshgrid(place, place, indexing="ij"))
    area = areas_normals_centroids(corners[which])[0]
    origin, along, _, across = np.split(corners[which][:, :4], 4, axis=1) if len(which) else (np.zeros((0, 1, 3)),) * 4
    point = origin + s * (along - origin) + t * (across - origin)
    return np.repeat(which, len(s)), point.reshape(-1, 3), np.outer(area, np.outer(weight, weight)).ravel()


def _fan(corners: np.ndarray, count: np.ndarray, which: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Triangles from the centroid to each edge: polygon (T,), three corners (T, 3, 3), area (T,)."""
    owner, k = ranges(np.zeros(len(which), dtype=np.int64), count[which])
    polygon = which[owner]
    _, normal, centroid = areas_normals_centroids(corners)
    start, end = corners[polygon, k], corners[polygon, (k + 1) % count[polygon]]
    middle = centroid[polygon]
    area = np.einsum("ti,ti->t", np.cross(start - middle, end - middle), normal[polygon]) / 2
    return polygon, np.stack([middle, start, end], axis=1), area


def _inside_triangles(corners: np.ndarray, count: np.ndarray, which: np.ndarray) -> Points:
    polygon, triangle, area = _fan(corners, count, which)
    share = np.array([[4.0, 1.0, 1.0], [1.0, 4.0, 1.0], [1.0, 1.0, 4.0]]) / 6
    return np.repeat(polygon, 3), np.einsum("pc,tci->tpi", share, triangle).reshape(-1, 3), np.repeat(area / 3, 3)


def _on_corners(corners: np.ndarray, count: np.ndarray, which: np.ndarray) -> Points:
    """Each corner stands for half of the two triangles beside it.

    The centroid's own third of the fan is a weighted mean of the corners with just these weights, so handing it out in
    this proportion leaves linear fields exact.
    """
    polygon, triangle, area = _fan(corners, count, which)
    first = np.cumsum(count[which]) - count[which]
    previous = np.arange(len(polygon)) - 1
    previous[first] += count[which]
    return polygon, triangle[:, 1], (area + area[previous]) / 2

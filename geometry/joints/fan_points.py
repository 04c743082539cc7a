"""Contact points in convex polygons that are no parallelograms, by the triangles between centroid and edges."""

from dataclasses import dataclass

import numpy as np

from geometry.joints.point_density import Density
from geometry.polyhedra.indexing import ranges
from geometry.polyhedra.polygons import areas_normals_centroids

Points = tuple[np.ndarray, np.ndarray, np.ndarray]


@dataclass(frozen=True)
class Triangles:
    """Triangles from the centroid to each edge, polygon by polygon.

    polygon (T,), edge (T,) number of the edge, corners (T, 3, 3) with the centroid first, area (T,)
    """

    polygon: np.ndarray
    edge: np.ndarray
    corners: np.ndarray
    area: np.ndarray

    def select(self, mask: np.ndarray) -> "Triangles":
        return Triangles(self.polygon[mask], self.edge[mask], self.corners[mask], self.area[mask])


def fan_points(corners: np.ndarray, count: np.ndarray, which: np.ndarray, density: Density) -> Points:
    """Polygon, point and area, as in contact_points, for the polygons `which` of the padded (N, K, 3)."""
    if len(which) == 0:
        return which, np.zeros((0, 3)), np.zeros(0)
    corners, count = corners[which], count[which]
    _, normal, centroid = areas_normals_centroids(corners)
    fan = _triangles(corners, count, normal, centroid)
    side = np.linalg.norm(np.roll(fan.corners, -1, axis=1) - fan.corners, axis=2).max(axis=1, initial=0.0)
    longest = np.zeros(len(which))
    np.maximum.at(longest, fan.polygon, side)
    wanted = density.of_fans(count, normal, longest)
    parts_points = []
    for key in np.unique(np.stack([wanted.sectors, wanted.parts, wanted.inside], axis=1), axis=0).tolist():
        sectors, parts, inside = key
        chosen = (wanted.sectors == sectors) & (wanted.parts == parts) & (wanted.inside == inside)
        mine = fan.select(chosen[fan.polygon])
        if sectors:
            parts_points.append(_in_sectors(mine, sectors))
        elif density.rule == "vertex":
            parts_points.append(_on_lattice(mine, count, parts) if inside else _on_corners(mine, count))
        else:
            parts_points.append(_in_triangles(mine, parts, inside))
    polygon, point, area = (np.concatenate(arrays) for arrays in zip(*parts_points, strict=True))
    return which[polygon], point, area


def _triangles(corners: np.ndarray, count: np.ndarray, normal: np.ndarray, centroid: np.ndarray) -> Triangles:
    polygon, k = ranges(np.zeros(len(count), dtype=np.int64), count)
    start, end, middle = corners[polygon, k], corners[polygon, (k + 1) % count[polygon]], centroid[polygon]
    area = np.einsum("ti,ti->t", np.cross(start - middle, end - middle), normal[polygon]) / 2
    return Triangles(polygon, k, np.stack([middle, start, end], axis=1), area)


def _in_triangles(fan: Triangles, parts: int, inside: int) -> Points:
    """Each triangle cut into parts^2 alike, with one point in the middle of each or three of degree 2."""
    lattice = _small_triangles(parts)
    places = np.eye(3) / 2 + 1 / 6 if inside == 3 else np.full((1, 3), 1 / 3)
    barycentric = np.einsum("pc,scd->spd", places, lattice).reshape(-1, 3)
    point = np.einsum("pd,tdi->tpi", barycentric, fan.corners).reshape(-1, 3)
    return np.repeat(fan.polygon, len(barycentric)), point, np.repeat(fan.area / len(barycentric), len(barycentric))


def _small_triangles(parts: int) -> np.ndarray:
    """(parts^2, 3, 3) barycentric coordinates of the corners of parts^2 equal triangles in one."""
    triples = []
    for i in range(parts):
        for j in range(parts - i):
            a, b, c = (i, j), (i + 1, j), (i, j + 1)
            triples.append((a, b, c))
            if i + j < parts - 1:
                triples.append((b, (i + 1, j + 1), c))
    pair = np.array(triples, dtype=float) / parts
    return np.concatenate([1 - pair.sum(axis=2, keepdims=True), pair], axis=2)


def _in_sectors(fan: Triangles, sectors: int) -> Points:
    """The fan cut into sectors of equal area, round the centroid from the first corner, and a point in each.

    Cuts fall at whole shares of the area along the outline; with the corners they part it into pieces of one edge and
    one sector each.
    """
    total = np.bincount(fan.polygon, fan.area)[fan.polygon]
    first = np.flatnonzero(fan.edge == 0)
    behind = np.cumsum(fan.area) - fan.area
    begin = (behind - behind[first].repeat(np.diff([*first, len(behind)]))) / total
    fraction = fan.area / total
    low = np.floor(begin * sectors + 1e-9).astype(np.int64)
    high = np.minimum(np.ceil((begin + fraction) * sectors - 1e-9).astype(np.int64), sectors)
    triangle, sector = ranges(low, np.maximum(high - low, 1))
    sector = np.minimum(sector, sectors - 1)
    part = np.stack([sector, sector + 1]) / sectors
    part = np.clip((part - begin[triangle]) / fraction[triangle], 0.0, 1.0)
    part[0, sector == low[triangle]] = 0.0
    part[1, np.append(triangle[1:] != triangle[:-1], True)] = 1.0
    middle, start, end = (fan.corners[triangle, k] for k in range(3))
    piece = (part[1] - part[0]) * fan.area[triangle]
    mean = part.mean(axis=0)[:, None]
    moment = piece[:, None] * (middle + 2 * (start + mean * (end - start))) / 3
    key, place = np.unique(fan.polygon[triangle] * sectors + sector, return_inverse=True)
    area = np.bincount(place, piece)
    point = np.stack([np.bincount(place, moment[:, i]) for i in range(3)], axis=1) / area[:, None]
    return key // sectors, point, area


def _on_corners(fan: Triangles, count: np.ndarray) -> Points:
    """Each corner stands for half of the two triangles beside it.

    The centroid's own third of the fan is a weighted mean of the corners with just these weights, so handing it out in
    this proportion leaves linear fields exact.
    """
    previous = np.arange(len(fan.polygon)) - 1
    first = fan.edge == 0
    previous[first] += count[fan.polygon[first]]
    return fan.polygon, fan.corners[:, 1], (fan.area + fan.area[previous]) / 2


def _on_lattice(fan: Triangles, count: np.ndarray, parts: int) -> Points:
    """Each small triangle has a twelfth of its area at each of its corners, once in a polygon, and the rest in its
    middle, which is exact to degree 2."""
    small = _small_triangles(parts)
    corner = np.round(small * parts).astype(np.int64).reshape(-1, 3)
    place, times = np.unique(corner, axis=0, return_counts=True)
    ring, along = place[:, 1] + place[:, 2], place[:, 2]
    triangle, k = (grid.ravel() for grid in np.indices((len(fan.polygon), len(place))))
    polygon = fan.polygon[triangle]
    step = (fan.edge[triangle] * ring[k] + along[k]) % np.maximum(count[polygon] * ring[k], 1)
    width = int(count.max()) * parts + 1
    key = (polygon * (parts + 1) + ring[k]) * width + step
    _, first, number = np.unique(key, return_index=True, return_inverse=True)
    area = np.bincount(number, fan.area[triangle] * times[k] / (12 * parts**2))
    point = np.einsum("nd,ndi->ni", place[k[first]] / parts, fan.corners[triangle[first]])
    middles = np.einsum("pd,tdi->tpi", small.mean(axis=1), fan.corners).reshape(-1, 3)
    inside = np.repeat(fan.area * 0.75 / parts**2, len(small))
    polygons = np.concatenate([polygon[first], np.repeat(fan.polygon, len(small))])
    return polygons, np.concatenate([point, middles]), np.concatenate([area, inside])

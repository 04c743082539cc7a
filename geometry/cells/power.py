"""Power diagrams (Laguerre and Voronoi) of a convex domain in space, exact and watertight.

The cell of site i is where |x - s_i|^2 - w_i is least: the diagram is the boundary, seen from above, of the polyhedron
z >= 2 s_i . x - |s_i|^2 + w_i over the domain. Its polar dual about a point inside is the convex hull of one point for
each site and each wall, which Qhull finds; a facet of the hull is a vertex of the diagram. Walls are planes like all
others here: no mirrored sites, no clipping, and sites may lie outside the domain. Vertices are then solved for again
from their four generators in coordinates near them, and those that are one (regular lattices, domain edges) are welded.
"""

from dataclasses import dataclass

import numpy as np
from scipy.spatial import ConvexHull

from geometry.blocks import GeometryError
from geometry.cells.domain import Domain
from geometry.polyhedra.weld import weld

WELD = 5e-10
"""Vertices closer than this share of h are one; h is the cube root of the mean volume."""
PAIRS = np.array([[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]])


@dataclass(frozen=True)
class Power:
    """A power diagram of n cells; neighbours share faces, and faces share vertices.

    vertices     (V, 3) m
    face_start   (F + 1,) where the loop of each face begins in face_points
    face_points  indices into vertices, counter-clockwise seen from the far side of cell
    cell         (F,) the cell that the face bounds
    other        (F,) the cell beyond, greater than cell, or ~wall of the domain
    cell_start   (n + 1,) where the faces of each cell begin in cell_faces; an empty cell has none
    cell_faces   face numbers, ascending
    """

    vertices: np.ndarray
    face_start: np.ndarray
    face_points: np.ndarray
    cell: np.ndarray
    other: np.ndarray
    cell_start: np.ndarray
    cell_faces: np.ndarray

    @property
    def count(self) -> int:
        return len(self.cell_start) - 1


def tessellate(sites: np.ndarray, weights: np.ndarray, domain: Domain) -> Power:
    """The power diagram of sites (n, 3) m with weights (n,) m2 in a convex domain.

    Raises GeometryError for sites that are not finite, or none at all.
    """
    sites, weights = np.asarray(sites, dtype=float), np.asarray(weights, dtype=float)
    n = len(sites)
    if n == 0 or not (np.all(np.isfinite(sites)) and np.all(np.isfinite(weights))):
        raise GeometryError("cells: a division needs at least one site, and all sites and weights must be finite")
    h = (domain.volume / n) ** (1 / 3)
    scaled, site, weight = domain.scaled(h), (sites - domain.centre) / h, (weights - weights.mean()) / h**2
    simplices, rough = _dual_hull(site, weight, scaled)
    place, quality = _solve(simplices, rough, site, weight, scaled)
    first, number = weld(place, WELD, quality)
    vertices = _on_walls(domain.centre + h * place[first], simplices, number, n, domain)
    face_start, face_points, cell, other = _faces(simplices, number, place[first], site, scaled)
    cell_start, cell_faces = _faces_of_cells(cell, other, n)
    return Power(vertices, face_start, face_points, cell, other, cell_start, cell_faces)


def _dual_hull(site: np.ndarray, weight: np.ndarray, domain: Domain) -> tuple[np.ndarray, np.ndarray]:
    """(f, 4) generators of each vertex, ascending, a wall w as n + w; and (f, 3) where the vertex about is."""
    n, size = len(site), np.abs(domain.corners).max()
    level = np.einsum("ni,ni->n", site, site) - weight
    above = max(float((2 * site @ corner - level).max()) for corner in domain.corners) + size**2
    planes = np.column_stack([2 * site * size, np.full(n, -(size**2))]) / (above + level)[:, None]
    walls = np.column_stack([domain.normal, np.zeros(len(domain.normal))]) * (size / domain.offset)[:, None]
    hull = ConvexHull(np.concatenate([planes, walls, [[0.0, 0.0, 0.0, 1.0]]]))
    simplices = np.sort(hull.simplices, axis=1).astype(np.int64)
    below = (simplices[:, 3] < n + len(walls)) & (simplices[:, 0] < n)
    rough = -size * hull.equations[below, :3] / hull.equations[below, 4:]
    return simplices[below], rough


def _solve(
    simplices: np.ndarray, rough: np.ndarray, site: np.ndarray, weight: np.ndarray, domain: Domain
) -> tuple[np.ndarray, np.ndarray]:
    """(f, 3) vertices, and (f,) how well their three planes cut: the volume spanned by their unit normals."""
    n, first = len(site), simplices[:, 0]
    normal, level = np.empty((len(first), 3, 3)), np.empty((len(first), 3))
    for k in range(3):
        other = simplices[:, k + 1]
        wall, towards = other >= n, np.minimum(other, n - 1)
        direction = site[towards] - site[first]
        distance = np.linalg.norm(direction, axis=1)
        with np.errstate(divide="ignore", invalid="ignore"):
            half = (distance**2 + weight[first] - weight[towards]) / (2 * distance)
            direction = direction / distance[:, None]
        outward = domain.normal[np.where(wall, other - n, 0)]
        wall_level = domain.offset[np.where(wall, other - n, 0)] - np.einsum("fi,fi->f", outward, site[first])
        normal[:, k] = np.where(wall[:, None], outward, direction)
        level[:, k] = np.where(wall, wall_level, half)
    quality = np.abs(np.linalg.det(normal))
    sound = np.isfinite(quality) & (quality > 1e-7)
    place = rough.copy()
    place[sound] = site[first[sound]] + np.linalg.solve(normal[sound], level[sound][:, :, None])[:, :, 0]
    return place, np.where(sound, quality, 0.0)


def _on_walls(vertices: np.ndarray, simplices: np.ndarray, number: np.ndarray, n: int, domain: Domain) -> np.ndarray:
    """The vertices (V, 3) m moved on to their walls; on walls across an axis they then lie exactly."""
    for k in range(1, 4):
        on = np.flatnonzero(simplices[:, k] >= n)
        vertex, wall = number[on], simplices[on, k] - n
        normal = domain.normal[wall]
        lack = domain.offset[wall] - np.einsum("vi,vi->v", normal, vertices[vertex])
        axis = np.argmax(np.abs(normal), axis=1)
        straight = np.abs(normal[np.arange(len(on)), axis]) == 1.0
        vertices[vertex[~straight]] += (lack[:, None] * normal)[~straight]
        vertices[vertex[straight], axis[straight]] = (domain.offset[wall] * normal[np.arange(len(on)), axis])[straight]
    return vertices


def _faces(
    simplices: np.ndarray, number: np.ndarray, place: np.ndarray, site: np.ndarray, domain: Domain
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """face_start, face_points, cell and other of Power: a face is what all vertices of two generators span."""
    n, everything = len(site), len(site) + len(domain.normal)
    pairs = simplices[:, PAIRS].reshape(-1, 2)
    vertex = np.repeat(number, len(PAIRS))
    real = pairs[:, 0] < n
    key, vertex = (pairs[:, 0] * everything + pairs[:, 1])[real], vertex[real]
    order = np.lexsort((vertex, key))
    key, vertex = key[order], vertex[order]
    fresh = np.concatenate([[True], (np.diff(key) != 0) | (np.diff(vertex) != 0)])
    key, vertex = key[fresh], vertex[fresh]
    names, face, corners = np.unique(key, return_inverse=True, return_counts=True)
    is_face = corners >= 3
    vertex, face = vertex[is_face[face]], (np.cumsum(is_face) - 1)[face[is_face[face]]]
    names, corners = names[is_face], corners[is_face]
    cell, neighbour = names // everything, names % everything
    wall = neighbour >= n
    outward = np.where(
        wall[:, None], domain.normal[np.where(wall, neighbour - n, 0)], site[np.minimum(neighbour, n - 1)] - site[cell]
    )
    start = np.concatenate([[0], np.cumsum(corners)])
    angle = _angles(place[vertex], face, start, outward)
    return start, vertex[np.lexsort((angle, face))], cell, np.where(wall, ~(neighbour - n), neighbour)


def _angles(place: np.ndarray, face: np.ndarray, start: np.ndarray, outward: np.ndarray) -> np.ndarray:
    """(c,) angle of each corner about the middle of its face, counter-clockwise about outward (F, 3)."""
    middle = np.add.reduceat(place, start[:-1]) / np.diff(start)[:, None]
    spoke = place - middle[face]
    longest = np.einsum("ci,ci->c", spoke, spoke)
    order = np.lexsort((longest, face))
    right = spoke[order[start[1:] - 1]]
    up = np.cross(outward, right)
    along, across = np.einsum("ci,ci->c", spoke, right[face]), np.einsum("ci,ci->c", spoke, up[face])
    scale = np.linalg.norm(right, axis=1) / np.linalg.norm(up, axis=1)
    return np.arctan2(across * scale[face], along)


def _faces_of_cells(cell: np.ndarray, other: np.ndarray, n: int) -> tuple[np.ndarray, np.ndarray]:
    """cell_start and cell_faces of Power."""
    number = np.arange(len(cell))
    owner, face = np.concatenate([cell, other[other >= 0]]), np.concatenate([number, number[other >= 0]])
    order = np.lexsort((face, owner))
    return np.concatenate([[0], np.cumsum(np.bincount(owner, minlength=n))]), face[order]

"""A power diagram as Blocks, and its measures: volumes, edges, how flat its faces are."""

import numpy as np

from geometry.blocks import Blocks, GeometryError
from geometry.cells.power import Power
from geometry.polyhedra.indexing import following


def to_blocks(power: Power, unit: np.ndarray, groups: tuple[str, ...] = ("units",)) -> Blocks:
    """One block a cell, in the order of the sites, all of them of the first group.

    unit  (n,) the unit of each
    Raises GeometryError where a site is left without a cell.
    """
    if np.any(np.diff(power.cell_start) == 0):
        empty = int(np.argmin(np.diff(power.cell_start)))
        raise GeometryError(f"cells: site {empty} has no cell; move it away from its neighbours")
    start, corners = loops_of_cells(power)
    return Blocks(
        points=power.vertices,
        face_start=start,
        face_points=corners,
        block_face_start=power.cell_start,
        unit=np.asarray(unit, dtype=np.int64),
        group=np.zeros(power.count, dtype=np.int64),
        groups=groups,
    )


def loops_of_cells(power: Power) -> tuple[np.ndarray, np.ndarray]:
    """Loops of the faces of all cells in the order of cell_faces, outward: where they begin, and vertex numbers."""
    owner = np.repeat(np.arange(power.count), np.diff(power.cell_start))
    face = power.cell_faces
    length = np.diff(power.face_start)[face]
    start = np.concatenate([[0], np.cumsum(length)])
    step = np.arange(start[-1]) - np.repeat(start[:-1], length)
    backwards = np.repeat(power.other[face] == owner, length)
    ahead = np.repeat(power.face_start[face], length) + step
    behind = np.repeat(power.face_start[face + 1] - 1, length) - step
    return start, power.face_points[np.where(backwards, behind, ahead)]


def edges(power: Power) -> np.ndarray:
    """(E, 2) vertex numbers, ascending, of every edge once."""
    begin, end = power.face_points, power.face_points[following(power.face_start)]
    key = np.unique(np.minimum(begin, end) * len(power.vertices) + np.maximum(begin, end))
    return np.stack([key // len(power.vertices), key % len(power.vertices)], axis=1)


def edge_lengths(power: Power) -> np.ndarray:
    """(E,) m."""
    begin, end = edges(power).T
    return np.asarray(np.linalg.norm(power.vertices[end] - power.vertices[begin], axis=1))


def face_vectors(power: Power) -> np.ndarray:
    """(F, 3) m2, area times the normal out of the cell."""
    origin = power.vertices[power.face_points[power.face_start[:-1]]]
    corner = np.diff(power.face_start)
    a = power.vertices[power.face_points] - np.repeat(origin, corner, axis=0)
    b = power.vertices[power.face_points[following(power.face_start)]] - np.repeat(origin, corner, axis=0)
    return np.asarray(np.add.reduceat(np.cross(a, b), power.face_start[:-1]) / 2)


def cell_volumes(power: Power) -> np.ndarray:
    """(n,) m3."""
    vector, begin = face_vectors(power), power.vertices[power.face_points[power.face_start[:-1]]]
    origin = np.zeros((power.count, 3))
    full = np.diff(power.cell_start) > 0
    origin[full] = begin[power.cell_faces[power.cell_start[:-1][full]]]
    inside = power.other >= 0
    of_cell = np.einsum("fi,fi->f", vector, begin - origin[power.cell]) / 3
    other = power.other[inside]
    of_other = np.einsum("fi,fi->f", vector[inside], begin[inside] - origin[other]) / 3
    return np.bincount(power.cell, of_cell, power.count) - np.bincount(other, of_other, power.count)

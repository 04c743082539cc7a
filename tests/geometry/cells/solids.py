"""Domains that are no boxes, and how far the faces of cells are off their planes."""

import numpy as np
from scipy.spatial import ConvexHull, QhullError

from geometry.blocks import GeometryError
from geometry.cells.domain import Domain
from geometry.cells.power import Power
from geometry.cells.power_blocks import face_vectors


def hull_domain(points: np.ndarray) -> Domain:
    """The convex hull of points (k, 3) m."""
    try:
        equations = ConvexHull(points).equations
    except QhullError:
        raise GeometryError("cells: the points of the domain lie in one plane; it has no volume") from None
    distinct = equations[np.unique(np.round(equations, 9), axis=0, return_index=True)[1]]
    return Domain(distinct[:, :3], -distinct[:, 3])


def bends(power: Power) -> np.ndarray:
    """(F,) m, the farthest that a corner of each face lies from the mean plane of the face."""
    vector = face_vectors(power)
    normal = vector / np.linalg.norm(vector, axis=1)[:, None]
    corners = np.diff(power.face_start)
    place = power.vertices[power.face_points]
    middle = np.add.reduceat(place, power.face_start[:-1]) / corners[:, None]
    off = np.abs(np.einsum("ci,ci->c", place - np.repeat(middle, corners, axis=0), np.repeat(normal, corners, axis=0)))
    return np.asarray(np.maximum.reduceat(off, power.face_start[:-1]))

"""How stiffly a joint face bends by its contact points, beside a stress that is spread over its area."""

import numpy as np

from geometry.blocks import Joints
from geometry.polyhedra.polygons import areas_normals_centroids, pad

FLAT = 1e-9
"""Of the largest second moment of a face: a smaller one is that of points in one row, or across its plane."""
FITS = 1e-6
"""Of the area of a polygon: contact points whose areas add up to another one do not stand for it."""


def lacking_flexibility(joints: Joints) -> np.ndarray:
    """(J, 3, 3) 1/m4: by how much more a face turns, over moment and stiffness, than its contact points let it.

    The inverse of the second moments of area of its polygon, less that of its points; both about their middle. 0 for
    points that bend as the area does, such as four of rule "gauss"; below 0 for points that bend too softly. A face
    with one row of points has no moment across that row.
    """
    index = np.arange(len(joints.patch_points))
    corners = pad(joints.patch_points, joints.patch_start, index)[0]
    area, normal, centroid = areas_normals_centroids(corners)
    of_points, summed = _of_points(joints, len(area))
    fits = (area > 0.0) & (np.abs(summed - area) <= FITS * area)
    lacks = _inverse(_of_polygons(corners, normal, centroid)) - _inverse(of_points)
    return np.asarray(np.where(fits[:, None, None], lacks, 0.0))


def arms(joints: Joints) -> np.ndarray:
    """(C, 3) m, from the middle of the contact points of each face to its points."""
    count = len(joints.patch_start) - 1
    area = np.bincount(joints.patch, joints.area, count)
    sums = [np.bincount(joints.patch, joints.area * along, count) for along in joints.point.T]
    middle = np.stack(sums, axis=1) / np.maximum(area, 1e-300)[:, None]
    return np.asarray(joints.point - middle[joints.patch])


def _of_points(joints: Joints, count: int) -> tuple[np.ndarray, np.ndarray]:
    """(J, 3, 3) m4 and (J,) m2, of the contact points of each face."""
    area, arm = np.bincount(joints.patch, joints.area, count), arms(joints)
    products = [np.bincount(joints.patch, joints.area * a * b, count) for a in arm.T for b in arm.T]
    return np.stack(products, axis=1).reshape(-1, 3, 3), area


def _of_polygons(corners: np.ndarray, normal: np.ndarray, centroid: np.ndarray) -> np.ndarray:
    """(J, 3, 3) m4 of padded polygons (J, K, 3), by triangles from the centroid to each edge."""
    p = corners - centroid[:, None]
    q = np.roll(p, -1, axis=1)
    area = 0.5 * np.einsum("jki,ji->jk", np.cross(p, q), normal)
    parts = [np.einsum("jk,jka,jkb->jab", area, side, side) for side in (p, q, p + q)]
    return np.asarray(sum(parts) / 12.0)


def _inverse(second: np.ndarray) -> np.ndarray:
    return np.asarray(np.linalg.pinv(second, rcond=FLAT, hermitian=True))

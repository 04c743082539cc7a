"""How stiffly a joint face bends and twists by its contact points, beside a stress that is spread over its area."""

from typing import NamedTuple

import numpy as np

from geometry.blocks import Joints
from geometry.joints.faces.whole_faces import FacePoints, points_of_faces
from geometry.polyhedra.polygons import areas_normals_centroids, pad

FLAT = 1e-9
"""Of the largest second moment of a face: a smaller one is that of points in one row, or across its plane."""
FITS = 1e-6
"""Of the area of a polygon: contact points whose areas add up to another one do not stand for it."""
SAME = 1e-9
"""Share of a polar moment: less is round-off."""


class Lacks(NamedTuple):
    """By how much more each face would turn, over moment and stiffness, were a stress spread over its area: (J, 3, 3)
    1/m4, onto moments in its plane and onto the twist about its normal; and the contact points of the faces."""

    bending: np.ndarray
    twist: np.ndarray
    points: FacePoints

    @property
    def any(self) -> bool:
        """Whether contact points of some face bend or twist otherwise than its area does."""
        return bool((self.bending != 0.0).any() or (self.twist != 0.0).any())

    def over(self, normal: np.ndarray, shear: np.ndarray, of: slice | np.ndarray = slice(None)) -> np.ndarray:
        """(J, 3, 3) rad/(N m), of faces, or some of them, with stiffnesses (J,) Pa/m; what has no shear stiffness bears
        no twist."""
        softness = np.divide(1.0, shear, out=np.zeros(len(shear)), where=shear > 0.0)
        return np.asarray(self.bending[of] / normal[:, None, None] + self.twist[of] * softness[:, None, None])

    def moments(self, normal: np.ndarray, pull: np.ndarray, shear: np.ndarray) -> np.ndarray:
        """(J, 3) N m of forces along the normals (C, 3), `pull` (C,) N, and across them, `shear` (C, 3) N: of bending
        towards where each face opens, of twist along its normal."""
        twist = np.einsum("ci,ci->c", normal, np.cross(self.points.arm, shear))
        return self.points.sums(pull[:, None] * self.points.arm + twist[:, None] * normal)


def lacking_flexibility(joints: Joints) -> Lacks:
    """The inverse of the second moments of area of each polygon, and of the polar one, less those of its points; all
    about their middle. 0 for points that turn as the area does, such as four of rule "gauss"; below 0 for points that
    turn too softly. A face with one row of points has no moment across that row, one with a single point no twist.
    """
    index = np.arange(len(joints.patch_points))
    corners = pad(joints.patch_points, joints.patch_start, index)[0]
    area, normal, centroid = areas_normals_centroids(corners)
    points = points_of_faces(joints)
    of_area = of_polygons(corners, normal, centroid)
    area, of_area = _joined(points.whole, area, centroid, of_area)
    fits = ((area > 0.0) & (np.abs(points.area - area) <= FITS * area))[:, None, None]
    bending = _inverse(of_area) - _inverse(points.second)
    polar, about = np.trace(of_area, axis1=1, axis2=2), np.trace(points.second, axis1=1, axis2=2)
    with np.errstate(divide="ignore", invalid="ignore"):
        twist = np.where(about > FLAT * polar, 1.0 / polar - 1.0 / about, 0.0)
    twist[np.abs(twist) * polar <= SAME] = 0.0
    along = normal[:, :, None] * normal[:, None, :]
    return Lacks(np.where(fits, bending, 0.0), np.where(fits, twist[:, None, None] * along, 0.0), points)


def _joined(
    whole: np.ndarray, area: np.ndarray, centroid: np.ndarray, second: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """(J,) m2 and (J, 3, 3) m4 of faces, from those of their polygons, each about its own centroid (J, 3) m."""
    count = len(area)
    if (whole == np.arange(count)).all():
        return area, second
    sums, together = np.zeros((count, 3)), np.zeros((count, 3, 3))
    all_ = np.bincount(whole, area, count)
    np.add.at(sums, whole, area[:, None] * centroid)
    off = centroid - (sums / np.maximum(all_, 1e-300)[:, None])[whole]
    np.add.at(together, whole, second + area[:, None, None] * off[:, :, None] * off[:, None, :])
    return all_, together


def of_polygons(corners: np.ndarray, normal: np.ndarray, centroid: np.ndarray) -> np.ndarray:
    """(J, 3, 3) m4 of padded polygons (J, K, 3), by triangles from the centroid to each edge."""
    p = corners - centroid[:, None]
    q = np.roll(p, -1, axis=1)
    area = 0.5 * np.einsum("jki,ji->jk", np.cross(p, q), normal)
    parts = [np.einsum("jk,jka,jkb->jab", area, side, side) for side in (p, q, p + q)]
    return np.asarray(sum(parts) / 12.0)


def _inverse(second: np.ndarray) -> np.ndarray:
    return np.asarray(np.linalg.pinv(second, rcond=FLAT, hermitian=True))

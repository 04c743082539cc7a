"""How stiffly a joint face bends and twists by its contact points, beside a stress that is spread over its area.

A face that is not convex, such as an L or a ring, is cut into convex polygons: those between the same two blocks that
lie in one plane. It bends and twists as a whole. It has the number of the first of its polygons; the rows of the others
are 0.
"""

from typing import NamedTuple

import numpy as np

from geometry.blocks import Joints
from geometry.polyhedra.polygons import areas_normals_centroids, pad

FLAT = 1e-9
"""Of the largest second moment of a face: a smaller one is that of points in one row, or across its plane."""
FITS = 1e-6
"""Of the area of a polygon: contact points whose areas add up to another one do not stand for it."""
SAME = 1e-9
"""Share of a polar moment: less is round-off."""
SAME_DIRECTION, SAME_PLANE = 1e-5, 1e-6
"""Normals that differ by less are one; places of a plane, over the size of all joints, too."""


class Lacks(NamedTuple):
    """By how much more each face would turn, over moment and stiffness, were a stress spread over its area: (J, 3, 3)
    1/m4, onto moments in its plane and onto the twist about its normal.

    whole  (P,) the first polygon of the face of each polygon
    face   (C,) that of the face of each contact
    arm    (C, 3) m, from the middle of the contact points of its face to each contact
    """

    bending: np.ndarray
    twist: np.ndarray
    whole: np.ndarray
    face: np.ndarray
    arm: np.ndarray

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
        twist = np.einsum("ci,ci->c", normal, np.cross(self.arm, shear))
        each = pull[:, None] * self.arm + twist[:, None] * normal
        return np.stack([np.bincount(self.face, values, len(self.whole)) for values in each.T], axis=1)


def lacking_flexibility(joints: Joints) -> Lacks:
    """The inverse of the second moments of area of each polygon, and of the polar one, less those of its points; all
    about their middle. 0 for points that turn as the area does, such as four of rule "gauss"; below 0 for points that
    turn too softly. A face with one row of points has no moment across that row, one with a single point no twist.
    """
    index = np.arange(len(joints.patch_points))
    corners = pad(joints.patch_points, joints.patch_start, index)[0]
    area, normal, centroid = areas_normals_centroids(corners)
    whole = first_patches(joints)
    face = whole[joints.patch]
    arm = _arms(joints, face, len(area))
    of_points, summed = _of_points(joints, face, arm, len(area))
    of_area = of_polygons(corners, normal, centroid)
    area, of_area = _joined(whole, area, centroid, of_area)
    fits = ((area > 0.0) & (np.abs(summed - area) <= FITS * area))[:, None, None]
    bending = _inverse(of_area) - _inverse(of_points)
    polar, about = np.trace(of_area, axis1=1, axis2=2), np.trace(of_points, axis1=1, axis2=2)
    with np.errstate(divide="ignore", invalid="ignore"):
        twist = np.where(about > FLAT * polar, 1.0 / polar - 1.0 / about, 0.0)
    twist[np.abs(twist) * polar <= SAME] = 0.0
    along = normal[:, :, None] * normal[:, None, :]
    return Lacks(np.where(fits, bending, 0.0), np.where(fits, twist[:, None, None] * along, 0.0), whole, face, arm)


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


def _arms(joints: Joints, face: np.ndarray, count: int) -> np.ndarray:
    """(C, 3) m, from the middle of the contact points of each face to its points."""
    area = np.bincount(face, joints.area, count)
    sums = [np.bincount(face, joints.area * along, count) for along in joints.point.T]
    middle = np.stack(sums, axis=1) / np.maximum(area, 1e-300)[:, None]
    return np.asarray(joints.point - middle[face])


def _of_points(joints: Joints, face: np.ndarray, arm: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray]:
    """(J, 3, 3) m4 and (J,) m2, of the contact points of each face."""
    area = np.bincount(face, joints.area, count)
    products = [np.bincount(face, joints.area * a * b, count) for a in arm.T for b in arm.T]
    return np.stack(products, axis=1).reshape(-1, 3, 3), area


def of_polygons(corners: np.ndarray, normal: np.ndarray, centroid: np.ndarray) -> np.ndarray:
    """(J, 3, 3) m4 of padded polygons (J, K, 3), by triangles from the centroid to each edge."""
    p = corners - centroid[:, None]
    q = np.roll(p, -1, axis=1)
    area = 0.5 * np.einsum("jki,ji->jk", np.cross(p, q), normal)
    parts = [np.einsum("jk,jka,jkb->jab", area, side, side) for side in (p, q, p + q)]
    return np.asarray(sum(parts) / 12.0)


def _inverse(second: np.ndarray) -> np.ndarray:
    return np.asarray(np.linalg.pinv(second, rcond=FLAT, hermitian=True))


def first_patches(joints: Joints) -> np.ndarray:
    """(P,) for each polygon the number of the first one of its joint face: its own number where it is convex."""
    own = np.arange(len(joints.patch_start) - 1)
    patch, contact = np.unique(joints.patch, return_index=True)
    a, b, normal = joints.block_a[contact], joints.block_b[contact], joints.normal[contact]
    _, pair, many = np.unique(np.column_stack([a, b]), axis=0, return_inverse=True, return_counts=True)
    pair = pair.ravel()
    several = np.flatnonzero(many[pair] > 1)
    if not len(several):
        return own
    size = SAME_PLANE * float(np.ptp(joints.patch_points, axis=0).max())
    level = np.einsum("ci,ci->c", normal, joints.point[contact])
    order = several[np.lexsort((level[several], pair[several]))]
    heads: list[int] = []
    for k in order.tolist():  # those of one pair follow each other, from the lowest plane up
        heads = [head for head in heads if pair[head] == pair[k] and level[k] - level[head] <= size]
        alike = [head for head in heads if np.abs(normal[head] - normal[k]).max() <= SAME_DIRECTION]
        if alike:
            own[patch[k]] = patch[alike[0]]
        else:
            heads.append(k)
    return _lowest(own)


def _lowest(head: np.ndarray) -> np.ndarray:
    """The same groups, each named by its lowest member."""
    least = np.arange(len(head))
    np.minimum.at(least, head, np.arange(len(head)))
    return np.asarray(least[head])

"""Joint faces and their contact points: which polygons make one face, where its middle is, how far its points reach.

A face that is not convex, such as an L or a ring, is cut into convex polygons: those between the same two blocks that
lie in one plane. It bends and twists as a whole. It has the number of the first of its polygons; the rows of the others
are 0.
"""

from typing import NamedTuple

import numpy as np

from geometry.blocks import Joints

SAME_DIRECTION, SAME_PLANE = 1e-5, 1e-6
"""Normals that differ by less are one; places of a plane, over the size of all joints, too."""


class FacePoints(NamedTuple):
    """The contact points of the P joint faces, by the numbers of their polygons.

    whole   (P,) the first polygon of the face of each polygon
    face    (C,) that of the face of each contact
    area    (P,) m2, of the contact points
    middle  (P, 3) m, of the contact points
    arm     (C, 3) m, from the middle of its face to each contact
    second  (P, 3, 3) m4, second moments of area of the contact points about their middle
    """

    whole: np.ndarray
    face: np.ndarray
    area: np.ndarray
    middle: np.ndarray
    arm: np.ndarray
    second: np.ndarray

    def sums(self, values: np.ndarray) -> np.ndarray:
        """(P,) or (P, n) of values (C,) or (C, n)."""
        return sums_by_face(self.face, values, len(self.whole))


def points_of_faces(joints: Joints) -> FacePoints:
    """The contact points of all faces."""
    whole = first_patches(joints)
    face = whole[joints.patch]
    area, middle = middles(joints, face, len(whole))
    arm = joints.point - middle[face]
    products = np.stack([joints.area * a * b for a in arm.T for b in arm.T], axis=1)
    second = sums_by_face(face, products, len(whole)).reshape(-1, 3, 3)
    return FacePoints(whole, face, area, middle, arm, second)


def middles(joints: Joints, face: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray]:
    """(J,) m2 and (J, 3) m: area and middle of the contact points of `count` faces, of which each contact has one (C,);
    0 for a face without."""
    area = sums_by_face(face, joints.area, count)
    weighted = sums_by_face(face, joints.area[:, None] * joints.point, count)
    return area, weighted / np.maximum(area, 1e-300)[:, None]


def sums_by_face(face: np.ndarray, values: np.ndarray, count: int) -> np.ndarray:
    """(J,) or (J, n) of values (C,) or (C, n) over the contacts of each of `count` faces."""
    if values.ndim == 1:
        return np.bincount(face, values, count)
    return np.stack([np.bincount(face, column, count) for column in values.T], axis=1)


def polygons_by_face(joints: Joints, whole: np.ndarray, faces: np.ndarray) -> list[list[np.ndarray]]:
    """Corners (K, 3) m of the polygons of each face, which are those with the same first one (P,); faces (J,) are
    numbers of first ones, rising."""
    polygons: dict[int, list[np.ndarray]] = {number: [] for number in faces.tolist()}
    bounds = joints.patch_start.tolist()
    for first, begin, end in zip(whole.tolist(), bounds[:-1], bounds[1:], strict=True):
        if first in polygons:
            polygons[first].append(joints.patch_points[begin:end])
    return list(polygons.values())


def reach_along(arm: np.ndarray, corner: np.ndarray, along: np.ndarray) -> float:
    """How far points (n, 3) m reach from the middle of a face towards the edge about which it turns, over how far its
    corners (K, 3) m do; it opens along directions (D, 3), of which the least counts. Infinite without any."""
    inner, outer = -(arm @ along.T).min(axis=0), -(corner @ along.T).min(axis=0)
    ahead = outer > 0.0
    return float((inner[ahead] / outer[ahead]).min(initial=np.inf))


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

"""Where a joint face bears: at points of a density, at its contact points, or at those of a patch in their place."""

import numpy as np

from geometry.joints.contact_points import contact_points
from geometry.joints.faces.second_moments import of_polygons
from geometry.joints.point_density import Density
from masonry.assembly.assemble import Assembly
from masonry.assembly.contact_pairs import points_along
from masonry.detection.spread import AT_CORNERS, rounds_of
from masonry.estimates.joint_faces import Faces, are_patches

SPREAD = np.array([[1.0, AT_CORNERS], [1.0, 1.0 - AT_CORNERS]])
"""Rounds of patches with points inside, of which the second lies as far inwards as their polar moment asks."""


def points_of(polygons: list[np.ndarray], density: Density) -> tuple[np.ndarray, np.ndarray]:
    """Places (n, 3) m and areas (n,) m2 of contact points of a density on convex polygons (K, 3) m."""
    each = [contact_points(corners[None], np.array([len(corners)]), density)[1:] for corners in polygons]
    point, area = zip(*each, strict=True)
    return np.concatenate(point), np.concatenate(area)


def own_points(assembly: Assembly, faces: Faces, face: int) -> tuple[np.ndarray, np.ndarray]:
    """Places (n, 3) m and areas (n,) m2 at which a face bears: its contact points, or those of the patch in their place
    that has not moved."""
    joints, contacts = assembly.joints, faces.contacts(face)
    meshed = (joints.node_a[contacts] >= 0).any() or (joints.node_b[contacts] >= 0).any()
    if meshed or not are_patches(assembly, faces, face):
        return joints.point[contacts], joints.area[contacts]
    return patch_points(faces, face, _rounds(assembly))


def patch_points(faces: Faces, face: int, rounds: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Places (n, 3) m and areas (n,) m2 of the patch of a face that has not moved, in rounds (m, 2)."""
    normal, parts = faces.normal[face], []
    for corners in faces.polygons[face]:
        point, area = contact_points(corners[None], np.array([len(corners)]), Density("vertex", 2))[1:]
        middle = area @ point / area.sum()
        polar = float(np.trace(of_polygons(corners[None], normal[None], middle[None])[0]))
        parts.append(_of_patch(point, area, middle, polar, rounds))
    places, areas = zip(*parts, strict=True)
    return np.concatenate(places), np.concatenate(areas)


def _rounds(assembly: Assembly) -> np.ndarray:
    """(m, 2) of `rounds_of` for the patches of a scene."""
    if assembly.scene.specimen.patch_points == "spread":
        return SPREAD
    return rounds_of(points_along(assembly.scene, assembly.model.crushes))


def _of_patch(
    corner: np.ndarray, area: np.ndarray, middle: np.ndarray, polar: float, rounds: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Points and areas as `detection/spread.py` puts them from corners (K, 3) m with areas (K,) m2, of a polygon with
    this polar moment (m4)."""
    arm = corner - middle
    share = polar / float(area @ (arm**2).sum(axis=1))
    place, weight = rounds.T
    inside = float(weight[1:] @ place[1:] ** 2)
    if inside > 0.0:
        place = np.append(1.0, place[1:] * min(np.sqrt(max(share - weight[0], 0.0) / inside), 1.0 / place[1]))
    point = middle + place[:, None, None] * arm
    return point.reshape(-1, 3), np.outer(weight, area).ravel()

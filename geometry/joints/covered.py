"""How much of each face lies in joints, whether these lie on faces or half way between them."""

import numpy as np

from geometry.blocks import Blocks, Joints
from geometry.joints.find import patch_faces
from geometry.polyhedra.measures import extent, face_areas_normals_centroids
from geometry.polyhedra.polygons import areas_normals_centroids, clip, pad

ON = 1e-6
"""Of the longest side of the specimen: a joint this near to a face lies on it."""
NEAR = 0.01
"""Of the size of a face: over a gap that is twice as wide the face can be seen, and counts as free."""
FACING = 0.5
"""Least cosine between the normals of a joint and of a face beside it."""


def covered_fractions(blocks: Blocks, joints: Joints) -> np.ndarray:
    """(F,) share of each face's area that lies in joints; 1 for a face without area (an edge of a floor)."""
    area, normal, centroid = face_areas_normals_centroids(blocks)
    polygon, count = pad(joints.patch_points, joints.patch_start, np.arange(len(joints.patch_points)))
    size, across, middle = areas_normals_centroids(polygon)
    first = np.unique(joints.patch, return_index=True)[1]
    sides = patch_faces(blocks, joints)
    covered = np.zeros(len(area))
    for side, (block, sign) in enumerate(((joints.block_a, 1.0), (joints.block_b, -1.0))):
        face = sides[:, side]
        off = np.abs(np.einsum("ni,ni->n", middle - centroid[face], normal[face]))
        on = (face >= 0) & (off <= ON * extent(blocks))
        np.add.at(covered, face[on], size[on])
        for j in np.flatnonzero(~on).tolist():
            beside = np.array(blocks.faces_of(int(block[first[j]])))
            outward = sign * joints.normal[first[j]]
            away = np.abs(np.einsum("ni,ni->n", middle[j] - centroid[beside], normal[beside]))
            beside = beside[(normal[beside] @ outward >= FACING) & (away <= NEAR * np.sqrt(area[beside]))]
            _cover(blocks, beside, polygon[j, : count[j]], across[j], covered)
    return np.divide(covered, area, out=np.ones_like(area), where=area > 0)


def _cover(blocks: Blocks, faces: np.ndarray, polygon: np.ndarray, normal: np.ndarray, covered: np.ndarray) -> None:
    """Add what of each face a polygon (n, 3) covers as seen along its normal."""
    for f in faces.tolist():
        corners = blocks.face(f)
        flat = corners - ((corners - polygon[0]) @ normal)[:, None] * normal
        over, _ = clip(flat[None], np.array([len(flat)]), polygon[None], normal[None], 0.0)
        whole = float(areas_normals_centroids(flat[None])[0][0])
        own = float(areas_normals_centroids(corners[None])[0][0])
        if whole > 0 and over.shape[1] >= 3:
            covered[f] += own * min(float(areas_normals_centroids(over)[0][0]) / whole, 1.0)

"""Outer faces of a set of blocks, and the mesh nodes on them: where tractions and supports act."""

import numpy as np

from geometry.blocks import Blocks, GeometryError, Joints, TetMesh
from geometry.joints.covered import covered_fractions
from geometry.polyhedra.measures import extent, face_areas_normals_centroids
from geometry.polyhedra.polygons import areas_normals_centroids, pad

DIRECTIONS = ("x-", "x+", "y-", "y+", "z-", "z+")
SAME, LEVEL = 1e-9, 1e-6
"""Of the specimen's longest side: how far a face or a node may be off a plane; off one that a user names."""
TET_FACES = np.array([[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]])


def outer_faces(blocks: Blocks, joints: Joints, block_set: np.ndarray, direction: str) -> np.ndarray:
    """Faces of these blocks that look along direction ("x-" ... "z+"), on the set's extreme plane there, and are free.

    Faces wholly covered by joints are left out. Raises GeometryError for an unknown direction, for a face that is
    covered in part, and if no face is left (naming the directions that have some).
    """
    if direction not in DIRECTIONS:
        raise GeometryError(f"face {direction!r} is unknown; allowed: {', '.join(DIRECTIONS)}")
    covered = covered_fractions(blocks, joints)
    faces = _extreme_faces(blocks, block_set, direction)
    _require_wholly_free_or_covered(blocks, covered, faces, f"face {direction}")
    free = faces[covered[faces] <= 1e-6]
    if len(free) == 0:
        others = [d for d in DIRECTIONS if np.any(covered[_extreme_faces(blocks, block_set, d)] <= 1e-6)]
        reason = "lies in a joint" if len(faces) else "does not exist: no block has a face there"
        raise GeometryError(f"face {direction} {reason}; outer faces there are: {', '.join(others) or 'none'}")
    return free


def faces_in_plane(blocks: Blocks, axis: int, level: float) -> np.ndarray:
    """Faces across axis 0, 1 or 2 (x, y, z) that lie at level (m), whichever way they look.

    Raises GeometryError if there is none, naming the nearest levels that have faces.
    """
    _, normal, centroid = face_areas_normals_centroids(blocks)
    across = np.flatnonzero(np.abs(normal[:, axis]) > 1 - 1e-9)
    width = LEVEL * extent(blocks)
    faces = across[np.abs(centroid[across, axis] - level) <= width]
    if len(faces) == 0:
        levels = centroid[across, axis]
        levels = levels[np.unique(np.round(levels / width), return_index=True)[1]]
        near = sorted(levels[np.argsort(np.abs(levels - level))[:3]].tolist())
        said = ", ".join(f"{'xyz'[axis]} = {value * 1e3:.10g} mm" for value in near)
        raise GeometryError(f"no block has a face there; the nearest planes with faces are {said or 'none'}")
    return faces


def free_faces_in_plane(blocks: Blocks, joints: Joints, axis: int, level: float) -> np.ndarray:
    """Faces of faces_in_plane that lie in no joint; GeometryError if there is none, or if one is covered in part."""
    covered = covered_fractions(blocks, joints)
    faces = faces_in_plane(blocks, axis, level)
    _require_wholly_free_or_covered(blocks, covered, faces, "a face there")
    free = faces[covered[faces] <= 1e-6]
    if len(free) == 0:
        raise GeometryError("all faces there lie in joints; name a plane of outer faces")
    return free


def _require_wholly_free_or_covered(blocks: Blocks, covered: np.ndarray, faces: np.ndarray, what: str) -> None:
    partly = faces[(covered[faces] > 1e-6) & (covered[faces] < 1 - 1e-6)]
    if len(partly):
        block = int(blocks.face_block()[partly[0]])
        raise GeometryError(
            f"{what} of block {block} (unit {blocks.unit[block]}) is covered by a joint over "
            f"{covered[partly[0]]:.1%} of its area; an outer face must be free: divide the block where the joint ends"
        )


def _extreme_faces(blocks: Blocks, block_set: np.ndarray, direction: str) -> np.ndarray:
    axis, sign = "xyz".index(direction[0]), 1.0 if direction[1] == "+" else -1.0
    _, normal, centroid = face_areas_normals_centroids(blocks)
    mine = np.flatnonzero(np.isin(blocks.face_block(), block_set))
    if len(mine) == 0:
        return mine
    corners, _ = pad(blocks.points, blocks.face_start, blocks.face_points)
    level = (sign * corners[mine, :, axis]).max()
    looks = sign * normal[mine, axis] > 1 - 1e-9
    return mine[looks & (sign * centroid[mine, axis] >= level - SAME * extent(blocks))]


def surface_nodes(mesh: TetMesh, blocks: Blocks, faces: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Nodes of the meshed blocks on these faces, rising, and the area (m2) of each: a third of its triangles.

    Faces of blocks without tets give nothing. The areas of a face add up to its area.
    """
    width = SAME * extent(blocks)
    owner = blocks.face_block()
    triangles = [np.zeros((0, 3), dtype=np.int64)]
    for face in np.asarray(faces).tolist():
        block = owner[face]
        candidate = mesh.tets[mesh.tet_start[block] : mesh.tet_start[block + 1]][:, TET_FACES].reshape(-1, 3)
        corners = blocks.face(face)
        _, normal, centroid = (value[0] for value in areas_normals_centroids(corners[None]))
        corner = mesh.nodes[candidate]
        on = np.all(np.abs((corner - centroid) @ normal) <= width, axis=1)
        inward = np.cross(normal, np.roll(corners, -1, axis=0) - corners)
        reach = np.einsum("tki,ki->tk", corner.mean(axis=1)[:, None] - corners[None], inward)
        triangles.append(candidate[on & np.all(reach >= 0, axis=1)])
    triangle = np.concatenate(triangles)
    a, b, c = (mesh.nodes[triangle[:, k]] for k in range(3))
    third = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 6
    node, place = np.unique(triangle, return_inverse=True)
    return node, np.bincount(place.ravel(), weights=np.repeat(third, 3), minlength=len(node))

"""Joints: where faces of two blocks lie on each other, wholly or in part, and the contact points there."""

from collections.abc import Sequence

import numpy as np

from geometry.blocks import Blocks, JointPolygons, Joints
from geometry.joints.contact_points import contact_points
from geometry.joints.point_density import Density
from geometry.polyhedra.box_pairs import overlapping_boxes
from geometry.polyhedra.measures import extent, face_areas_normals_centroids
from geometry.polyhedra.polygons import areas_normals_centroids, clip, pad, tidy, unpad

STEEP = 0.5
"""Faces are searched along each coordinate axis: a face is in the search along an axis if its unit normal has at least
this component there. Each unit normal has a component above 0.57 = 1/sqrt(3), and the normals of two faces that touch
differ by less than 0.05, so both faces are in one search at least."""


def find_joints(
    blocks: Blocks,
    rule: str = "gauss",
    points_per_edge: int | Sequence[int] = 2,
    points_per_face: int | None = None,
    spacing: float | None = None,
    tolerance: float = 1e-9,
) -> Joints:
    """Every overlap of coplanar faces of different blocks that look at each other, with its contact points.

    rule, points_per_edge, points_per_face, spacing  as in Density
    tolerance  of distances, relative to the longest side of the specimen
    Pairs of faces that touch along a line or in a corner only are not joints; they are counted in `dropped`. A polygon
    that two blocks share more than once, where a face is there twice, counts once; the others are in `repeated`.
    """
    return face_joints(blocks, Density(rule, points_per_edge, points_per_face, spacing), tolerance)[0]


def face_joints(blocks: Blocks, density: Density, tolerance: float = 1e-9) -> tuple[Joints, np.ndarray]:
    """The joints, as find_joints, and the faces of block a and of block b that each polygon lies on (J, 2)."""
    width = tolerance * extent(blocks)
    face_a, face_b = facing_pairs(blocks, width)
    corners, count = pad(blocks.points, blocks.face_start, blocks.face_points)
    normal = face_areas_normals_centroids(blocks)[1]
    overlap, corner_count = clip(corners[face_a], count[face_a], corners[face_b], normal[face_b], width)
    touching = corner_count > 0
    overlap, corner_count = tidy(overlap, corner_count, width)
    is_joint = touching & (corner_count >= 3)
    owner = blocks.face_block()
    once = np.flatnonzero(is_joint)
    once = once[~_repeated(overlap[once], np.stack([owner[face_a], owner[face_b]], axis=1)[once], width)]
    overlap, corner_count, face_a, face_b = overlap[once], corner_count[once], face_a[once], face_b[once]

    lost = int(np.sum(touching & ~is_joint)), int(is_joint.sum()) - len(once)
    joints = _on_polygons(overlap, corner_count, owner[face_a], owner[face_b], normal[face_a], density, *lost)
    return joints, np.stack([face_a, face_b], axis=1)


def stated_joints(stated: JointPolygons, density: Density) -> Joints:
    """Contact points on joint polygons that are given."""
    corners, count = pad(stated.points, stated.start, np.arange(len(stated.points)))
    normal = areas_normals_centroids(corners)[1]
    return _on_polygons(corners, count, stated.block_a, stated.block_b, normal, density)


def _on_polygons(
    corners: np.ndarray,
    count: np.ndarray,
    block_a: np.ndarray,
    block_b: np.ndarray,
    normal: np.ndarray,
    density: Density,
    dropped: int = 0,
    repeated: int = 0,
) -> Joints:
    """Contact points on padded polygons (J, K, 3) between blocks (J,), with normals (J, 3) from a to b."""
    patch, point, area = contact_points(corners, count, density)
    patch_start, patch_points = unpad(corners, count)
    return Joints(
        block_a=block_a[patch],
        block_b=block_b[patch],
        node_a=np.full(len(patch), -1, dtype=np.int64),
        node_b=np.full(len(patch), -1, dtype=np.int64),
        point=point,
        normal=normal[patch],
        area=area,
        patch=patch,
        patch_start=patch_start,
        patch_points=patch_points,
        dropped=dropped,
        repeated=repeated,
    )


def _repeated(corners: np.ndarray, pair: np.ndarray, width: float) -> np.ndarray:
    """(N,) whether two blocks (N, 2) share the same polygon (N, K, 3) once more, earlier in the list."""
    if len(np.unique(pair @ [pair.max(initial=0) + 1, 1])) == len(pair):
        return np.zeros(len(pair), dtype=bool)
    from scipy.spatial import cKDTree

    area, normal, middle = areas_normals_centroids(corners)
    close = cKDTree(middle).query_pairs(width, output_type="ndarray")
    first, second = close.min(axis=1), close.max(axis=1)
    size = np.sqrt(area)
    same = np.all(pair[first] == pair[second], axis=1) & (np.abs(size[first] - size[second]) <= width)
    same &= np.einsum("ni,ni->n", normal[first], normal[second]) > 0.999
    again = np.zeros(len(middle), dtype=bool)
    again[second[same]] = True
    return again


def facing_pairs(blocks: Blocks, width: float) -> tuple[np.ndarray, np.ndarray]:
    """Faces a and b, (N,) each, that lie in one plane within width (m), look at each other and may overlap.

    Block a < block b; sorted. The pairs come from sweeps over the boxes round the faces, one for each axis that they
    look along, so there is no rounding of planes to a grid that could part two neighbours.
    """
    corners, _ = pad(blocks.points, blocks.face_start, blocks.face_points)
    area, normal, _ = areas_normals_centroids(corners)
    low, high = corners.min(axis=1) - width, corners.max(axis=1) + width
    owner = blocks.face_block()
    by_axis = [_opposite(owner, normal, low, high, np.flatnonzero(np.abs(normal[:, k]) > STEEP)) for k in range(3)]
    pairs = np.concatenate(by_axis)
    pairs = np.where((owner[pairs[:, 0]] > owner[pairs[:, 1]])[:, None], pairs[:, ::-1], pairs)
    larger = np.where(area[pairs[:, 0]] >= area[pairs[:, 1]], pairs[:, 0], pairs[:, 1])
    smaller = pairs.sum(axis=1) - larger
    height = np.einsum("nki,ni->nk", corners[smaller] - corners[larger, :1], normal[larger])
    pairs = pairs[np.abs(height).max(axis=1, initial=0.0) <= width]
    pairs = pairs[np.lexsort((pairs[:, 1], pairs[:, 0]))]
    once = np.ones(len(pairs), dtype=bool)
    once[1:] = np.any(pairs[1:] != pairs[:-1], axis=1)  # oblique faces were looked at along two axes or three
    return pairs[once, 0], pairs[once, 1]


def _opposite(owner: np.ndarray, normal: np.ndarray, low: np.ndarray, high: np.ndarray, face: np.ndarray) -> np.ndarray:
    """Pairs (N, 2) of some faces (n,) whose boxes low..high meet, that look at each other, of different blocks."""
    pairs = face[overlapping_boxes(low[face], high[face])]
    pairs = pairs[owner[pairs[:, 0]] != owner[pairs[:, 1]]]
    return pairs[np.einsum("ni,ni->n", normal[pairs[:, 0]], normal[pairs[:, 1]]) < -0.999]


def patch_faces(blocks: Blocks, joints: Joints) -> np.ndarray:
    """(J, 2) the faces of block a and of block b that each overlap polygon lies on."""
    first = np.unique(joints.patch, return_index=True)[1]  # contact points may stand in any order
    polygon, _ = pad(joints.patch_points, joints.patch_start, np.arange(len(joints.patch_points)))
    middle = areas_normals_centroids(polygon)[2]
    corners, _ = pad(blocks.points, blocks.face_start, blocks.face_points)
    normal = face_areas_normals_centroids(blocks)[1]
    inward = np.cross(normal[:, None], np.roll(corners, -1, axis=1) - corners)
    start = blocks.block_face_start
    result = np.full((len(first), 2), -1, dtype=np.int64)
    for side, (owner, sign) in enumerate(((joints.block_a, 1.0), (joints.block_b, -1.0))):
        block, outward = owner[first], sign * joints.normal[first]
        nearest = np.full(len(first), np.inf)
        for k in range(int(np.diff(start).max(initial=0))):
            face = np.minimum(start[block] + k, start[block + 1] - 1)
            outside = -np.einsum("nki,nki->nk", middle[:, None] - corners[face], inward[face]).min(axis=1, initial=0.0)
            outside[np.einsum("ni,ni->n", normal[face], outward) < 0.999] = np.inf
            result[outside < nearest, side] = face[outside < nearest]
            nearest = np.minimum(nearest, outside)
    return result


def connected(blocks: Blocks, joints: Joints) -> np.ndarray:
    """(B,) a number for each block, the same for all blocks that hang together by joints."""
    part = np.arange(blocks.count)
    while True:
        a, b = part[joints.block_a], part[joints.block_b]
        if np.array_equal(a, b):
            return np.unique(part, return_inverse=True)[1]
        np.minimum.at(part, np.maximum(a, b), np.minimum(a, b))  # a part joins a neighbour of a lower number
        while not np.array_equal(part, part[part]):
            part = part[part]

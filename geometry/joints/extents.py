"""How far the joint of each contact reaches in its plane: what a slip is measured by."""

import numpy as np

from geometry.blocks import Blocks, Joints
from geometry.polyhedra.indexing import ranges

ALIKE = 1
"""Decimals to which unit normals of one joint agree: two faces less than about 5 degrees apart."""


def joint_extents(blocks: Blocks, joints: Joints) -> tuple[np.ndarray, np.ndarray]:
    """Two axes in the plane of each contact (C, 2, 3), and the extents along them (C, 2) m.

    Between two units it is the joint of both, all their faces that look the same way, however many blocks they are cut
    into; the first axis runs along its longest edge. Within a unit it is the smaller of the two blocks: how long a face
    of random cells is says little there.
    """
    patches, first, patch = np.unique(joints.patch, return_index=True, return_inverse=True)
    a, b, normal = (values[first] for values in (joints.block_a, joints.block_b, joints.normal))
    count = np.diff(joints.patch_start)[patches]
    owner, corner = ranges(joints.patch_start[patches], count)
    _, last = ranges(np.zeros(len(count), dtype=np.int64), count)
    after = np.where(last + 1 < count[owner], corner + 1, corner - last)
    edge = joints.patch_points[after] - joints.patch_points[corner]
    joint = _joints(blocks, a, b, normal)
    along = _longest(edge, joint[owner])[joint]
    along -= np.einsum("ji,ji->j", along, normal)[:, None] * normal
    along /= np.linalg.norm(along, axis=1)[:, None]
    axes = np.stack([along, np.cross(normal, along)], axis=1)
    size = _of_joints(joints.patch_points[corner], owner, joint, axes)
    inside = np.flatnonzero(blocks.unit[a] == blocks.unit[b])
    size[inside] = np.minimum(_of_blocks(blocks, a[inside], axes[inside]), _of_blocks(blocks, b[inside], axes[inside]))
    return axes[patch], size[patch]


def _joints(blocks: Blocks, a: np.ndarray, b: np.ndarray, normal: np.ndarray) -> np.ndarray:
    """(J,) number of the joint that each polygon is part of."""
    one, two = blocks.unit[a], blocks.unit[b]
    inside, turned = one == two, one > two
    pair = np.sort(np.stack([np.where(inside, a, one), np.where(inside, b, two)], axis=1), axis=1)
    direction = np.round(np.where((turned & ~inside)[:, None], -normal, normal), ALIKE) + 0.0
    return np.unique(np.column_stack([inside, pair, direction]), axis=0, return_inverse=True)[1].reshape(-1)


def _longest(edge: np.ndarray, joint: np.ndarray) -> np.ndarray:
    """(joints, 3) the longest of the edges of each joint, the first of those within rounding."""
    length = np.round(np.linalg.norm(edge, axis=1) / np.linalg.norm(edge, axis=1).max(initial=1e-300), 9)
    order = np.lexsort((-length, joint))
    start = np.flatnonzero(np.diff(joint[order], prepend=-1))
    return edge[order[start]]


def _of_joints(points: np.ndarray, owner: np.ndarray, joint: np.ndarray, axes: np.ndarray) -> np.ndarray:
    """(J, 2) extents of whole joints along the axes of the first polygon of each."""
    order = np.argsort(joint[owner], kind="stable")
    start = np.flatnonzero(np.diff(joint[owner[order]], prepend=-1))
    lead = owner[order[start]][joint]
    place = np.einsum("pkj,pj->pk", axes[lead[owner[order]]], points[order])
    size = np.maximum.reduceat(place, start, axis=0) - np.minimum.reduceat(place, start, axis=0)
    return size[joint]


def _of_blocks(blocks: Blocks, block: np.ndarray, axes: np.ndarray) -> np.ndarray:
    """(J, 2) extents of blocks along the axes that belong to each."""
    if len(block) == 0:
        return np.zeros((0, 2))
    start = blocks.face_start[blocks.block_face_start]
    count = np.diff(start)[block]
    owner, corner = ranges(start[block], count)
    place = np.einsum("pkj,pj->pk", axes[owner], blocks.points[blocks.face_points[corner]])
    begin = np.cumsum(count) - count
    return np.maximum.reduceat(place, begin, axis=0) - np.minimum.reduceat(place, begin, axis=0)

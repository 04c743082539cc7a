"""Cells of the faces of blocks in which the contact points of their joints lie, in the undeformed shape."""

import numpy as np

from geometry.blocks import Joints
from masonry.patches.arrays import Near

FACING = 0.999
"""A face whose normal makes a smaller cosine with that of a joint is not the joint's own."""
ON_FACE = 1e-6
"""How far a place may be from a rectangle of cells, in cells."""
AT_ONCE = 200_000
"""Contact points, each beside all faces of its block, that are looked at together: some 30 MB."""


def cells_of_joints(joints: Joints, near: Near) -> np.ndarray:
    """(2, C) the cell of the face on each side of a joint in which a contact point lies; -1 where there is none."""
    faces, pieces = near.crushed, near.pieces
    body = np.repeat(pieces.body, np.diff(pieces.face_start))
    block, corner = pieces.block[body], near.motion.centre[body] + faces.corner
    order = np.argsort(block, kind="stable")
    start = np.searchsorted(block[order], np.arange(block.max(initial=-1) + 2))
    cells = np.full((2, len(joints.area)), -1)
    for side, (owner, sign) in enumerate(((joints.block_a, 1.0), (joints.block_b, -1.0))):
        number = np.diff(start)[owner]
        for c in in_parts(number):
            first = np.cumsum(number[c]) - number[c]
            one = np.repeat(np.arange(len(c)), number[c])
            f = order[start[owner[c]][one] + np.arange(len(one)) - first[one]]
            offset = joints.point[c][one] - corner[f]
            u, v = (np.einsum("kj,kj->k", offset, axis[f]) for axis in (faces.along, faces.across))
            height = np.abs(np.einsum("kj,kj->k", offset, pieces.normal[f]))
            outside = np.maximum(np.maximum(-u, u - faces.number[f, 0]), np.maximum(-v, v - faces.number[f, 1]))
            facing = sign * np.einsum("kj,kj->k", joints.normal[c][one], pieces.normal[f])
            height[(facing < FACING) | (outside > ON_FACE)] = np.inf
            nearest = np.flatnonzero(np.isfinite(height) & (height == np.minimum.reduceat(height, first)[one]))
            there, which = np.unique(one[nearest], return_index=True)
            own, face = nearest[which], f[nearest[which]]
            i, j = (np.clip(at[own].astype(np.int64), 0, faces.number[face, k] - 1) for k, at in enumerate((u, v)))
            cells[side, c[there]] = faces.first[face] + i * faces.number[face, 1] + j
    return cells


def in_parts(number: np.ndarray) -> list[np.ndarray]:
    """Rows one after another, in parts whose numbers (C,) add up to AT_ONCE or little more."""
    last = np.cumsum(number)
    ends = np.searchsorted(last, np.arange(AT_ONCE, last[-1] if len(last) else 0, AT_ONCE))
    return [part for part in np.split(np.arange(len(number)), np.unique(ends)) if len(part)]

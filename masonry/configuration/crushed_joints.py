"""How far joints are crushed: their bonds, and in place of those that are gone the faces that meet as patches."""

import numpy as np

from geometry.blocks import Joints
from masonry.detection.narrow import FACE
from masonry.model.large.meeting import Large
from masonry.model.model import Model
from masonry.patches.arrays import PLACE, Near
from masonry.patches.crushed_points import CLOSING, KEPT
from masonry.simd import FOUR

FACING = 0.999
"""A face whose normal makes a smaller cosine with that of a joint is not the joint's own."""
ON_FACE = 1e-6
"""How far a place may be from a rectangle of cells, in cells."""
AT_ONCE = 200_000
"""Contact points, each beside all faces of its block, that are looked at together: some 30 MB."""


class CrushedJoints:
    """Looks at the faces of a model of large displacement where its joints were, in the undeformed shape."""

    def __init__(self, model: Model, large: Large) -> None:
        self.model, self.parts = model, large
        self.cells = cells_of_joints(model.joints, large.near)
        block = np.sort(np.column_stack([model.joints.block_a, model.joints.block_b]), axis=1)
        pair, self.pair_of = np.unique(block, axis=0, return_inverse=True)
        self.number = {(int(a), int(b)): k for k, (a, b) in enumerate(pair)}

    def closing(self) -> np.ndarray:
        """(C,) m, plastic closing: of both faces at a place, or of the bond while it is there."""
        model, faces = self.model, self.parts.near.crushed
        bonds = np.zeros(len(model.group)) if model.state.crushed is None else model.state.crushed[:, 0].copy()
        patches = np.where(self.cells >= 0, faces.closing[self.cells], 0.0).sum(axis=0)
        self._add_growth(patches, np.flatnonzero(~model.alive))
        return np.where(model.alive, bonds, patches)

    def _add_growth(self, closing: np.ndarray, gone: np.ndarray) -> None:
        """Add to the closing (C,) of joints that are gone what the points there have not told their faces yet."""
        near = self.parts.near
        crushed = near.points.crushed
        assert crushed is not None
        pairs, points, pair_of = near.pairs, near.points, np.reshape(self.pair_of, -1)[gone]
        for p in np.flatnonzero((pairs.slot[: pairs.number[0]] >= 0) & (pairs.witness[: pairs.number[0], 0] == FACE)):
            s, blocks = pairs.slot[p], np.sort(near.pieces.block[pairs.body[p]])
            k = np.arange(points.number[s])
            grown = crushed[s, k // FOUR, CLOSING, k % FOUR] - crushed[s, k // FOUR, KEPT, k % FOUR]
            beside = gone[pair_of == self.number.get((int(blocks[0]), int(blocks[1])), -1)]
            if not grown.any() or len(beside) == 0:
                continue
            body = pairs.body[p, pairs.points_of[p]]
            place = near.motion.centre[body] + points.quads[k // FOUR, s, PLACE : PLACE + 3, k % FOUR]
            apart = self.model.joints.point[beside][:, None] - place
            closing[beside] += grown[np.argmin(np.einsum("ckj,ckj->ck", apart, apart), axis=1)]


def most_crushed(near: Near, width: np.ndarray) -> tuple[float, tuple[int, int]]:
    """The most plastic closing of a patch, over the widths (B,) m of the thinner of its two blocks, and which they
    are."""
    pairs, points = near.pairs, near.points
    if points.crushed is None:
        return 0.0, (0, 0)
    p = np.flatnonzero(pairs.slot[: pairs.number[0]] >= 0)
    blocks, s = near.pieces.block[pairs.body[p]], pairs.slot[p]
    closing = points.crushed[:, :, CLOSING].reshape(len(points.crushed), -1)[s]
    share = np.where(np.arange(closing.shape[1]) < points.number[s][:, None], closing, 0.0).max(axis=1, initial=0.0)
    share /= width[blocks].min(axis=1)
    if not share.any():
        return 0.0, (0, 0)
    worst = int(share.argmax())
    return float(share[worst]), (int(blocks[worst, 0]), int(blocks[worst, 1]))


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

"""Where the matter of a block goes: the displacement of any of its points, from its corners or its tet nodes."""

import numpy as np

from geometry.blocks import Blocks, Joints
from geometry.polyhedra.measures import sum_by_block
from masonry.rows.history import Frame


class BlockCorners:
    """Common data of the fits of all frames: the corners of each block, each once and as heavy as it has faces, their
    mean, and the inverse of their spread."""

    def __init__(self, blocks: Blocks) -> None:
        self.blocks = blocks
        owner = np.repeat(blocks.face_block(), np.diff(blocks.face_start))
        each, faces = np.unique(owner * len(blocks.points) + blocks.face_points, return_counts=True)
        self.owner, self.corner = np.divmod(each, len(blocks.points))
        self.weight = faces[:, None].astype(float)
        self.number = np.maximum(np.bincount(owner, minlength=blocks.count), 1)[:, None]
        self.centre = self.sum(blocks.points[self.corner]) / self.number
        self.arm = blocks.points[self.corner] - self.centre[self.owner]
        self.inverse = np.linalg.pinv(self.sum_of_products(self.arm), hermitian=True)

    def sum_of_products(self, values: np.ndarray) -> np.ndarray:
        """Sum over the corners of each block of values (n, 3) times the arms: (B, 3, 3)."""
        arms, count = np.ascontiguousarray((self.weight * self.arm).T), self.blocks.count
        sums = [[np.bincount(self.owner, value * arm, count) for arm in arms] for value in values.T.copy()]
        return np.moveaxis(np.array(sums), 2, 0)

    def sum(self, values: np.ndarray) -> np.ndarray:
        """Sum over the corners of each block of values (n, 3): (B, 3)."""
        return sum_by_block(self.blocks, self.owner, self.weight * values)


class Deformation:
    """The displacement field of one frame: per block the affine map that fits its corners (exact for rigid and affine
    blocks), and the node's own displacement where a point sits on a tet node.

    gradient  (B, 3, 3) of the displacement of each block
    """

    def __init__(self, corners: BlockCorners, frame: Frame) -> None:
        moved = frame.corners[corners.corner]
        self._centre = corners.centre
        self._shift = corners.sum(moved) / corners.number
        spread = moved - self._shift[corners.owner]
        self.gradient = corners.sum_of_products(spread) @ corners.inverse
        self._nodes = frame.nodes

    def at(
        self,
        block: np.ndarray,
        point: np.ndarray,
        node: np.ndarray,
        corner: np.ndarray | None = None,
        fraction: np.ndarray | None = None,
    ) -> np.ndarray:
        """(n, 3) m, displacement of point (n, 3) as part of block (n,), or of tet node (n,) where that is not -1.

        corner, fraction  (n, 3) tet nodes round the point where its first is not -1, and their shape functions
        """
        arm = point - self._centre[block]
        displacement = self._shift[block]
        for i in range(3):  # one by one: nine numbers for every point are much
            displacement[:, i] += np.einsum("nj,nj->n", self.gradient[block, i], arm)
        meshed = node >= 0
        displacement[meshed] = self._nodes[node[meshed]]
        if corner is not None and fraction is not None:
            between = corner[:, 0] >= 0
            displacement[between] = np.einsum("nj,nji->ni", fraction[between], self._nodes[corner[between]])
        return displacement

    def sides(self, joints: Joints, contact: np.ndarray, point: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Displacements (n, 3) m of point (n, 3), by the contacts (n,), as matter of block a and of block b."""
        a, b = (
            self.at(
                block[contact], point, node[contact], *(None if part is None else part[contact] for part in between)
            )
            for block, node, *between in (
                (joints.block_a, joints.node_a, joints.corner_a, joints.share_a),
                (joints.block_b, joints.node_b, joints.corner_b, joints.share_b),
            )
        )
        return a, b

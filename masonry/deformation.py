"""Where the matter of a block goes: the displacement of any of its points, from its corners or its tet nodes."""

import numpy as np

from geometry.blocks import Blocks
from masonry.history import Frame


class Deformation:
    """The displacement field of one frame: per block the affine map that fits its corners (exact for rigid and affine
    blocks), and the node's own displacement where a point sits on a tet node."""

    def __init__(self, blocks: Blocks, frame: Frame) -> None:
        corner = blocks.face_points
        owner = np.repeat(blocks.face_block(), np.diff(blocks.face_start))
        number = np.maximum(np.bincount(owner, minlength=blocks.count), 1)[:, None]
        self._centre = _sum(blocks.points[corner], owner, blocks.count) / number
        self._shift = _sum(frame.corners[corner], owner, blocks.count) / number
        arm = blocks.points[corner] - self._centre[owner]
        spread = frame.corners[corner] - self._shift[owner]
        moment = _sum(arm[:, :, None] * arm[:, None, :], owner, blocks.count)
        product = _sum(spread[:, :, None] * arm[:, None, :], owner, blocks.count)
        self._gradient = product @ np.linalg.pinv(moment, hermitian=True)
        self._nodes = frame.nodes

    def at(
        self,
        block: np.ndarray,
        point: np.ndarray,
        node: np.ndarray,
        corner: np.ndarray | None = None,
        share: np.ndarray | None = None,
    ) -> np.ndarray:
        """(n, 3) m, displacement of point (n, 3) as part of block (n,), or of tet node (n,) where that is not -1.

        corner, share  (n, 3) tet nodes round the point where its first is not -1, and their shares, as in Joints
        """
        arm = point - self._centre[block]
        displacement = self._shift[block] + np.einsum("nij,nj->ni", self._gradient[block], arm)
        meshed = node >= 0
        displacement[meshed] = self._nodes[node[meshed]]
        if corner is not None and share is not None:
            between = corner[:, 0] >= 0
            displacement[between] = np.einsum("nj,nji->ni", share[between], self._nodes[corner[between]])
        return displacement


def _sum(values: np.ndarray, owner: np.ndarray, count: int) -> np.ndarray:
    """Sum of values (n, ...) by owner (n,): (count, ...)."""
    total = np.zeros((count, *values.shape[1:]))
    np.add.at(total, owner, values)
    return total

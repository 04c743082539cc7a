"""Where the corners of all blocks are: side by side, so that one look at a row costs little."""

from dataclasses import replace

import numpy as np

from geometry.blocks import Blocks
from geometry.polyhedra.polygons import pad
from masonry.model.model import Model
from masonry.monitors.stability import corner_displacements, nearest_nodes


class Corners:
    """The corners of each block in the beginning, place (3, K, B) m, and how far they have moved since."""

    def __init__(self, model: Model) -> None:
        blocks = own_corners(model.blocks)
        self.model = replace(model, blocks=blocks)
        self.nearest = nearest_nodes(self.model)
        start = blocks.face_start[blocks.block_face_start]
        self.points = distinct(pad(np.arange(start[-1])[:, None], start, blocks.face_points)[0][:, :, 0]).T
        self.place = np.ascontiguousarray(blocks.points[self.points].transpose(2, 0, 1))
        self.arm = self.place - model.layout.centroid.T[:, None]

    def moved(self) -> tuple[np.ndarray, np.ndarray]:
        """Displacements (3, K, B) m, and their gradients (3, 3, B), 0 for blocks with tets."""
        shift, gradient = self._motion()
        moved = shift[:, None] + sum(gradient[:, j, None] * self.arm[j] for j in range(3))
        if self.nearest is not None:
            which = self.model.layout.members["tets"]
            moved[:, :, which] = self.model.contacts.u[self.nearest[self.points[:, which]]].transpose(2, 0, 1)
        return moved, gradient

    def displaced(self) -> Blocks:
        """The blocks as they are now, none of which shares a corner with another."""
        blocks = self.model.blocks
        return replace(blocks, points=blocks.points + corner_displacements(self.model, self.nearest))

    def _motion(self) -> tuple[np.ndarray, np.ndarray]:
        """Displacement (3, B) m of the centroids of rigid and affine blocks, and its gradient (3, 3, B)."""
        layout, count = self.model.layout, self.model.blocks.count
        shift, gradient = np.zeros((3, count)), np.zeros((3, 3, count))
        rigid, affine, _ = self.model.bodies
        if rigid is not None:
            which = layout.members["rigid"]
            shift[:, which] = rigid.q[:, :3].T
            x, y, z = np.einsum("bij,bj->ib", layout.axes[which], rigid.q[:, 3:])
            gradient[0, 1, which], gradient[0, 2, which], gradient[1, 2, which] = -z, y, -x
            gradient[1, 0, which], gradient[2, 0, which], gradient[2, 1, which] = z, -y, x
        if affine is not None:
            which = layout.members["affine"]
            shift[:, which] = affine.q[:, :3].T
            along = affine.q[:, 3:].reshape(-1, 3, 3)
            gradient[:, :, which] = np.einsum("bij,bkj->ikb", along, layout.axes[which])
        return shift, gradient


def own_corners(blocks: Blocks) -> Blocks:
    """The same blocks, none of which shares a corner with another."""
    owner = np.repeat(blocks.face_block(), np.diff(blocks.face_start))
    used, place = np.unique(owner * len(blocks.points) + blocks.face_points, return_inverse=True)
    if len(used) == len(np.unique(blocks.face_points)):
        return blocks
    return replace(blocks, points=blocks.points[used % len(blocks.points)], face_points=place.reshape(-1))


def distinct(points: np.ndarray) -> np.ndarray:
    """Each row of numbers (B, n) without repetitions, filled up with the first of its own."""
    rows = [np.unique(row) for row in points]
    width = max(map(len, rows), default=0)
    return np.array([np.append(row, np.full(width - len(row), row[0])) for row in rows])

"""Where the corners of all blocks are: side by side, so that one look at a row costs little."""

from dataclasses import replace

import numpy as np

from geometry.blocks import Blocks
from geometry.jit_cache import compiled
from geometry.polyhedra.construct import with_own_points
from geometry.polyhedra.polygons import pad
from masonry.model.model import Model
from masonry.monitors.frames import Frames


class Corners:
    """The corners of each block in the beginning, place (B, K, 3) m, and how far they have moved since."""

    def __init__(self, model: Model) -> None:
        blocks = with_own_points(model.blocks)
        self.model = replace(model, blocks=blocks)
        self.frames = Frames(self.model)
        self.nearest = self.frames.nearest
        start = blocks.face_start[blocks.block_face_start]
        self.points = distinct(pad(np.arange(start[-1])[:, None], start, blocks.face_points)[0][:, :, 0])
        self.place = blocks.points[self.points]
        self.arm = self.place - model.layout.centroid[:, None]
        count = model.blocks.count
        self.shift, self.gradient, self.reach = np.zeros((count, 3)), np.zeros((count, 3, 3)), np.zeros(count)
        self.moved = np.zeros(self.arm.shape)

    def now(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Where they are (B, K, 3) m, how far they have moved at most along x, y or z (B,) m, and the gradients of
        these displacements (B, 3, 3), 0 for blocks with tets: arrays that the next look writes anew."""
        layout, place, reach = self.model.layout, self.moved, self.reach
        rigid, affine, _ = self.model.bodies
        if rigid is not None:
            write_motion(rigid.q, layout.axes, layout.members["rigid"], self.shift, self.gradient)
        if affine is not None:
            write_strain(affine.q, layout.axes, layout.members["affine"], self.shift, self.gradient)
        move(self.place, self.arm, self.shift, self.gradient, place, reach)
        if self.nearest is not None:
            which = self.model.layout.members["tets"]
            by_nodes = self.model.u[self.nearest[self.points[which]]]
            place[which], reach[which] = self.place[which] + by_nodes, np.abs(by_nodes).max(axis=(1, 2))
        return place, reach, self.gradient

    def displaced(self) -> Blocks:
        """The blocks as they are now, none of which shares a corner with another."""
        blocks = self.model.blocks
        return replace(blocks, points=blocks.points + self.frames.corners())


@compiled
def write_motion(q, axes, which, shift, gradient):
    """Write the shift (B, 3) m and gradient (B, 3, 3) of rigid blocks (b,); their dofs q (b, 6), all axes (B, 3, 3)."""
    for k in range(len(which)):
        b, one, two, three = which[k], q[k, 3], q[k, 4], q[k, 5]
        for i in range(3):
            shift[b, i] = q[k, i]
            rotation = axes[b, i, 0] * one + axes[b, i, 1] * two + axes[b, i, 2] * three
            j = (i + 1) % 3
            gradient[b, (j + 1) % 3, j], gradient[b, j, (j + 1) % 3] = rotation, -rotation


@compiled
def write_strain(q, axes, which, shift, gradient):
    """The same of blocks of one strain; their dofs q (b, 12)."""
    for n in range(len(which)):
        b = which[n]
        for i in range(3):
            shift[b, i] = q[n, i]
            for k in range(3):
                gradient[b, i, k] = 0.0
                for j in range(3):
                    gradient[b, i, k] += q[n, 3 + 3 * i + j] * axes[b, k, j]


@compiled
def move(place, arm, shift, gradient, now, reach):
    """Write the places (B, K, 3) of corners that are moved by shift (B, 3) and gradient (B, 3, 3) times arm (B, K, 3),
    and the largest component of each block's displacements (B,)."""
    for b in range(arm.shape[0]):
        reach[b] = 0.0
        for k in range(arm.shape[1]):
            x, y, z = arm[b, k, 0], arm[b, k, 1], arm[b, k, 2]
            for i in range(3):
                displacement = shift[b, i] + gradient[b, i, 0] * x + gradient[b, i, 1] * y + gradient[b, i, 2] * z
                now[b, k, i] = place[b, k, i] + displacement
                reach[b] = max(reach[b], abs(displacement))


def distinct(points: np.ndarray) -> np.ndarray:
    """Each row of numbers (B, n) without repetitions, filled up with the first of its own."""
    rows = [np.unique(row) for row in points]
    width = max(map(len, rows), default=0)
    return np.array([np.append(row, np.full(width - len(row), row[0])) for row in rows])

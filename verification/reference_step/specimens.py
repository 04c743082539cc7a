"""Specimens for timing: a wall in running bond, and a grid of bricks whose tets match across joints."""

from dataclasses import replace
from typing import Any

import numpy as np

from geometry.blocks import Blocks, Joints, TetMesh
from geometry.joints.find import find_joints
from geometry.polyhedra.construct import divide, from_boxes
from verification.fixtures import shapes
from verification.fixtures.structured import grid_of_tets

UNIT = np.array([0.24, 0.115, 0.113])


def wall(columns: int, courses: int) -> tuple[Blocks, Joints]:
    """Running bond, every second course shifted by half a unit; every block is a unit of its own."""
    blocks = shapes.wall(columns, courses, tuple(UNIT))
    return blocks, find_joints(blocks)


def bricks(count: tuple[int, int, int], cells: tuple[int, int, int]) -> tuple[Blocks, Joints, TetMesh]:
    """A stack of bricks, each a grid of cells of six tets; the nodes of neighbours coincide and meet in pairs."""
    low, high = divide([0.0, 0.0, 0.0], (UNIT * count).tolist(), count)
    number = len(low)
    blocks = from_boxes(low, high, np.arange(number), np.zeros(number, dtype=np.int64), ("units",))
    within, own = grid_of_tets(np.zeros(3), UNIT, cells)
    grid = np.rint(within * cells / UNIT).astype(int)
    nodes = (low[:, None] + within).reshape(-1, 3)
    each = len(grid)
    mesh = TetMesh(
        nodes=nodes,
        node_start=np.arange(number + 1) * each,
        tets=(own + each * np.arange(number)[:, None, None]).reshape(-1, 4),
        tet_start=np.arange(number + 1) * len(own),
    )
    return blocks, _joints(count, cells, grid, nodes), mesh


def pairs() -> tuple[Blocks, Joints, TetMesh]:
    """3468 contacts of 125 bricks of tets, few enough for a cache; every contact has two nodes of its own."""
    blocks, joints, mesh = bricks((5, 5, 5), (4, 4, 4))
    uses = np.bincount(np.concatenate([joints.node_a, joints.node_b]), minlength=len(mesh.nodes))
    alone = (uses[joints.node_a] == 1) & (uses[joints.node_b] == 1)
    names = ("block_a", "block_b", "node_a", "node_b", "point", "normal", "area", "patch")
    return blocks, replace(joints, **{name: getattr(joints, name)[alone] for name in names}), mesh


def _joints(count: tuple, cells: tuple, grid: np.ndarray, nodes: np.ndarray) -> Joints:
    """A contact point at every pair of nodes; areas by the trapezoid rule, which adds up to the face."""
    stride = np.array([1, count[0], count[0] * count[1]])
    k, j, i = (index.ravel() for index in np.indices(count[::-1]))
    place = np.stack([i, j, k], axis=1)
    each, parts, first = len(grid), [], 0
    for axis in range(3):
        a = np.flatnonzero(place[:, axis] < count[axis] - 1)
        high, low = (np.flatnonzero(grid[:, axis] == end) for end in (cells[axis], 0))
        others = [k for k in range(3) if k != axis]
        width = np.prod([np.where(grid[high, k] % cells[k], 1.0, 0.5) * UNIT[k] / cells[k] for k in others], axis=0)
        block_a = np.repeat(a, len(high))
        parts.append(
            {
                "block_a": block_a,
                "block_b": block_a + stride[axis],
                "node_a": (each * a[:, None] + high).ravel(),
                "node_b": (each * (a + stride[axis])[:, None] + low).ravel(),
                "normal": np.broadcast_to(np.eye(3)[axis], (len(block_a), 3)),
                "area": np.tile(width, len(a)),
                "patch": first + np.repeat(np.arange(len(a)), len(high)),
            }
        )
        first += len(a)
    values: dict[str, Any] = {
        name: np.ascontiguousarray(np.concatenate([part[name] for part in parts])) for name in parts[0]
    }
    start = np.arange(first + 1) * 4
    return Joints(point=nodes[values["node_a"]], patch_start=start, patch_points=np.zeros((4 * first, 3)), **values)

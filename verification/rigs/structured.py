"""Boxes in a row along x on one regular grid of tets: six in each cell of the grid, alike in all, so faces match."""

from collections.abc import Sequence
from itertools import permutations

import numpy as np

from geometry.blocks import Specimen, TetMesh
from geometry.shapes import from_boxes


def row_of_boxes(
    cuts: Sequence[float], cells: Sequence[Sequence[int]], width: float, height: float, section: float
) -> tuple[Specimen, TetMesh]:
    """Boxes between the cuts (n + 1,) m along x, from 0 to width in y and to height in z; cells (n, 3) of each box.

    Each box is a unit of its own, and the sets "box 0", "box 1", ... hold one each, "all" all of them. section in m2.
    """
    count = len(cells)
    low = np.array([[x, 0.0, 0.0] for x in cuts[:-1]])
    high = np.array([[x, width, height] for x in cuts[1:]])
    blocks = from_boxes(low, high, np.arange(count), np.zeros(count), ("units",))
    grids = [grid_of_tets(a, b, n) for a, b, n in zip(low, high, cells, strict=True)]
    node_start = np.concatenate([[0], np.cumsum([len(nodes) for nodes, _ in grids])])
    mesh = TetMesh(
        nodes=np.concatenate([nodes for nodes, _ in grids]),
        node_start=node_start,
        tets=np.concatenate([tets + first for (_, tets), first in zip(grids, node_start[:-1], strict=True)]),
        tet_start=np.concatenate([[0], np.cumsum([len(tets) for _, tets in grids])]),
    )
    sets = {"all": np.arange(count)} | {f"box {k}": np.array([k]) for k in range(count)}
    return Specimen(blocks, sets, section), mesh


def grid_of_tets(low: np.ndarray, high: np.ndarray, cells: Sequence[int]) -> tuple[np.ndarray, np.ndarray]:
    """Nodes (N, 3) m and tets (T, 4) of a box: each cell is cut into Kuhn's six, which are paths along its edges."""
    lines = [np.linspace(a, b, n + 1) for a, b, n in zip(low, high, cells, strict=True)]
    nodes = np.stack(np.meshgrid(*lines, indexing="ij"), axis=-1).reshape(-1, 3)
    stride = np.array([(cells[1] + 1) * (cells[2] + 1), cells[2] + 1, 1])
    first = np.stack(np.meshgrid(*(np.arange(n) for n in cells), indexing="ij"), axis=-1).reshape(-1, 3) @ stride
    tets = []
    for order in permutations(range(3)):
        path = np.concatenate([[0], np.cumsum(stride[list(order)])])
        odd = np.linalg.det(np.eye(3)[list(order)]) < 0
        tets.append(first[:, None] + path[[0, 2, 1, 3] if odd else [0, 1, 2, 3]])
    return nodes, np.concatenate(tets)

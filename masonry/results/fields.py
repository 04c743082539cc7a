"""fields.vtkhdf: the blocks and their displacement and stress at every frame, for ParaView.

Points stand where they stood before loading; `displacement` is point data (warp by it). Cells: the faces of blocks
without tets as polygons, and tets; `block`, `unit` and `group` say whose they are.
"""

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from masonry.results.vtkhdf import TO_VTK, VTK_POLYGON, VTK_TETRA, Data, VtkCells, write
from masonry.rows.history import Frame

if TYPE_CHECKING:
    from masonry.results.data import ResultData


class BlockGrid:
    """The blocks of a result as cells, and their data in a frame."""

    def __init__(self, result: "ResultData") -> None:
        blocks, mesh = result.specimen.blocks, result.mesh
        tets_of = np.zeros(blocks.count, int) if mesh is None else np.diff(mesh.tet_start)
        nodes = np.zeros((0, 3)) if mesh is None else mesh.nodes
        tets = np.zeros((0, 4), int) if mesh is None else mesh.tets
        face_block = blocks.face_block()
        bare = tets_of[face_block] == 0
        sides = np.diff(blocks.face_start)
        shown = np.repeat(bare, sides)
        self.corners = np.unique(blocks.face_points[shown])
        face_points = np.searchsorted(self.corners, blocks.face_points[shown])
        sizes = np.concatenate([sides[bare], np.full(len(tets), 4)])
        self.block = np.concatenate([face_block[bare], np.repeat(np.arange(blocks.count), tets_of)]).astype(np.int32)
        self.cells = VtkCells(
            points=np.concatenate([blocks.points[self.corners], nodes]),
            connectivity=np.concatenate([face_points, tets.ravel() + len(self.corners)]),
            offsets=np.concatenate([[0], np.cumsum(sizes)]),
            types=np.repeat([VTK_POLYGON, VTK_TETRA], [int(bare.sum()), len(tets)]),
            still={
                "block": self.block,
                "unit": blocks.unit[self.block].astype(np.int32),
                "group": blocks.group[self.block].astype(np.int32),
            },
        )

    def point_data(self, frame: Frame) -> Data:
        """`displacement` (points, 3) m of one frame."""
        return {"displacement": np.concatenate([frame.corners[self.corners], frame.nodes.reshape(-1, 3)])}

    def cell_data(self, frame: Frame) -> Data:
        """`stress` (cells, 6) Pa: the mean stress of the block, in the order of VTK."""
        return {"stress": frame.stress[self.block][:, TO_VTK]}


def write_blocks(path: Path, result: "ResultData") -> None:
    """Write the VTKHDF file; without frames it holds the blocks only."""
    grid = BlockGrid(result)
    write(path, grid.cells, result.history.frames, grid.point_data, grid.cell_data)

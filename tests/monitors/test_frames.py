"""Frames: where the corners of blocks lie."""

import numpy as np
import pytest

from masonry import scene
from masonry.laboratory import laboratory


def test_corners_that_cells_share_go_with_each_of_them():
    made = scene.load("rubble-pile", {"solver.duration": "0.5 s", "specimen.cells.total": 30, "solver.frames": 2})
    result = laboratory.run(made)
    blocks, moved = result.specimen.blocks, result.history.frames[-1].corners
    owner = np.repeat(blocks.face_block(), np.diff(blocks.face_start))
    for points in ([*set(blocks.face_points[owner == cell].tolist())] for cell in range(30)):
        before, after = (
            np.linalg.norm(x[points] - x[points[0]], axis=1) for x in (blocks.points, blocks.points + moved)
        )
        assert after == pytest.approx(before, abs=1e-12), "a rigid cell keeps its size"

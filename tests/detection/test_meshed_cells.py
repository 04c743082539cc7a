"""Tets of meshed cells that lie on each other: they touch at faces, edges and corners, and none is in another one."""

import numpy as np
import pytest

from geometry.joints.find import find_joints
from geometry.meshes.fan import mesh_by_fans
from masonry.detection.narrow import NONE
from masonry.detection.overlap import scratch_of
from masonry.detection.pieces import SNAP_OF_TETS, pieces_of
from masonry.detection.placing import turned_of
from masonry.detection.tet_pieces import surface_tets
from masonry.model.layout import tet_gradients
from tests.detection.touching import Bodies, cells

COUNT = 12


class MeshedCells(Bodies):
    """Cells of a unit cube as the tets at their surfaces."""

    def __init__(self, seed: int) -> None:
        blocks = cells(COUNT, seed)
        mesh = mesh_by_fans(blocks, np.ones(COUNT, dtype=bool), find_joints(blocks))[0]
        tets = surface_tets(mesh, tet_gradients(mesh))
        self.pieces = pieces_of(blocks, tets, mesh.nodes)
        self.turned, self.scratch = turned_of(self.pieces), scratch_of(self.pieces)
        self.position = np.concatenate([np.zeros((COUNT, 3)), tets.centre])
        self.frame = np.tile(np.eye(3), (len(self.position), 1, 1))
        self.put(0)

    def near(self) -> np.ndarray:
        """(n, 2) tets of two cells whose boxes meet."""
        corners = np.array([self.corners(p) for p in range(len(self.pieces.body))])
        low, high = corners.min(axis=1) - 1e-6, corners.max(axis=1) + 1e-6
        meets = np.all((low[:, None] <= high) & (low <= high[:, None]), axis=2)
        block = self.pieces.block[self.pieces.body]
        return np.argwhere(np.triu(meets & (block[:, None] != block)))


@pytest.mark.parametrize("seed", [1, 5, 18])
def test_no_tet_is_found_to_be_inside_of_one_that_it_only_touches(seed):
    bodies = MeshedCells(seed)
    contacts = [bodies.touch(p, q, skin=1e-3, reach=1e-3, least=1e-9) for p, q in bodies.near()]
    closed = [one for one in contacts if one.kind != NONE]
    assert len(closed) > 100
    assert min(one.gap.min() for one in closed) > -SNAP_OF_TETS * bodies.pieces.radius.max()

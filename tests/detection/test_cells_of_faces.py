"""The cells in which faces remember how far they are crushed: they cover each face, and no more than its outline."""

from itertools import pairwise

import numpy as np
import pytest

from geometry.polyhedra.construct import concatenate, extrude
from masonry.detection.pieces import pieces_of
from masonry.patches.crushed_faces import crushed_faces

LOOPS = [[(0.0, 0.0), (0.5, 0.07), (0.43, 0.31), (-0.06, 0.2)], [(1.0, 0.1), (1.4, 0.0), (1.3, 0.3)]]
DEEP = 0.12, 6.0
"""m: a quadrilateral without right angles and a triangle, along y."""


def faces_and_cells(size: float):
    """Corners (K, 3) m of each face from the centroid of its block, and the cells of all."""
    blocks = [
        extrude([np.array(loop)], np.array([0.3]), np.array([0.3 + deep]), np.array([n]), ("units",))
        for n, (loop, deep) in enumerate(zip(LOOPS, DEEP, strict=True))
    ]
    pieces = pieces_of(concatenate(blocks))
    loops = [pieces.vertex[pieces.loop[a:b]] for a, b in pairwise(pieces.loop_start)]
    return loops, crushed_faces(pieces, np.array([size, size]))


def test_cells_begin_and_end_where_a_face_does():
    loops, cells = faces_and_cells(0.4)
    for f, loop in enumerate(loops):
        for way, number in ((cells.along[f], cells.number[f, 0]), (cells.across[f], cells.number[f, 1])):
            place = (loop - cells.corner[f]) @ way
            assert (place.min(), place.max()) == pytest.approx((0.0, number), abs=1e-9)
        edges = np.roll(loop, -1, axis=0) - loop
        longest = edges[np.argmax(np.linalg.norm(edges, axis=1))]
        assert abs(cells.along[f] @ cells.across[f]) < 1e-9 * (cells.along[f] @ cells.along[f])
        assert np.linalg.norm(np.cross(longest, cells.along[f])) < 1e-9 * abs(longest @ cells.along[f])
        flat = np.cross(cells.along[f], cells.across[f])
        assert (loop - cells.corner[f]) @ flat == pytest.approx(0.0, abs=1e-9 * np.linalg.norm(flat))


def test_a_cell_is_a_twentieth_of_a_block_but_there_are_8_to_256_along_a_side():
    loops, cells = faces_and_cells(0.4)
    for f, loop in enumerate(loops):
        ways = np.array([cells.along[f], cells.across[f]])
        extent = np.ptp(loop @ (ways / np.linalg.norm(ways, axis=1)[:, None]).T, axis=0)
        assert cells.number[f].tolist() == np.clip(np.ceil(extent / 0.02 - 1e-9), 8, 256).astype(int).tolist()
    assert cells.number.min() == 8 and cells.number.max() == 256
    assert cells.first.tolist() == [0, *np.cumsum(cells.number.prod(axis=1))]
    assert len(cells.closing) == len(cells.hardening) == cells.first[-1] and not cells.begun.any()

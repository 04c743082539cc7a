from dataclasses import replace

import numpy as np

from geometry.polyhedra.construct import selected, with_own_points
from geometry.polyhedra.measures import bounds, volumes
from geometry.specimens.boxes import boxes


def row():
    """Three cubes in a row, which share the corners between them."""
    blocks = boxes([(f"b{k}", (k, 0, 0), (1, 1, 1), "g", k, (1, 1, 1)) for k in range(3)], 1.0).blocks
    points, number = np.unique(blocks.points, axis=0, return_inverse=True)
    return replace(blocks, points=points, face_points=number.reshape(-1)[blocks.face_points])


def test_corners_that_blocks_share_are_parted():
    shared = row()
    own = with_own_points(shared)
    assert len(shared.points) == 16 and len(own.points) == 24
    for f in range(18):
        np.testing.assert_array_equal(own.face(f), shared.face(f))
    np.testing.assert_array_equal(with_own_points(own).points, own.points)


def test_selected_blocks_are_the_same_blocks_in_the_order_asked_for():
    blocks = row()
    few = selected(blocks, np.array([2, 0]))
    assert few.unit.tolist() == [2, 0] and len(few.points) == 16
    np.testing.assert_array_equal(bounds(few)[0], bounds(blocks)[0][[2, 0]])
    np.testing.assert_allclose(volumes(few), 1.0)
    for mine, theirs in zip(
        [*few.faces_of(0), *few.faces_of(1)], [*blocks.faces_of(2), *blocks.faces_of(0)], strict=True
    ):
        np.testing.assert_array_equal(few.face(mine), blocks.face(theirs))

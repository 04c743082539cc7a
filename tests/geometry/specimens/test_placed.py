"""Where a specimen stands: turned about an axis, and on a floor."""

import numpy as np
import pytest

from geometry.blocks import GeometryError
from geometry.joints.find import find_joints
from geometry.polyhedra.measures import moments, volumes
from geometry.specimens.boxes import boxes
from geometry.specimens.placed import on_floor, rotation, turned
from geometry.specimens.stacked import prism

BLOCK = boxes([("block", (0.0, 0.0, 0.0), (0.3, 0.2, 1.0), "units", 0, (1, 1, 1))], 0.06)


def test_a_turn_is_that_of_the_right_hand_about_the_axis_and_the_point():
    assert rotation((0, 0, 1), np.pi / 2) @ (1, 0, 0) == pytest.approx((0, 1, 0), abs=1e-15)
    assert turned(np.array([[2.0, 0.0, 0.0]]), (0, 1, 0), np.pi / 2, (1, 0, 0))[0] == pytest.approx((1, 0, -1))


@pytest.mark.parametrize("axis", np.eye(3).tolist())
def test_volume_and_principal_moments_stay_whatever_the_turn(axis):
    blocks = BLOCK.blocks
    new = type(blocks)(turned(blocks.points, axis, 0.7, (1, 2, 3)), *list(vars(blocks).values())[1:])
    assert volumes(new) == pytest.approx(volumes(blocks), rel=1e-14)
    assert np.linalg.eigvalsh(moments(new)[2]) == pytest.approx(np.linalg.eigvalsh(moments(blocks)[2]), rel=1e-12)


def test_a_floor_is_one_block_more_with_names_of_its_own_and_carries_the_specimen():
    stack = prism(3, 0.2, 0.1, 0.05)
    placed = on_floor(stack)
    assert placed.blocks.count == stack.blocks.count + 1
    assert placed.blocks.groups == ("units", "floor") and placed.sets["floor"].tolist() == [3]
    assert placed.blocks.unit[3] not in placed.blocks.unit[:3]
    assert np.array_equal(placed.blocks.points[: len(stack.blocks.points)], stack.blocks.points)
    joints = find_joints(placed.blocks)
    below = joints.block_b == 3
    assert set(joints.block_a[below]) == {0}
    assert joints.area[below].sum() == pytest.approx(0.2 * 0.1, rel=1e-12)
    assert np.ptp(placed.blocks.points[-8:, :2], axis=0) == pytest.approx((0.2 + 0.8, 0.1 + 0.8))
    assert placed.blocks.points[-8:, 2].max() == 0.0


def test_a_floor_lies_where_it_is_asked_for():
    corners = on_floor(BLOCK, -0.5, (3.0, 2.0), 0.25).blocks.points[-8:]
    assert (corners.min(axis=0), corners.max(axis=0)) == (
        pytest.approx((-1.35, -0.9, -0.75)),
        pytest.approx((1.65, 1.1, -0.5)),
    )


def test_a_floor_within_the_specimen_or_a_second_one_is_refused():
    for level in (0.1, 10.0):
        with pytest.raises(GeometryError, match=rf"floor.level: {level:g} m is above the lowest corner .* allowed is"):
            on_floor(BLOCK, level)
    with pytest.raises(GeometryError, match="group or a set 'floor' already"):
        on_floor(on_floor(BLOCK))

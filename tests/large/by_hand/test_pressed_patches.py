"""The largest compression of patches is that of the points that press, whatever stress the joint has as a whole."""

import numpy as np
import pytest

from masonry.configuration.energy import Seen
from masonry.laboratory import laboratory
from masonry.monitors.collisions.pressed_patches import PressedPatches
from masonry.monitors.observer import View
from tests.large.by_hand.test_crushed_patches import ASKEW, DEPTH, FAR, FORCE, KN, LENGTH, STRENGTH, Joint
from tests.large.by_hand.test_crushing_runs import AFFINE, CAP, rocking
from tests.large.by_hand.test_crushing_runs import STRENGTH as STRENGTH_OF_CAP

NOTHING = View(Seen(*np.zeros((4, 0))))


def compression(joint: Joint) -> float:
    pressed = PressedPatches(joint.model)
    pressed.look(joint.model, NOTHING, 0)
    return float(pressed.pressed.max())


@pytest.mark.parametrize(("way", "origin"), [(np.eye(3), np.zeros(3)), (ASKEW, FAR)])
def test_a_block_that_turns_presses_by_its_overlap_at_the_edge_until_that_is_cut_off(way, origin):
    joint = Joint(along=10, way=way, origin=origin)
    down = FORCE / (KN * LENGTH * DEPTH)
    joint.press(0.0, down)
    assert compression(joint) == pytest.approx(KN * down, rel=1e-6)
    angle = 0.5 * down / LENGTH
    joint.press(angle, down)
    assert compression(joint) == pytest.approx(KN * (down + 0.5 * LENGTH * angle), rel=1e-4)
    joint.press(20.0 * angle, down)  # ten times the strength, if it bore that
    assert compression(joint) == pytest.approx(STRENGTH, rel=1e-6)


def test_once_pressed_it_is_remembered():
    joint = Joint()
    pressed = PressedPatches(joint.model)
    joint.press(0.0, FORCE / (KN * LENGTH * DEPTH))
    pressed.look(joint.model, NOTHING, 0)
    most = pressed.pressed.copy()
    joint.press(0.0, -1e-3)
    pressed.look(joint.model, NOTHING, 1)
    assert np.array_equal(pressed.pressed, most) and most.max() > 0.0


@pytest.mark.slow
def test_a_block_that_deforms_and_rocks_is_not_pressed_by_more_than_its_cap():
    summary = laboratory.run(rocking(CAP, 0.25, changes=AFFINE)).summary
    assert summary.compression_max_pa == pytest.approx(STRENGTH_OF_CAP, rel=1e-3)
    assert summary.compression_max_pa <= STRENGTH_OF_CAP * (1.0 + 1e-9)

"""Measures of cracks, on a small wall whose crack is known: 0.5 m long, 0.4 m high, parted in the middle."""

import dataclasses

import numpy as np
import pytest

from masonry.laboratory.result import Result
from tests.results.sample import DEPTH, HEIGHT, LENGTH, sample
from verification.paper.walls.crack_path import crack_path

SECTION = 4 * HEIGHT * DEPTH


def parted(**changes: np.ndarray) -> Result:
    """A wall that opened by 0.2 mm at every joint between its right half and its left half; units are whole."""
    made = sample()
    blocks, joints = made.specimen.blocks, made.joints
    within = blocks.unit[joints.block_a] == blocks.unit[joints.block_b]
    plate = (blocks.group[joints.block_a] == 1) | (blocks.group[joints.block_b] == 1)
    made.joint_groups = ("plate", "unit_unit", "within_units")
    made.joint_group = np.where(plate, 0, np.where(within, 2, 1))
    made.specimen = dataclasses.replace(made.specimen, section=SECTION)
    frame = made.history.frames[-1]
    full = {"damage_tension": np.where(frame.damage_tension > 0.5, 1.0, 0.0)}
    full["damage_shear"] = np.where(frame.damage_shear > 0.5, 1.0, 0.0)
    made.history.frames[-1] = dataclasses.replace(frame, **{**full, **changes})
    return made


def test_a_stepped_crack_goes_through_one_head_joint_a_course_and_half_a_unit_of_bed_between_two():
    crack = crack_path(parted())
    assert crack.sections() == pytest.approx(1.0)
    fractions = crack.fractions()
    assert fractions["units"] == 0.0
    assert fractions["head joints"] == pytest.approx(1.0)
    assert fractions["bed joints"] == pytest.approx(3 * 0.5 * LENGTH * DEPTH / SECTION)


def test_the_place_of_a_stepped_crack_is_between_its_head_joints():
    middle, spread = crack_path(parted()).place()
    assert middle == pytest.approx(1.25 * LENGTH)
    assert spread == pytest.approx(0.25 * LENGTH)


def test_a_straight_crack_at_mid_length_has_no_spread_and_is_not_off_the_middle_of_units():
    made = parted()
    blocks, joints = made.specimen.blocks, made.joints
    straight = (np.abs(joints.point[:, 0] - LENGTH) < 1e-9) & (np.abs(joints.normal[:, 0]) > 0.5)
    one = np.where(straight, 1.0, 0.0)
    crack = crack_path(parted(damage_tension=one, damage_shear=0 * one, opening=1e-4 * one))
    assert crack.place() == pytest.approx((LENGTH, 0.0))
    assert crack.off_mid_length() == pytest.approx(0.0, abs=1e-12)
    assert crack.fractions() == pytest.approx({"head joints": 0.5, "units": 0.5, "bed joints": 0.0})
    assert len(blocks.unit) > 0


def test_a_crack_that_closed_again_has_no_place_and_a_sound_wall_none_either():
    made = parted()
    with pytest.raises(ValueError, match="nothing is broken and open"):
        crack_path(parted(opening=0.0 * made.joints.area)).place()
    with pytest.raises(ValueError, match="nothing is broken and open"):
        crack_path(made, made.history.frames[0]).place()


def test_bed_joints_that_slide_under_friction_carry_their_shear_over_the_section():
    made = parted()
    friction = np.full(len(made.joints.area), 2e4)
    crack = crack_path(parted(shear_stress=friction))
    assert crack.stress_carried(crack.bed) == pytest.approx(2e4 * 3 * 0.5 * LENGTH * DEPTH / SECTION)


def test_head_joints_that_only_open_do_not_slide_and_those_that_also_slide_do():
    made = parted()
    crack = crack_path(made)
    assert crack.head_joint_slip() == 0.0
    opening = made.history.frames[-1].opening
    slid = crack_path(parted(slip=0.3 * opening))
    assert slid.head_joint_slip() == pytest.approx(0.3)

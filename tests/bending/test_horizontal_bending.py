"""The wall of Fig. 20 in bending, with and without pre-compression, within bounds from the strengths alone."""

from functools import cache

import numpy as np
import pytest

from masonry import scene
from masonry.laboratory import laboratory
from masonry.laboratory.result import Result
from verification.paper.bending.by_hand import bending_spec, wall_of
from verification.paper.bending.crack import flexural_crack


@cache
def run(name: str) -> Result:
    return laboratory.run(scene.load(name))


PRESSED = pytest.param("bending-025", 180 + 5, "mixed", marks=pytest.mark.slow)


@pytest.mark.parametrize(("name", "blocks", "word"), [("bending-0", 180 + 4, "stepped"), PRESSED])
def test_the_flexural_strength_lies_between_the_weakest_brittle_and_the_weakest_plastic_way_by_hand(name, blocks, word):
    """And the crack goes round all units, or through some of them under pressure, as the paper found."""
    result = run(name)
    low, high = wall_of(scene.load(name)).bounds()
    assert (result.summary["blocks"], result.summary["stopped"]) == (blocks, "")
    assert low < result.summary["peak_stress_pa"] < high
    assert result.summary["energy_imbalance"] < 1e-9
    assert flexural_crack(result, bending_spec(scene.load(name))).word == word


@pytest.mark.slow
def test_pre_compression_makes_the_wall_stronger():
    assert run("bending-025").summary["peak_stress_pa"] > 1.02 * run("bending-0").summary["peak_stress_pa"]


def test_the_crack_opens_on_the_side_of_the_support_rollers_between_the_loads():
    result = run("bending-0")
    joints, damage = result.joints, result.history.frames[-1].damage_tension
    inside = result.joint_group != result.joint_groups.index("rollers_units")
    broken = inside & (damage > 0.95) & (np.abs(joints.normal[:, 0]) > 0.7)
    assert np.any(broken)
    x, y = joints.point[broken, 0], joints.point[broken, 1]
    between = (x > 0.23) & (x < 0.49)  # loads at 0.248 and 0.472 m, the nearest head joints at 0.24 and 0.48 m
    assert joints.area[broken][between].sum() > 0.95 * joints.area[broken].sum()
    assert np.average(y, weights=joints.area[broken]) > 0.057


@pytest.mark.slow
def test_bed_joints_carry_the_pressure_from_the_top_to_the_plate():
    result = run("bending-025")
    frame, joints = result.history.frames[-1], result.joints
    plate = result.joint_group == result.joint_groups.index("plate")
    force = np.sum(frame.normal_stress * joints.area, where=plate)
    assert abs(force / (-0.25e6 * 0.72 * 0.114) - 1) < 1e-3


def test_while_it_is_elastic_mid_span_moves_nearly_23_20_as_far_as_the_loads():
    """At the last row without damage, as a beam that bends alone; shear and pressed rollers take a little off."""
    rows = run("bending-0").history.rows
    last = int(np.argmax(rows["fracture_mode_1"] + rows["fracture_mode_2"] > 0)) - 1
    assert 1.12 < rows["mid-span deflection"][last] / rows["displacement"][last] < 1.15

"""Walls of the laboratory from their tables: what they bear beside the measured forces, the formula and other sizes."""

from functools import cache

import pytest

import masonry
from masonry.laboratory import laboratory
from masonry.scene import load

LARGER = {"specimen.courses": 10, "specimen.units_per_course": 5, "drive.displacement": "3 mm"}


def stress_block(length, thickness, height, force, weight, strength):
    """N, of a wall that is clamped at both ends, whose toes bear their strength."""
    moments = [0.5 * n * length * (1.0 - n / (length * thickness * strength)) for n in (force, force + weight)]
    return sum(moments) / height


@cache
def peak(**changes):
    settings = {key.replace("__", "."): value for key, value in changes.items()}
    return laboratory.run(load("shear-wall-size", settings)).summary.peak_force_n


def test_walls_of_hollow_blocks_bear_what_was_measured_within_a_fifth():
    assert peak(drive__displacement="3 mm") == pytest.approx(0.5 * (107.5e3 + 99.4e3), rel=0.2)
    assert peak(drive__displacement="3 mm", confinement="1.408 MPa") == pytest.approx(0.5 * (129e3 + 137e3), rel=0.2)


def test_larger_walls_of_one_material_bear_less_over_their_section():
    larger = peak(**{key.replace(".", "__"): value for key, value in LARGER.items()})
    share = larger / peak(drive__displacement="3 mm") / (5.0 / 3.5)
    assert 0.94 < share < 1.0


@pytest.mark.slow
@pytest.mark.parametrize(
    ("confinement", "measured"), [(0.52e6, (59.1e3, 58.4e3)), (0.86e6, (92.6e3, 92.6e3)), (1.2e6, (120e3, 122.7e3))]
)
def test_a_wall_that_bends_bears_its_stress_block_and_what_was_measured(confinement, measured):
    summary = laboratory.run(load("shear-wall-flexure", {"confinement": f"{confinement!r} Pa"})).summary
    section = 1.199 * 0.208
    by_hand = stress_block(1.199, 0.208, 2.7, confinement * section, 18e3 * section * 2.7, 11.22e6)
    assert summary.peak_force_n == pytest.approx(by_hand, rel=0.02)
    assert summary.peak_force_n == pytest.approx(sum(measured) / 2.0, rel=0.05)


@pytest.mark.slow
def test_a_dry_wall_that_turns_about_its_corners_bears_what_limit_analysis_says():
    scene = load("wall-ws100", {"specimen.patch_points_per_edge": 2})
    assert laboratory.run(scene).summary.peak_force_n == pytest.approx(masonry.limit(scene).factor, rel=0.02)


@pytest.mark.slow
def test_a_dry_wall_on_a_toe_of_some_width_has_the_measured_curve():
    beside = laboratory.run(load("wall-ws100")).summary.beside_measured
    assert beside.farthest_apart < 0.08 and abs(beside.peak_difference) < 0.04
    assert beside.stiffness_difference == pytest.approx(0.0, abs=0.1)
    assert abs(beside.energy_difference) < 0.02


def test_a_square_wall_on_its_corner_splits_and_has_the_numbers_of_the_standard():
    summary = laboratory.run(load("diagonal-compression", {"drive.accuracy": "5 %"})).summary
    assert summary.standard.strength_pa == pytest.approx(0.7071 * summary.peak_force_n / 0.1245, rel=2e-3)
    assert summary.standard.strength_pa == pytest.approx(0.368e6, rel=0.05)
    assert summary.final_stress_pa < 0.6 * summary.peak_stress_pa

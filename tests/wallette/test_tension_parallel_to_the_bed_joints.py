"""The two wallettes of section 5 of the paper, against the bounds that hold for any way of cracking (physics.md)."""

from functools import cache

import numpy as np
import pytest

from masonry import scene
from masonry.laboratory import laboratory
from masonry.laboratory.result import Result

HEAD_JOINTS_GONE, ALL_JOINTS_AT_PEAK = 0.114e6, 0.214e6


@cache
def run(name: str, *overrides: str) -> Result:
    return laboratory.run(scene.load(name, list(overrides)))


def dissipated(result: Result) -> float:
    energy = result.summary["energy_j"]
    return energy["fracture_mode_1"] + energy["fracture_mode_2"] + energy["friction"]


def test_mode_1_peaks_between_the_bounds_of_plastic_limit_analysis():
    summary = run("wallette-mode-1").summary
    assert summary["blocks"] >= 200
    assert HEAD_JOINTS_GONE < summary["peak_stress_pa"] < ALL_JOINTS_AT_PEAK


def test_mode_1_breaks_no_unit_and_steps_through_head_and_bed_joints():
    result = run("wallette-mode-1")
    assert result.summary["damaged_area_m2"]["within_units"] == 0.0
    damage = result.history.frames[-1].damage
    joints = result.joint_group == result.joint_groups.index("unit_unit")
    along_x = np.abs(result.joints.normal[:, 0]) > 0.5
    for kind in (along_x, ~along_x):
        assert np.any(damage[joints & kind] > 0.95), "a stepped crack opens head joints and slides on bed joints"


def test_mode_1_opens_head_joints_in_tension_and_bed_joints_in_shear():
    result = run("wallette-mode-1")
    frame = result.history.frames[-1]
    joints = result.joint_group == result.joint_groups.index("unit_unit")
    head = joints & (np.abs(result.joints.normal[:, 0]) > 0.5) & (frame.damage > 0.95)
    bed = joints & (np.abs(result.joints.normal[:, 2]) > 0.5) & (frame.damage > 0.95)
    assert np.all(frame.damage_tension[head] > 0.9)
    assert np.mean(frame.damage_shear[bed] > 0.9) > 0.9


def test_mode_1_costs_the_energy_of_one_stepped_crack():
    result = run("wallette-mode-1")
    energy = result.summary["energy_j"]
    per_area = (energy["fracture_mode_1"] + energy["fracture_mode_2"]) / result.summary["section_m2"]
    assert per_area == pytest.approx(16.4, rel=0.1)


@pytest.mark.slow
def test_mode_1_hardly_feels_the_loading_rate():
    fast, slow = run("wallette-mode-1", "drive.rate=1 mm/s"), run("wallette-mode-1", "drive.rate=0.5 mm/s")
    assert slow.summary["peak_stress_pa"] == pytest.approx(fast.summary["peak_stress_pa"], rel=0.01)
    assert dissipated(slow) == pytest.approx(dissipated(fast), rel=0.02)


HINGE = 'support.1.fix=["y"]'
"""Mode 1 in the rig of mode 2: the right plate is on a hinge."""


def test_mode_2_finds_in_fewer_steps_what_a_slow_constant_rate_finds():
    shipped, constant = run("wallette-mode-2"), run("wallette-mode-2", "drive.rate=0.5 mm/s")
    assert shipped.summary["steps"] < 0.4 * constant.summary["steps"]
    assert shipped.summary["peak_stress_pa"] == pytest.approx(constant.summary["peak_stress_pa"], rel=0.01)
    assert dissipated(shipped) == pytest.approx(dissipated(constant), rel=0.01)


def test_mode_1_as_shipped_finds_what_a_slow_constant_rate_finds():
    shipped, constant = run("wallette-mode-1"), run("wallette-mode-1", "drive.rate=0.5 mm/s")
    assert shipped.summary["peak_stress_pa"] == pytest.approx(constant.summary["peak_stress_pa"], rel=0.01)
    assert dissipated(shipped) == pytest.approx(dissipated(constant), rel=0.01)


def test_mode_1_falls_smoothly_upright_and_rests_before_one_last_fall_on_a_hinge():
    upright, hinge = (steepest_late_fall(run("wallette-mode-1", *rig)) for rig in ((), (HINGE,)))
    assert upright < 0.1 < hinge


def steepest_late_fall(result: Result) -> float:
    """Largest fall within 5 um of displacement, from twice the displacement of the peak on, over the peak."""
    rows, peak = result.history.rows, result.summary["peak_stress_pa"]
    u = np.arange(2.0 * result.summary["displacement_at_peak_m"], rows["displacement"][-1] - 5e-6, 1e-6)
    early, late = (np.interp(at, rows["displacement"], rows["stress"]) for at in (u, u + 5e-6))
    return float((early - late).max() / peak)


@pytest.mark.parametrize("name", ["wallette-mode-1", pytest.param("wallette-mode-1-218", marks=pytest.mark.slow)])
def test_where_dilation_ends_moves_what_is_left_of_mode_1_and_not_its_peak(name):
    short, long = (run(name, f"contact.unit_unit.dilation_cutoff={cutoff} mm") for cutoff in ("0.05", "0.2"))
    assert long.summary["peak_stress_pa"] == pytest.approx(short.summary["peak_stress_pa"], rel=1e-3)
    assert long.summary["final_stress_pa"] > 2.0 * short.summary["final_stress_pa"] > 0.0


def test_mode_2_peaks_below_the_bound_of_all_sections_at_their_strength():
    assert run("wallette-mode-2").summary["peak_stress_pa"] <= 0.225e6


def test_mode_2_cracks_units_and_head_joints_in_one_section_and_spares_the_bed_joints():
    result = run("wallette-mode-2")
    broken = result.history.frames[-1].damage > 0.95
    for group in ("unit_unit", "within_units"):
        assert np.any(broken & (result.joint_group == result.joint_groups.index(group)))
    assert np.all(np.abs(result.joints.normal[broken, 0]) > 0.5)
    assert np.ptp(result.joints.point[broken, 0]) < 0.01, "one straight crack"


def test_mode_2_costs_the_fracture_energy_of_one_section():
    result = run("wallette-mode-2")
    energy = result.summary["energy_j"]
    per_area = (energy["fracture_mode_1"] + energy["fracture_mode_2"]) / result.summary["section_m2"]
    assert per_area == pytest.approx(8.0, rel=0.25)


@pytest.mark.parametrize("name", ["couplet", "wallette-mode-1", "wallette-mode-2"])
def test_the_energy_balance_of_a_shipped_scene_closes_in_two_independent_ways(name):
    summary = run(name).summary
    assert summary["energy_imbalance"] < 1e-9
    assert summary["dissipation_mismatch"] < 1e-3


@pytest.mark.parametrize("name", ["couplet", "wallette-mode-1", "wallette-mode-2"])
def test_a_shipped_scene_is_quasi_static(name):
    summary = run(name).summary
    assert summary["reaction_mismatch_max"] < 0.02
    assert summary["kinetic_over_internal_max"] < 0.01

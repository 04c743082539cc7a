"""The couplet with a bed of random cells against the closed form of the bare joint, physics.md."""

import pytest

from masonry import scene
from masonry.laboratory import laboratory

T_MAX, T_RES = 0.971e6, 0.073e6


def test_a_bed_of_100_cells_is_a_little_weaker_than_the_bare_joint_and_slides_on_friction_in_the_end():
    """Stress along it is not uniform: below the joint's own peak; its tail is still above the residual strength."""
    summary = laboratory.run(scene.load("couplet-meso-coarse")).summary
    assert (summary["blocks"], summary["stopped"]) == (102, "")
    assert 0.9 * T_MAX < summary["peak_stress_pa"] < T_MAX
    assert T_RES < summary["final_stress_pa"] < 1.1 * T_RES
    assert summary["energy_imbalance"] < 1e-9
    broken = summary["broken_area_m2"]
    assert broken["unit_mortar"] == pytest.approx(0.2 * 0.005, rel=0.2), "the interfaces part over one length"

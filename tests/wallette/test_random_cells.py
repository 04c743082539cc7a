"""The wallettes of random cells, within the bounds that hold for any way of cracking (physics.md)."""

from functools import cache

import numpy as np

from masonry import scene
from masonry.laboratory import laboratory
from masonry.laboratory.result import Result

HEAD_JOINTS_GONE, ALL_JOINTS_AT_PEAK, ALL_AT_PEAK_MODE_2 = 0.114e6, 0.214e6, 0.225e6


@cache
def run(name: str) -> Result:
    return laboratory.run(scene.load(name))


def test_mode_1_of_218_cells_breaks_no_unit_and_peaks_as_the_wall_of_a_grid_does():
    result = run("wallette-mode-1-218")
    summary = result.summary
    assert (summary["blocks"], summary["stopped"]) == (218 + 2, "")
    assert HEAD_JOINTS_GONE < summary["peak_stress_pa"] < ALL_JOINTS_AT_PEAK
    assert summary["broken_area_m2"]["within_units"] == 0.0
    assert summary["energy_imbalance"] < 1e-9 and summary["reaction_mismatch_max"] < 0.02


def test_mode_2_of_218_cells_cracks_through_units_and_head_joints():
    result = run("wallette-mode-2-218")
    summary = result.summary
    assert 0.8 * ALL_AT_PEAK_MODE_2 < summary["peak_stress_pa"] < ALL_AT_PEAK_MODE_2
    damage, joints = result.history.frames[-1].damage, result.joints
    unit, joint = (result.joint_group == result.joint_groups.index(g) for g in ("within_units", "unit_unit"))
    broken = damage > 0.9
    assert np.any(broken & unit) and np.any(broken & joint & (np.abs(joints.normal[:, 0]) > 0.9))
    across = joints.area[broken & (unit | joint)] * np.abs(joints.normal[broken & (unit | joint), 0])
    share = across.sum() / summary["section_m2"]
    assert 0.8 < share < 1.1, "one crack from the top nearly to the bottom, where the wall turns on what is left"

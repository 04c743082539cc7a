"""Joints that tear from one side: where the rows of their contact points decide the answer, a run says so."""

from pathlib import Path

import pytest

import verification
from masonry.judgement.trust import trust
from masonry.laboratory import laboratory
from masonry.scene import load

TORN = Path(verification.__file__).parent / "scenes" / "joint-torn-from-one-side.toml"
BENT = {
    "drive.steps": None,
    "drive.accuracy": 0.02,
    "drive.displacement": "60 um",
    "specimen.box.1.size": ["0.3 m", "0.05 m", "0.05 m"],
}


def torn(rows: int):
    """A joint that is pulled far beside its middle, with so many rows of points across."""
    return laboratory.run(load(TORN, {**BENT, "specimen.points_per_edge": {"x": rows, "y": 1}}))


def test_few_rows_of_points_change_the_answer_and_a_run_with_them_says_so():
    few, more, many = torn(2), torn(6), torn(12)
    peak = many.summary["peak_stress_pa"]
    assert (
        abs(few.summary["peak_stress_pa"] / peak - 1.0) > 0.1 > 0.05 > abs(more.summary["peak_stress_pa"] / peak - 1.0)
    )
    assert "with 2 rows of contact points across" in trust(few.summary)
    for result in (more, many):
        assert "rows of contact points" not in trust(result.summary)


@pytest.mark.parametrize("scene", ["couplet", "wallette-mode-1"])
def test_joints_that_are_pulled_as_a_whole_or_cells_that_crack_need_no_such_word(scene):
    changes = {} if scene == "couplet" else {"specimen.divisions": [4, 2], "drive.accuracy": 0.02}
    assert "rows of contact points" not in trust(laboratory.run(load(scene, changes)).summary)


def test_a_joint_that_is_pulled_open_evenly_and_shut_again_has_not_bent():
    pulled = {"drive.direction": "z", "drive.displacement": None, "drive.history": ["0.5 mm", "-0.01 mm"]}
    summary = laboratory.run(load("couplet", {**pulled, "confinement": "0 MPa", "drive.accuracy": "5 %"})).summary
    assert summary["broken_area_m2"]["unit_unit"] > 0.0 > summary["lowest_stress_pa"]
    assert "rows of contact points" not in trust(summary)

"""Scenes of dry joints with an answer by hand: what is said of them is true, and no more."""

import pytest

from masonry.judgement.judgement import judgement_of
from masonry.judgement.sentence import trust
from masonry.laboratory import laboratory
from masonry.scene import load as load_scene
from tests.scenes import box, listed, load, specimen, tables

DRY = 'law = "friction"\nnormal_stiffness = "30 GPa/m"\nshear_stiffness = "12 GPa/m"\ntan_friction_angle = 0.65'
WEIGHT = '[gravity]\nz = "-10 m/s^2"\n'
DENSITY = 'density = "1000 kg/m^3"'
GROUND, BLOCK = (
    box("ground", (-0.4, 0, -0.1), (1, 0.1, 0.1), "units", 0),
    box("block", (0, 0, 0), (0.2, 0.1, 0.5), "units", 1),
)
FLAT = box("block", (0, 0, 0), (0.2, 0.1, 0.1), "units", 1)
HELD = 'on = "ground"\nfix = "all"'


def scene(boxes, supports, more, points="vertex"):
    text = specimen(boxes, 0.02, more=f'contact_points = "{points}"') + tables("material", {"units": DENSITY})
    return load(text + tables("contact", {"unit_unit": DRY}) + listed("support", supports) + more)


def drive(on: str, direction: str, displacement: str) -> str:
    return f'[drive]\non = "{on}"\ndirection = "{direction}"\ndisplacement = "{displacement}"\n'


def test_a_pier_that_sinks_under_a_lintel_bears_what_statics_leaves_it_and_the_two_ends_agree():
    """The lintel of 100 N turns about the inner edge of the left pier, 0.3 m from its middle, and lies on the outer
    edge of the right one, 0.5 m on the other side; the right pier itself weighs 40 N."""
    piers = [box(f"pier {k}", (0.8 * k, 0, 0), (0.2, 0.1, 0.2), "units", k) for k in (0, 1)]
    lintel = box("lintel", (0, 0, 0.2), (1, 0.1, 0.1), "units", 2)
    held = ['on = "pier 0"\nfix = "all"', 'on = "pier 1"\nfix = ["x", "y", "rotation"]']
    result = laboratory.run(scene([*piers, lintel], held, WEIGHT + drive("pier 1", "-z", "0.5 mm")))
    assert -result.history.rows["force"][-1] == pytest.approx(100 * 0.3 / 0.8 + 40, rel=1e-6)
    assert result.history.rows["support_stress"][-1] == pytest.approx(result.history.rows["stress"][-1], rel=1e-6)
    assert result.summary["reaction_mismatch_max"] < 0.01 and "with care" not in trust(result.summary)
    assert result.summary["steps"] < 100_000


def test_a_block_that_is_only_lifted_leaves_the_energy_balance_closed():
    summary = laboratory.run(scene([GROUND, FLAT], [HELD], WEIGHT + drive("block", "z", "1 mm"))).summary
    assert summary["peak_force_n"] == pytest.approx(20.0, rel=1e-9)
    assert summary["energy_imbalance"] < 1e-12 and "with care" not in trust(summary)


def test_pressing_alone_releases_nothing():
    summary = laboratory.run(scene([GROUND, FLAT], [HELD], drive("block", "-z", "0.1 mm"))).summary
    assert summary["peak_force_n"] == pytest.approx(30e9 * 0.02 * 1e-4, rel=1e-9)
    assert summary["sudden_cracks"] == []
    assert [doubt.name for doubt in judgement_of(summary).doubts] == ["still_rising"], "nothing crushes"


@pytest.mark.parametrize(("push", "stands"), [(0.64, True), (0.656, False)])
def test_what_still_slides_at_the_end_under_a_load_that_varies_is_not_at_rest(push, stands):
    pushed = f'on = "block.z+"\nstress = {{x = "{push} kPa"}}\nhistory = [["0 s", 0], ["0.1 s", 1], ["0.2 s", 1]]'
    summary = laboratory.run(scene([GROUND, FLAT], [HELD], WEIGHT + listed("traction", [pushed]))).summary
    assert summary["unbalanced_after_settling"] < 1e-9
    alone = [doubt.name for doubt in judgement_of(summary).doubts] == ["closed_joints"]
    assert alone == stands, "at rest, on two points along an edge"
    assert ("still moves at the end" in trust(summary)) != stands


@pytest.mark.parametrize(("points", "arm"), [("vertex", 1.0), ("gauss", 3**-0.5)])
def test_a_dry_block_that_rocks_on_points_within_its_joint_is_doubted(points, arm):
    """At mid-height, 0.25 m, with half its width of 0.1 m and its weight of 100 N."""
    planar = 'on = "block"\nfix = ["y", "rotation x", "rotation z"]'
    rocking = scene([GROUND, BLOCK], [HELD, planar], WEIGHT + drive("block", "x", "1 mm"), points)
    told = [line for line in laboratory.check(rocking)["warnings"] if "outermost contact points" in line]
    result = laboratory.run(rocking)
    assert result.history.rows["force"][-1] == pytest.approx(100 * 0.1 / 0.25 * arm, rel=1e-3)
    assert bool(told) == (points == "gauss")
    off = [doubt.value for doubt in judgement_of(result.summary).doubts if doubt.name == "few_points"]
    assert off == ([pytest.approx(arm - 1.0, abs=0.01)] if points == "gauss" else [])


@pytest.mark.parametrize(
    ("block", "fixed", "direction", "hinge"),
    [
        (BLOCK, ["y", "rotation x", "rotation z"], "x", True),
        (FLAT, ["y", "rotation"], "x", False),
        (FLAT, [], "z", False),
    ],
)
def test_a_dry_block_on_one_row_of_points_bears_nothing_where_it_would_rock_and_the_run_says_so(
    block, fixed, direction, hinge
):
    """It would bear 40 N; one that slides bears 13, and one that is lifted its weight, whatever the points are."""
    held = [HELD, *([f'on = "block"\nfix = {fixed}'] if fixed else [])]
    one = scene([GROUND, block], held, WEIGHT + drive("block", direction, "1 mm"), "gauss")
    summary = laboratory.run(one.with_({"specimen.points_per_edge": {"x": 1, "y": 2, "z": 2}})).summary
    assert ("bear no moment there, as a hinge: the peak may be far too low" in trust(summary)) == hinge
    assert (summary["peak_force_n"] < 1.0) == hinge


def test_dry_joints_that_only_slide_or_cannot_rock_are_not_doubted():
    triplet = load_scene("triplet-dry")
    assert laboratory.check(triplet)["warnings"] == []
    slides = scene([GROUND, FLAT], [HELD], WEIGHT + drive("block", "x", "1 mm"), "gauss")
    assert "with care" not in trust(laboratory.run(slides.with_({"support.0.fix": "all"})).summary)

"""Walls with openings, whose joints open, slide and close again before they fall: a run beside limit analysis."""

import numpy as np
import pytest

import masonry
from verification.cases.friction.collapse_in_one_run import WALL, dilating
from verification.fixtures.walls_with_openings import specimen, wall_3, wall_of

FRICTION = 0.65


def by_limit_and_by_run(wall: dict, friction: float, **contact) -> tuple[float, float, float, list[str]]:
    """(factor of limit analysis, borne by a run, not borne, what limit analysis remarks)."""
    keys = {f"contact.unit_unit.{key}": value for key, value in contact.items()}
    scene = masonry.load(WALL, {**wall, **dilating(friction), **keys})
    found, run = masonry.limit(scene), masonry.run(scene).summary["collapse_load"]
    assert run["undecided"] == 0
    return found.factor, run["borne"], run["falls"], found.remarks


def test_wall_3_of_ferris_and_tin_loi_falls_in_a_run_where_associated_flow_says():
    limit, borne, falls, remarks = by_limit_and_by_run(wall_3(), FRICTION)
    assert limit == pytest.approx(0.40369, abs=1e-5), "published"
    assert 0.995 * limit < borne < falls < 1.005 * limit
    assert not any("--no-dilation" in remark for remark in remarks)


@pytest.mark.parametrize("seed", [11, *(pytest.param(k, marks=pytest.mark.slow) for k in range(20) if k != 11)])
def test_a_wall_with_openings_that_dilates_by_its_friction_falls_within_1_percent_of_limit_analysis(seed):
    limit, borne, falls, _ = by_limit_and_by_run(*wall_of(seed))
    assert 0.99 * limit < borne and falls < 1.01 * limit


HALF = f"{float(np.degrees(np.arctan(0.5 * FRICTION)))!r} deg"


@pytest.mark.slow
def test_half_the_dilation_holds_more_than_none_and_no_more_than_all_of_it():
    limit, borne, falls, _ = by_limit_and_by_run(wall_3(), FRICTION, dilation_angle=HALF)
    none = masonry.run(masonry.load(WALL, wall_3())).summary["collapse_load"]
    assert 1.02 * none["falls"] < borne < limit and falls < 1.005 * limit


@pytest.mark.parametrize("ratio", [1.0, 0.5])
def test_a_block_that_slides_rises_by_its_dilation_and_spends_the_rest_of_its_friction(ratio):
    """By hand: tan(psi) times the slip, and (mu - tan(psi)) N times it, N the weight across the plane that leans."""
    block = specimen([[(1, 2)]], 0.4, 0.175)
    block["specimen"]["box"][0]["size"][0] = "1 m"
    angle = f"{float(np.degrees(np.arctan(ratio * FRICTION))) - 1e-9!r} deg"
    scene = masonry.load(WALL, {**block, **dilating(FRICTION), "contact.unit_unit.dilation_angle": angle})
    limit, run = masonry.limit(scene), masonry.run(scene)
    words = [remark for remark in limit.remarks if "rise less, so that it may fall earlier" in remark]
    assert len(words) == (0 if ratio == 1.0 else 1)
    factor, last = run.summary["collapse_load"]["falls"], run.history.frames[-1]
    assert 0.995 * FRICTION < run.summary["collapse_load"]["borne"] < FRICTION < factor < 1.005 * FRICTION
    np.testing.assert_allclose(last.opening, ratio * FRICTION * last.slip, rtol=2e-3)
    pressed = 2000.0 * 0.2 * 0.15 * 0.175 * 9.81 / np.hypot(1.0, factor)
    by_hand = (1.0 - ratio) * FRICTION * pressed * last.slip.mean()
    friction = run.summary["energy_j"]["friction"]
    assert friction == pytest.approx(by_hand, rel=3e-3, abs=1e-4 * FRICTION * pressed * last.slip.mean())
    assert run.summary["dissipation_mismatch"] < 1e-3, "laws book what contacts take"


@pytest.mark.parametrize(
    "more", [{"dilation_cutoff": "0.1 mm"}, {"unloading": "elastic"}, {"tan_residual_friction_angle": 0.6}]
)
def test_joints_that_soon_stop_to_rise_have_a_word_as_well(more):
    keys = {f"contact.unit_unit.{key}": value for key, value in more.items()}
    angle = f"{float(np.degrees(np.arctan(0.6))) - 1e-9!r} deg" if "tan_residual_friction_angle" in more else None
    if angle is not None:
        keys["contact.unit_unit.dilation_angle"] = angle
    limit = masonry.limit(masonry.load(WALL, {**wall_3(), **dilating(FRICTION), **keys}))
    assert any("--no-dilation" in remark for remark in limit.remarks)

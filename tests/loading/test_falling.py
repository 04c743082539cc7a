"""A gauge that is led on behind the collapse of a load that grew: the factor against closed forms, and what is said."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import masonry
import verification
from masonry.curves.curve import curve_figure
from masonry.errors import SceneError
from masonry.laboratory.text import summary_text
from masonry.loading.collapse.branch import Branch
from masonry.loading.collapse.growing_settings import FALLING
from masonry.rows.columns import FACTOR, OFF_BALANCE
from masonry.scene import load as load_scene
from tests.loading.test_growing import ACCURACY, block
from tests.scenes import MATERIAL, box, listed, load, specimen, tables

SCENES = Path(verification.__file__).parent / "scenes"
HALF, HIGH = 0.05, 0.1
"""m, half sizes of the slender block."""
SIDEWAYS = 'pattern = "weight"\ndirection = "x"'
AIMED = FALLING.aim * ACCURACY
"""Share of the collapse factor by which the factor exceeds equilibrium."""


def led(until: str, limit: str = SIDEWAYS, friction: float = 0.9, direction: str = "x", **changes):
    """A block of which a gauge is led until it reads so much."""
    gauge = listed("gauge", [f'name = "sway"\nat = "block"\ndirection = "{direction}"'])
    return block(HALF, HIGH, friction, f'{limit}\ncontrol = "sway"\nuntil = "{until}"', more=gauge, **changes)


def branch(result) -> tuple[np.ndarray, np.ndarray]:
    """Gauge (m) and factor, row by row, behind the collapse."""
    rows, steps = result.history.rows, result.summary["collapse_load"]["branch"]["steps"]
    late = rows["step"] > rows["step"][-1] - steps
    return rows["sway"][late], rows[FACTOR][late]


def said(result) -> str:
    return " ".join(summary_text(result.summary).split())


@pytest.mark.parametrize(("friction", "until", "known"), [(0.9, "1.5 mm", 0.5), (0.3, "4 mm", 0.3)])
def test_a_mechanism_of_the_shape_as_drawn_goes_on_at_the_collapse_factor(friction, until, known):
    """It topples, or slides: in small displacement nothing changes on the way, and the factor exceeds equilibrium by
    just what the motion was meant to take."""
    result = masonry.run(led(until, friction=friction))
    found, (way, factor) = result.summary["collapse_load"]["branch"], branch(result)
    assert found["ends"] == "until" and way[-1] == pytest.approx(float(until.split()[0]) * 1e-3, rel=0.01)
    late = way > 0.1 * way[-1]
    assert factor[late] == pytest.approx(known * (1.0 + AIMED), rel=1e-4)
    assert result.history.rows[OFF_BALANCE][-len(way) :][late] == pytest.approx(AIMED, rel=0.02)
    assert result.summary["energy_imbalance"] < 1e-12 and found["leaps"] == 0
    assert "behind the collapse, and the energy balance closes" in said(result) and "with care" not in said(result)


def test_a_row_shows_where_the_branch_ends_and_the_picture_shows_the_factor_over_the_gauge():
    result = masonry.run(led("-0.5 mm", limit='pattern = "weight"\ndirection = "-x"'))
    curve = curve_figure(result).axes[0]
    assert result.summary["collapse_load"]["branch"]["reached_m"] < -0.5e-3
    assert curve.get_ylabel() == "load factor [1]" and curve.get_lines()[1].get_xdata()[-1] < -0.5


def test_a_block_that_turns_too_far_for_small_displacement_ends_the_branch():
    result = masonry.run(led("80 mm"))
    assert result.summary["collapse_load"]["branch"]["ends"] == "turned"
    assert result.summary["rotation_max_rad"] <= 0.02
    assert "more than solver.rotation_limit where gauge 'sway' was at 1." in said(result)


@pytest.mark.slow
def test_a_gauge_that_is_stopped_on_its_way_ends_the_branch_late(monkeypatch):
    """The block slides 0.5 mm and meets a stone that is held. With the patience that runs have, the load would press it
    into the stone until the gauge is where it was to be led, or until the factor is at up_to."""
    impatient = replace(FALLING, patience=1.0)
    monkeypatch.setattr(Branch.__init__, "__defaults__", (impatient,))
    boxes = [
        box("base", (-0.5, 0, -0.1), (1.0, 0.2, 0.1), "units", 0),
        box("block", (-0.1, 0, 0), (0.2, 0.2, 0.1), "units", 1),
        box("stop", (0.1005, 0, 0), (0.1, 0.2, 0.1), "units", 2),
    ]
    dry = 'normal_stiffness = "30 GPa/m"\nshear_stiffness = "12 GPa/m"\ntan_friction_angle = 0.3\nnormal_dashpot = 0.5'
    result = masonry.run(
        load(
            'law = "friction"\ndisplacements = "large"\n'
            + specimen(boxes, 0.04, more='contact_points = "vertex"')
            + tables("material", {"units": MATERIAL})
            + tables("contact", {"unit_unit": dry})
            + listed("support", ['on = "base"\nfix = "all"', 'on = "stop"\nfix = "all"'])
            + '[gravity]\nz = "-9.81 m/s^2"\n'
            + f'[limit]\n{SIDEWAYS}\naccuracy = "1 %"\ncontrol = "sway"\nuntil = "1 mm"\nup_to = 1e6\n'
            + listed("gauge", ['name = "sway"\nat = "block"\ndirection = "x"'])
        )
    )
    collapse = result.summary["collapse_load"]["branch"]
    assert collapse["ends"] == "late" and collapse["reached_m"] == pytest.approx(0.5e-3, rel=0.05)
    at = f"{1e3 * collapse['reached_m']:.4g} mm"
    assert f"gauge 'sway' came no further than {at} in {collapse['steps']} steps" in said(result)


@pytest.mark.parametrize(
    ("scene", "ends", "words"),
    [
        (lambda: led("-1 mm"), "other way", "moves gauge 'sway' away from limit.until"),
        (lambda: led("1 mm", direction="y"), "stays", "hardly moves gauge 'sway'"),
        (lambda: led("1 mm", friction=0.0), "nothing", "nothing resists it"),
        (lambda: led("1e-4 mm"), "passed", "beyond limit.until"),
    ],
)
def test_a_gauge_that_cannot_be_led_leaves_the_collapse_as_it_is_and_says_why(scene, ends, words):
    result = masonry.run(scene())
    collapse = result.summary["collapse_load"]
    assert collapse["branch"]["ends"] == ends and not collapse["branch"]["led"] and collapse["falls"] is not None
    assert words in said(result) and "was not controlled" in said(result)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"limit.control": "swoy"}, "limit.control.*'swoy' is no gauge; known here: sway; did you mean 'sway'"),
        ({"gauge": []}, "there is none: give the scene a table"),
        ({"limit.until": None}, "limit.until: missing; control needs it"),
        ({"limit.control": None}, "limit.control: missing; until needs it"),
        ({"limit.until": "0 mm"}, "limit.until: is 0"),
        ({"limit.accuracy": None}, "limit.control: .*needs accuracy"),
        ({"limit.pattern": "drive", "limit.direction": None}, "moves the drive by .drive. itself"),
    ],
)
def test_what_does_not_go_with_a_gauge_to_control_is_refused(change, words):
    with pytest.raises(SceneError, match=words):
        led("1 mm").with_(change)


def of_the_centroid(way: np.ndarray) -> np.ndarray:
    """Height of the centroid over its distance from the toe, for its way to the side: (n,) and (n,) m."""
    reach = np.hypot(HALF, HIGH)
    return np.sqrt(reach**2 - (HALF - way) ** 2), HALF - way


@pytest.mark.slow
@pytest.mark.parametrize("arm", [0.0, 0.08])
def test_a_slender_block_bears_ever_less_until_it_stands_over_its_toe(arm):
    """About the toe: factor * load * (height + arm) = weight * distance. The moment of a force does not turn with its
    block, so that the arm above the centroid stays what it was."""
    weight = 1900.0 * 9.81 * 4 * HALF * HIGH * 0.2
    at = f'pattern = "force"\non = "block"\nforce = {{x = "{weight!r} N"}}\nat = ["0 m", "100 mm", "{HIGH + arm!r} m"]'
    result = masonry.run(led("80 mm", at if arm else SIDEWAYS, displacements="large"))
    found, (way, factor) = result.summary["collapse_load"]["branch"], branch(result)
    high, far = of_the_centroid(way)
    collapse, known = HALF / (HIGH + arm), far / (high + arm)
    assert found["ends"] == "zero" and "it stands no more by itself" in said(result)
    assert way[-1] == pytest.approx(HALF, rel=0.02)
    assert np.abs(factor - known).max() < 1.3 * AIMED * collapse
    off = result.history.rows[OFF_BALANCE][-len(way) :][:-1] * collapse
    assert (factor[:-1] - off) == pytest.approx(known[:-1], abs=0.0005 * collapse), "the column tells the error"
    assert result.summary["energy_imbalance"] < 1e-11 and "with care" not in said(result)


@pytest.mark.slow
def test_half_the_share_for_the_motion_takes_root_2_as_many_steps(monkeypatch):
    scene, steps = led("20 mm", displacements="large"), []
    for share in (1.0, 0.5, 0.25):
        monkeypatch.setattr(Branch.__init__, "__defaults__", (replace(FALLING, aim=share),))
        result = masonry.run(scene)
        steps.append(result.summary["collapse_load"]["branch"]["steps"])
        way, factor = branch(result)
        high, far = of_the_centroid(way)
        assert np.abs(factor - far / high).mean() == pytest.approx(0.5 * share * ACCURACY * 0.88, rel=0.1)
    assert steps[1] / steps[0] == pytest.approx(2**0.5, rel=0.02) == steps[2] / steps[1]


@pytest.mark.slow
def test_a_joint_that_softens_drops_from_its_strength_to_dry_friction_and_takes_its_energy_of_fracture():
    bonded = {
        "law": "exponential",
        "contact.unit_unit.tensile_strength": "0.02 MPa",
        "contact.unit_unit.cohesion": "0.1 MPa",
        "contact.unit_unit.fracture_energy_mode_1": "5 N/m",
        "contact.unit_unit.fracture_energy_mode_2": "50 N/m",
    }
    result = masonry.run(led("1.8 mm", f"{SIDEWAYS}\nup_to = 1000").with_(bonded))
    found, (_, factor), rows = result.summary["collapse_load"], branch(result), result.history.rows
    assert found["borne"] > 3.0 and factor[-1] == pytest.approx(0.5, rel=0.04)
    assert np.diff(factor[factor > 0.51]).max() < 0.01 * found["borne"], "it falls steadily"
    assert 0.9 * 0.02 * 5.0 * 0.5 < rows["fracture_mode_1"][-1] < 0.02 * 5.0, "all but the row about which it turns"
    assert result.summary["energy_imbalance"] < 1e-12 and result.summary["dissipation_mismatch"] < 1e-5


@pytest.mark.slow
def test_an_arch_is_led_along_the_curve_that_a_drive_makes():
    arch, settle = SCENES / "arch-of-oppenheim.toml", {"steps": 8000}
    crown = [{"name": "sway", "at": "keystone", "direction": "x"}]
    push = {"pattern": "force", "on": "keystone", "force": {"x": "1 kN"}, "accuracy": 0.01}
    alike = {"displacements": "large", "gauge": crown, "settle": settle}
    way, factor = branch(masonry.run(load_scene(arch, alike | {"limit": push | {"control": "sway", "until": "40 mm"}})))
    drive = {"on": "keystone", "direction": "x", "displacement": "40 mm", "steps": 200_000}
    rows = masonry.run(load_scene(arch, alike | {"limit": None, "drive": drive, "solver.rows": 400})).history.rows
    late = way > 0.008  # the drive sets out with its full speed
    known = np.interp(way[late], rows["displacement"], rows["force"] / 1e3)
    assert factor[late] == pytest.approx(known, abs=0.01 * factor.max())


@pytest.mark.slow
def test_a_soft_arch_of_15_voussoirs_goes_on_at_its_factor():
    soft = {
        "specimen.voussoirs": 15,
        "contact.unit_unit.normal_stiffness": "1 GPa/m",
        "contact.unit_unit.shear_stiffness": "0.4 GPa/m",
        "gauge": [{"name": "sway", "at": "keystone", "direction": "-x"}],
        "limit.control": "sway",
        "limit.until": "6 mm",
    }
    scene = load_scene(SCENES / "arch-of-oppenheim.toml", soft)
    result = masonry.run(scene)
    way, factor = branch(result)
    assert factor[way > 0.002] == pytest.approx(masonry.limit(scene).factor, rel=ACCURACY)

"""A load that goes to and fro from factor to factor: loops against closed forms, falls on either side, what it says."""

from pathlib import Path

import numpy as np
import pytest

import masonry
import verification
from masonry.curves.curve import curve_figure
from masonry.errors import SceneError
from masonry.laboratory.text import summary_text
from masonry.loading.collapse.enclosing import Enclosing
from masonry.loading.collapse.factor_path import FactorPath
from masonry.loading.collapse.growing_settings import GROWING
from masonry.scene import load as load_scene
from tests.scenes import MATERIAL, box, listed, load, specimen, tables
from verification.cases.friction.beam_to_and_fro import FOOT, FORCE, SCENE, SLIDES, slip

SCENES = Path(verification.__file__).parent / "scenes"


def beam(history: list[float], **changes):
    """A beam on two dry feet, pushed to and fro."""
    changes = {key.replace("__", "."): value for key, value in changes.items()}
    return masonry.run(load_scene(SCENES / f"{SCENE}.toml", {"limit.history": history, **changes}))


def test_two_feet_of_which_one_slides_make_the_loops_of_masing():
    result = beam([FORCE, -FORCE, FORCE, -FORCE, 0.0], limit__accuracy=0.02)
    first, second = result.summary["cycles"]
    assert first["dissipated_j"] == pytest.approx(3.0 * SLIDES * slip(FORCE), rel=1e-3)
    assert second["dissipated_j"] == pytest.approx(4.0 * SLIDES * slip(FORCE), rel=1e-3)
    assert second["farthest_m"] - second["farthest_back_m"] == pytest.approx(2.0 * (FORCE - SLIDES) / FOOT, rel=1e-3)
    assert first["left_m"] == pytest.approx(second["left_m"], abs=1e-3 * slip(FORCE))
    assert result.summary["energy_imbalance"] < 1e-12 and result.summary["damping_over_external"] < 1e-3


def test_below_the_strength_of_all_feet_nothing_is_dissipated_and_the_beam_comes_back():
    force = 1.9 * SLIDES
    result = beam([force, -force, 0.0])
    (cycle,) = result.summary["cycles"]
    rows = result.history.rows
    assert cycle["dissipated_j"] == 0.0 and cycle["closed"]
    assert cycle["stiffness_per_m"] == pytest.approx(2.0 * FOOT, rel=1e-9)
    begins = rows["beam"][int(np.flatnonzero(rows["load_factor"])[0]) - 1]
    assert cycle["left_m"] == pytest.approx(begins, abs=1e-6 * force / FOOT)


def test_a_force_that_pulsates_makes_a_loop_of_masing_from_turn_to_turn():
    """The weight of the beam pushes it back, as far as the force does at the most; so the left foot bears more."""
    back, mass = 440.0, 2000.0 * 1.2 * 0.2 * 0.2
    slides = SLIDES + 0.5 * back * 0.1 / 0.75
    pulse = 4.0 * slides * (420.0 - 2.0 * slides) / FOOT
    first = 2.0 * slides * (440.0 - 2.0 * slides) / FOOT
    result = beam([880.0, 40.0, 880.0, 40.0, 880.0], limit__accuracy=0.02, gravity__x=f"{-back / mass} m/s^2")
    cycles = result.summary["cycles"]
    assert [cycle["closed"] for cycle in cycles] == [False, True, True]
    assert [cycle["dissipated_j"] for cycle in cycles] == pytest.approx([first, pulse, pulse], rel=1e-3)
    assert (cycles[1]["lowest_factor"], cycles[1]["highest_factor"]) == (40.0, 880.0)
    assert cycles[1]["left_m"] == pytest.approx(cycles[2]["left_m"], abs=1e-3 * slip(FORCE))


def test_a_fall_belongs_to_no_cycle_and_leaves_the_loops_large_in_the_picture():
    """Both feet slide at three times what the left one bears; how far the beam then slides is chance."""
    result = beam([1.9 * SLIDES, -1.9 * SLIDES, 3.8 * SLIDES])
    found, (first, last) = result.summary["collapse_load"], result.summary["cycles"]
    assert found["borne"] <= 3.0 * SLIDES * (1.0 + 1e-6) and found["falls"] >= 3.0 * SLIDES * (1.0 - 1e-6)
    assert first["dissipated_j"] == 0.0 and last["highest_factor"] == found["borne"] and not last["closed"]
    assert last["dissipated_j"] == pytest.approx(SLIDES * (found["borne"] - 2.0 * SLIDES) / FOOT, rel=0.01)
    assert result.summary["energy_j"]["friction"] > 2.0 * last["dissipated_j"]
    assert result.summary["damping_over_external"] < 0.01
    loops, ledger, _ = curve_figure(result).axes
    assert "fall" in loops.get_legend_handles_labels()[1]
    assert 1e3 * last["farthest_m"] < loops.get_xlim()[1] < 1.2e3 * last["farthest_m"]
    assert ledger.get_ylim()[1] < 1.2 * result.history.rows["external_work"][-2]


def test_a_first_increment_far_beyond_the_strength_is_taken_back():
    result = beam([60.0 * SLIDES, -60.0 * SLIDES], limit__accuracy=0.02)
    collapse = result.summary["collapse_load"]
    assert result.summary["stopped"] == "" and collapse["loops"]["leg"] == 1
    assert collapse["borne"] <= 3.0 * SLIDES * (1.0 + 1e-6) and collapse["falls"] >= 3.0 * SLIDES * (1.0 - 1e-6)


def test_what_cracks_suddenly_under_a_force_is_told():
    """The left foot breaks, and what its cohesion bore goes to the other one: the beam comes to rest farther than it
    would without inertia, by a part of that way which depends on the damping."""
    share = 0.7
    cohesion = share * SLIDES / 0.004
    group = "contact__unit_unit__"
    strong = {f"{group}{key}": f"{cohesion!r} Pa" for key in ("cohesion", "tensile_strength")}
    force = (2.0 * share + 2.05) * SLIDES
    result = beam([force, -SLIDES, 0.0], law="brittle", **strong)
    text = " ".join(summary_text(result.summary).split())
    static = (force - SLIDES) / FOOT
    assert result.summary["collapse_load"]["falls"] is None
    assert 1.01 * static < result.summary["cycles"][0]["farthest_m"] < static + share * SLIDES / FOOT
    assert f"damping took {100 * result.summary['damping_over_external']:.2g} % of the work of the load" in text


@pytest.mark.parametrize("displacements", ["small", pytest.param("large", marks=pytest.mark.slow)])
def test_a_block_falls_on_the_leg_and_the_side_on_which_it_bears_less(displacements):
    """Two stones, the upper one 20 mm to the right: together they turn over at 40 / 200 and, to the left, 60 / 200."""
    boxes = [
        box("base", (-0.5, 0, -0.1), (1.0, 0.2, 0.1), "units", 0),
        box("foot", (-0.05, 0, 0), (0.1, 0.2, 0.2), "units", 1),
        box("head", (-0.03, 0, 0.2), (0.1, 0.2, 0.2), "units", 2),
    ]
    limit = 'pattern = "weight"\ndirection = "x"\naccuracy = "0.5 %"\nhistory = [0.15, -0.25, 0.15, -0.5]'
    dry = 'normal_stiffness = "100 GPa/m"\nshear_stiffness = "40 GPa/m"\ntan_friction_angle = 0.9'
    scene = load(
        'law = "friction"\n'
        + specimen(boxes, 0.02, more='contact_points = "vertex"')
        + tables("material", {"units": MATERIAL})
        + tables("contact", {"unit_unit": dry})
        + listed("support", ['on = "base"\nfix = "all"'])
        + '[gravity]\nz = "-9.81 m/s^2"\n'
        + listed("gauge", ['name = "moves"\nat = "head"\ndirection = "x"'])
        + f"[limit]\n{limit}",
        displacements=displacements,
    )
    result = masonry.run(scene)
    found, text = result.summary["collapse_load"], " ".join(summary_text(result.summary).split())
    assert found["loops"]["leg"] == 4 and found["falls"] < found["borne"] < -0.25
    assert 0.5 * (found["borne"] + found["falls"]) == pytest.approx(-0.3, rel=0.01)
    assert "on leg 4 of 4, from 0.15 to -0.5" in text


def test_the_leg_of_a_fall_is_enclosed_to_a_share_of_the_greatest_factor_that_was_borne():
    path = FactorPath(0.01, 100.0, reversals=(0.4, -0.2, 0.1))
    search, tried = Enclosing(path, 0.0, GROWING), []
    while True:
        search.begin()
        tried.append(search.tried)
        if search.tried >= -0.0123 or search.leg == 0:
            search.bear()
        else:
            search.fail()
            if search.is_narrow:
                break
        assert search.go_on()
    assert search.borne >= -0.0123 > search.fallen
    assert 0.25 * 0.01 * 0.4 < search.borne - search.fallen <= 0.01 * 0.4
    assert max(tried) == 0.4 and np.max(np.abs(np.diff(tried))) <= 0.02 * 0.6 * (1.0 + 1e-12)


@pytest.mark.parametrize("size", [1.0, 1e6, 1e-6])
def test_what_rounding_leaves_of_a_leg_is_no_increment(size):
    path = FactorPath(0.01, 100.0, reversals=tuple(size * factor for factor in (0.8, -0.8, 0.9, -0.95)))
    search, tried = Enclosing(path, 0.0, GROWING), [0.0]
    search.begin()
    while True:
        tried.append(search.tried)
        search.bear()
        if not search.go_on():
            break
        search.begin()
    assert search.trials == 22 + 44 + 46 + 50 and np.min(np.abs(np.diff(tried))) > 1e-3 * size


def test_loops_are_drawn_and_a_doubt_is_told_where_blocks_move_much():
    force, group = 1.9 * SLIDES, "contact__unit_unit"
    soft = {f"{group}__normal_stiffness": "100 MPa/m", f"{group}__shear_stiffness": "40 MPa/m"}
    result = beam([force, -force, 0.0], **soft)
    text = " ".join(summary_text(result.summary).split())
    assert f"borne along its whole path, through {force:g}, {-force:g}, 0" in text
    assert "but the balance is that of the shape as drawn" in text and "raise limit.up_to" not in text
    loops, ledger, _ = curve_figure(result).axes
    assert (loops.get_xlabel(), loops.get_ylabel()) == ("beam [mm]", "load factor [1]")
    drawn = np.concatenate([line.get_ydata() for line in loops.get_lines() if len(line.get_ydata()) > 2])
    assert drawn.max() == force and drawn.min() == -force
    assert "way of the load factor" in ledger.get_xlabel()
    assert "fall" not in loops.get_legend_handles_labels()[1]


def test_loops_over_a_gauge_that_has_settled_fill_the_picture():
    result = beam([1.9 * SLIDES, -1.9 * SLIDES, 0.0], gauge__0__direction="z")
    low, high = curve_figure(result).axes[0].get_xlim()
    assert low < 1e3 * result.history.rows["beam"][-1] < high < 0.0


TOP = [{"name": "top", "at": "top course", "direction": "x"}]


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"limit.history": [0.3, 0.3]}, "point 1, 0.3, does not move the load"),
        ({"limit.history": []}, "must be a list of the factors"),
        ({"limit.history": "sin(t / 1 s)"}, "must be a list of the factors"),
        ({"limit.history": [1e9]}, "point 0"),
        ({"limit.history": [0.3, -0.3], "limit.up_to": 2.0}, "limit.up_to: belongs to a load that grows"),
        ({"limit.history": [0.3, -0.3], "limit.accuracy": None}, "limit.history: a run follows this history"),
        ({"limit.history": [0.3, -0.3], "gauge": []}, "limit.history are drawn over one"),
    ],
)
def test_a_history_that_is_none_is_refused(changes, words):
    with pytest.raises(SceneError, match=words):
        load_scene("wall-tilted", {"gauge": TOP, **changes})


def test_a_load_that_turns_back_softens_over_the_plastic_slip_as_a_drive_does():
    to_and_fro = load_scene("wall-tilted", {"gauge": TOP, "limit.history": [0.3, -0.3]})
    assert to_and_fro.turns_back and not load_scene("wall-tilted").turns_back

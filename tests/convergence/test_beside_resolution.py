"""Differences that are no error of resolution: draws by other seeds, a stiffness that stands for rigid, chaos."""

import csv
from statistics import stdev

import numpy as np
import pytest

from masonry.scene import load
from masonry.sweeps.convergence.beside_resolution import beside, drawn_again, runs_beside, sentences, stiffened
from masonry.sweeps.convergence.convergence import converge
from masonry.sweeps.convergence.refinement.answers import ANSWERS, Answer
from masonry.sweeps.convergence.refinement.campaign import DRAWN, RIGID, Campaign, Refinement
from masonry.sweeps.convergence.refinement.numerical_errors import error_of, relative_changes
from tests.convergence.samples import DENSITY, HEIGHT, LENGTH, TIPPED, WIDTH

KEY = "final_stress_pa"
RIGID_NOTE = {"assumptions": {"contact.unit_unit": "made up: so stiff that the blocks are rigid before they tip"}}
PEAK = next(answer for answer in ANSWERS if answer.key == "peak_stress_pa")
SWAY = Answer("sway", "sway", "m")


def test_a_stiffness_that_stands_for_rigid_is_told_apart_and_in_no_bar(tmp_path):
    """A rigid block tips about its edge: it bears W b / h. On soft joints it stands on a strip, and bears less."""
    keys = {"specimen.points_per_edge": 24} | RIGID_NOTE
    result = converge(load(TIPPED, keys), tmp_path / "out", of=[KEY], workers=0)
    rigid = LENGTH * WIDTH * HEIGHT * DENSITY * 9.81 * LENGTH / HEIGHT / (LENGTH * WIDTH)
    (error,), (one,) = result.errors, result.besides
    assert error.limit + error.half_width < 0.98 * rigid
    assert one.rigid.change > 0.0 and abs(error.limit + one.rigid.change - rigid) <= one.rigid.half_width
    assert RIGID not in error.parts and "would change end stress +" in " ".join(repr(result).split())
    table = next(csv.DictReader((result.folder / "convergence.csv").open()))
    assert float(table["rigid_difference"]) == one.rigid.change and table["drawn_runs"] == table["chaotic_runs"] == ""


@pytest.mark.parametrize(
    ("notes", "keys", "names"),
    [
        ({}, {}, set()),
        ({"contact.unit_unit": "measured on dry sandstone"}, {}, set()),
        ({"contact.unit_unit": "rigid", "kinematics": "rigid"}, {"law": "brittle", "tensile_strength": "1 MPa"}, set()),
        ({"kinematics": "rigid blocks"}, {}, set()),
        ({"contact.unit_unit.normal_stiffness": "as good as rigid"}, {}, {"normal_stiffness", "shear_stiffness"}),
    ],
)
def test_a_stiffness_that_is_measured_or_of_mortar_is_left_alone(notes, keys, names):
    mortar = {"cohesion": "1.5 MPa", "tan_residual_friction_angle": 0.7} if keys else {}
    contact = TIPPED["contact"]["unit_unit"] | keys | mortar
    scene = load(TIPPED | {"assumptions": notes, "contact": {"unit_unit": contact}})
    settings = stiffened(scene, 4.0)
    assert {key.rpartition(".")[2] for key in settings} == names
    assert all(value in ("120000000000.0 Pa/m", "48000000000.0 Pa/m") for value in settings.values())


@pytest.mark.parametrize(
    ("name", "keys", "expected"),
    [
        ("couplet", {}, {}),
        ("wallette-mode-1-218", {}, {"specimen.cells.seed": 3}),
        (
            "couplet",
            {"scatter": {"seed": 5, "unit_unit": {"tensile_strength": 0.2}}},
            {"scatter.seed": 7},
        ),
        ("block-shaken", {}, {"ground.made.seed": 3}),
    ],
)
def test_all_that_is_drawn_has_other_seeds(name, keys, expected):
    assert drawn_again(load(name, keys), 2) == expected


def row(number, key=PEAK.key):
    return {"status": "OK", key: number}


def test_other_draws_have_a_deviation_of_their_own_and_move_no_bar():
    resolution = [
        (Refinement("as it is", 1.0, {}), row(1.00e6)),
        (Refinement("scatter", 1.0, {}), row(1.0001e6)),
        (Refinement("pace", 2.0, {}), row(1.01e6)),
    ]
    draws = [(Refinement(DRAWN, 1.0, {"specimen.cells.seed": k}), row(p)) for k, p in ((2, 1.3e6), (3, 0.8e6))]
    assert error_of(PEAK, resolution + draws) == error_of(PEAK, resolution)
    assert relative_changes(resolution + draws, [PEAK]) == relative_changes(resolution, [PEAK])
    one = beside(PEAK, resolution + draws)
    assert one.drawn == (1.0e6, 1.3e6, 0.8e6) and one.rigid is None and one.chaotic == ()
    (said,) = sentences([one], resolution + draws, in_time=False)
    assert f"peak ±{100 * stdev(one.drawn) / 1e6:.2g} %" in said and "specimen.cells.seed; 3 draws" in said


def duffing(end, step):
    """Where a driven oscillator of Duffing is: x'' + 0.3 x' - x + x^3 = 0.5 cos 1.2 t, whose motion is chaotic."""

    def slope(t, y):
        return np.array([y[1], 0.5 * np.cos(1.2 * t) - 0.3 * y[1] + y[0] - y[0] ** 3])

    count, y = round(end / step), np.array([1.0, 0.0])
    h = end / count
    for n in range(count):
        a = slope(n * h, y)
        b = slope((n + 0.5) * h, y + 0.5 * h * a)
        c = slope((n + 0.5) * h, y + 0.5 * h * b)
        y = y + h / 6.0 * (a + 2.0 * b + 2.0 * c + slope((n + 1) * h, y + h * c))
    return float(y[0])


def motions(end):
    steps = {"as it is": 1.0, "scatter": 1.01, "time step": 2.0}
    runs = [(name, factor, duffing(end, 0.1 / factor)) for name, factor in steps.items()]
    runs += [("scatter", factor, duffing(end, 0.1 / factor)) for factor in (1 / 1.01, 1.02, 1 / 1.02)]
    return [(Refinement(name, 2.0 if factor == 2.0 else 1.0, {}), row(x, "sway")) for name, factor, x in runs]


def test_a_chaotic_motion_has_a_distribution_in_place_of_an_order():
    """At first steps of any length agree; an error then grows with exp(0.16 t) or so until all runs differ."""
    early, late = beside(SWAY, motions(6.0)), beside(SWAY, motions(200.0))
    assert early.chaotic == () and len(late.chaotic) == 6
    data = late.as_data()
    assert data["chaotic_lowest"] < data["chaotic_mean"] < data["chaotic_highest"]
    (said,) = sentences([early, late], motions(6.0), in_time=True)
    assert said.startswith("The motion is chaotic: the sway is ") and "in the mean of 6 runs" in said
    assert error_of(SWAY, motions(200.0)).order is None


def test_an_answer_that_is_steep_in_its_step_and_converges_is_not_chaotic():
    """A hundredth of the step moves it by 2 %, and half the step by 40 %."""
    values = {"as it is": (1.0, 1.0), "scatter": (1.0, 1.02), "time step": (2.0, 1.4)}
    runs = [(Refinement(name, factor, {}), row(x, "sway")) for name, (factor, x) in values.items()]
    assert beside(SWAY, runs).chaotic == ()
    runs[2] = (runs[2][0], row(1.05, "sway"))
    assert beside(SWAY, runs).chaotic == (1.0, 1.02, 1.05)


def test_runs_that_go_apart_are_followed_by_more_of_them():
    campaign = Campaign(load(TIPPED), 20.0)
    again = campaign.second(campaign.first(), {"pace": 0.05}, 0.04, 3.0)
    assert [trial.name for trial in again] == ["scatter"] * 4
    assert len({tuple(trial.settings.items()) for trial in again}) == 4
    assert len(campaign.second(campaign.first(), {"pace": 0.05}, 0.04, 18.5)) == 1


def test_a_scene_with_neither_has_no_run_beside_its_refinement():
    assert runs_beside(load(TIPPED)) == []
    assert [trial.label for trial in runs_beside(load("block-shaken"))] == [
        *("drawn again", "drawn again"),
        "stiffness of dry joints times 4",
    ]

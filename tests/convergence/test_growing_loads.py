"""A load that goes to and fro on a flat block that slides, held by a bar at its middle so that it does not tip:
refined, it nears what it dissipates by hand."""

import pytest

from masonry.cli.main import main
from masonry.errors import SceneError
from masonry.scene import load
from masonry.sweeps.convergence.convergence import converge
from masonry.sweeps.convergence.refinement.answers import answers_of, require_answer

FRICTION, SIZE, DENSITY, BAR, SHEAR, ABOVE = 0.5, (0.4, 1.0, 0.1), 6000.0, 2e9 * 1e-3 / 1.5, 5e9, 1e3
FACTORS = (4.1, 0.3, 3.7)
HELD = {
    "name": "held-block",
    "law": "friction",
    "specimen": {
        "kind": "boxes",
        "section": "1 m^2",
        "contact_points": "vertex",
        "box": [
            {"name": "ground", "origin": ["-2 m", "-1 m", "-0.2 m"], "size": ["4 m", "3 m", "0.2 m"], "unit": 0},
            {"name": "block", "origin": ["0 m", "0 m", "0 m"], "size": [f"{x} m" for x in SIZE], "unit": 1},
        ],
    },
    "material": {"units": {"density": f"{DENSITY} kg/m^3"}},
    "contact": {
        "unit_unit": {
            "normal_stiffness": "10 GPa/m",
            "shear_stiffness": f"{SHEAR} Pa/m",
            "tan_friction_angle": FRICTION,
        }
    },
    "support": [{"on": "ground", "fix": "all"}],
    "gravity": {"z": "-9.81 m/s^2"},
    "bar": [
        {
            "name": "tie",
            "ends": [["0 m", "0.5 m", "0.05 m"], ["-1.5 m", "0.5 m", "0.05 m"]],
            "area": "1000 mm^2",
            "young_modulus": "2 GPa",
            "fixed_end": "second",
        }
    ],
    "limit": {
        "pattern": "force",
        "on": "block",
        "force": {"x": f"{ABOVE} N"},
        "accuracy": "4 %",
        "history": list(FACTORS),
    },
    "gauge": [{"name": "way", "at": "block", "direction": "x"}],
}


def dissipated():
    """J: friction over how far the block slides on each leg, as the bar takes what friction does not."""
    friction = FRICTION * SIZE[0] * SIZE[1] * SIZE[2] * DENSITY * 9.81
    first, back, again = (ABOVE * abs(b - a) for a, b in zip((0.0, *FACTORS), FACTORS, strict=False))
    elastic = friction / (SHEAR * SIZE[0] * SIZE[1])
    slides = ((first - friction) / BAR - elastic, *((leg - 2 * friction) / BAR - 2 * elastic for leg in (back, again)))
    return friction * sum(slides)


@pytest.fixture(scope="module")
def held(tmp_path_factory):
    return converge(load(HELD), tmp_path_factory.mktemp("held") / "out", workers=0)


def test_what_a_load_to_and_fro_dissipates_nears_that_by_hand(held):
    """Each increment overshoots by what it carries along; half the accuracy halves that."""
    error = next(error for error in held.errors if error.answer.key == "dissipated_j")
    assert error.value > 1.015 * dissipated()
    assert abs(error.limit - dissipated()) <= error.half_width < 0.04 * error.value
    assert error.parts["trials"] > 0.005 * error.value


def test_a_factor_at_which_the_scene_ends_is_no_answer(held):
    """It came to the end of its history, and nothing fell."""
    assert "collapse_load.borne" not in [error.answer.key for error in held.errors]
    fell = {"collapse_load.borne": 0.64, "collapse_load.falls": 0.642}
    assert [answer.words for answer in answers_of(fell, [])] == ["load factor"]


@pytest.mark.parametrize(
    "name", ["steps", "blocks", "collapse_load.trials", "seconds_run", "interrupted", "section_m2"]
)
def test_what_is_no_answer_is_refused_with_numbers_that_are(name, capsys):
    assert main(["converge", "couplet", "--of", name, "--list"]) == 2
    said = capsys.readouterr().err
    assert f"'{name}' is a count, a time" in said and "such as peak_stress_pa" in said


def test_what_the_table_names_may_be_asked_for():
    for name in ("dissipated_j", "initial_stiffness_pa_per_m", "largest_crushing_m", "tilt_rad", "gauges.way.final_m"):
        require_answer(name, ["way"])
    with pytest.raises(SceneError, match=r"no run has 'gauges.other.final_m'"):
        require_answer("gauges.other.final_m", ["way"])


def test_drifts_of_a_gauge_are_numbers_of_a_scene_that_is_shaken():
    row = {f"shaking.gauges.head.{key}": 0.01 for key in ("peak", "residual", "peak_drift", "residual_drift")}
    words = {answer.words: answer.factor for answer in answers_of(row, ["head"])}
    assert words["largest drift of head"] == 100.0 and words["residual drift of head"] == 100.0


def test_a_scene_that_is_stopped_is_not_refined(tmp_path, capsys):
    """A block that turns too far for small displacement: its finer runs would be stopped as well."""
    lines = []
    keys = {"solver.rotation_limit": 1e-9, "gravity": {"x": "1 m/s^2", "z": "-9.81 m/s^2"}}
    result = converge(load(HELD, keys), tmp_path / "out", workers=0, tell=lines.append)
    assert not result.has_come_to_its_end and len(result.runs) == 1
    assert len(list((tmp_path / "out" / "runs").iterdir())) == 1
    again = converge(load(HELD, keys), tmp_path / "out", workers=0)
    assert [row for _, row in again.runs] == [row for _, row in result.runs]
    assert "of processor in all" in lines[0]

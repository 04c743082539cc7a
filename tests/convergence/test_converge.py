"""Error bars of scenes whose answer without end is known, and what the command writes."""

import json

import pytest

from masonry.cli.main import main
from masonry.errors import SceneError
from masonry.laboratory import laboratory
from masonry.scene import load
from masonry.sweeps.convergence.convergence import converge
from masonry.sweeps.convergence.refinement.answers import ANSWERS, answers_of
from masonry.sweeps.convergence.refinement.campaign import Refinement
from masonry.sweeps.convergence.refinement.numerical_errors import error_of
from tests.convergence.samples import TIPPED, borne

KEY = "final_stress_pa"


@pytest.fixture(scope="module")
def tipped(tmp_path_factory):
    return converge(load(TIPPED), tmp_path_factory.mktemp("tipped") / "out", of=[KEY, "peak_stress_pa"], workers=0)


def test_the_bar_holds_what_a_block_bears_by_hand(tipped):
    """Three points along its foot miss a fifth of it: the bar says so, and is an eighth as wide as the error."""
    end = tipped.errors[0]
    assert end.value < 0.85 * borne()
    assert end.error < 0.0
    assert abs(end.limit - borne()) <= end.half_width <= abs(end.error) / 4
    assert end.at_most == abs(end.error) + end.half_width


def test_what_makes_up_the_error_is_named(tipped):
    end = tipped.errors[0]
    assert max(end.parts, key=lambda name: abs(end.parts[name])) == "points along x"
    assert abs(end.parts.get("pace", 0.0)) < 0.05 * abs(end.error)
    said = repr(tipped)
    assert "too low" in said and "Most of that comes from points along x" in said


def test_what_does_not_act_is_not_refined(tipped):
    """Nothing acts along the depth, and no joint has an edge along z."""
    names = [trial.name for trial, _ in tipped.runs]
    assert "points along y" not in names and "points along z" not in names
    assert names[:2] == ["as it is", "scatter"]


def test_the_table_is_written_with_the_runs_it_comes_from(tipped):
    table = json.loads((tipped.folder / "convergence.json").read_text())
    assert [number["number"] for number in table["numbers"]] == [KEY, "peak_stress_pa"]
    assert table["numbers"][0]["limit"] == tipped.errors[0].limit
    assert {run["kind"] for run in table["runs"]} >= {"base", "scatter", "resolution"}
    for run in table["runs"]:
        assert (tipped.folder / "runs" / run["key"] / "summary.json").is_file()
    assert (tipped.folder / "convergence.png").is_file()


def test_the_same_again_runs_nothing_and_says_the_same(tipped, tmp_path):
    lines = []
    again = converge(
        load(TIPPED), tipped.folder, of=[KEY, "peak_stress_pa"], workers=0, tell=lines.append, overwrite=True
    )
    assert repr(again) == repr(tipped)
    assert not any("1 of" in line and "runs" not in line for line in lines)
    assert sum("are done already" in line for line in lines) == 2


def test_settings_are_chosen_by_which_the_error_is_as_asked_for(tipped):
    """The file is a scene of its own: its run is within the error asked for of the closed form."""
    result = converge(load(TIPPED), tipped.folder, of=[KEY], to="4 %", workers=0, overwrite=True)
    assert result.chosen is not None and result.chosen.error <= 0.04
    chosen = load(tipped.folder / "converged.toml")
    assert chosen.specimen.points_per_edge.x > 3
    assert abs(laboratory.run(chosen).summary[KEY] / borne() - 1.0) <= 0.04


def test_what_a_peak_may_be_between_two_steps_is_part_of_its_bar():
    """The couplet: cohesion and friction at its confinement, which no step meets."""
    ended = [(Refinement("as it is", 1.0, {}), row(1374495.8)), (Refinement("pace", 2.0, {}), row(1374495.8))]
    error = error_of(next(a for a in ANSWERS if a.key == "peak_stress_pa"), ended)
    assert error.error < 0.0
    assert abs(error.limit - (0.87e6 + 1.01 * 0.5e6)) <= error.half_width < 1e-3 * error.value


def row(peak):
    return {"status": "OK", "peak_stress_pa": peak, "missed_between_steps": 5.2e-4}


def test_a_gauge_that_nothing_moves_has_no_error(tipped):
    """Its reading is rounding, and a share of it says nothing."""
    row = {"status": "OK", "gauges.side.final_m": -1.6e-18, "gauges.head.final_m": 2e-4}
    assert [a.key for a in answers_of(row, ["side", "head"], list(row)[1:])] == ["gauges.head.final_m"]


def test_settings_of_an_earlier_search_do_not_stay_beside_a_new_table(tipped):
    result = converge(load(TIPPED), tipped.folder, of=["collapse_load.borne"], workers=0, overwrite=True)
    assert "none of the numbers" in repr(result) and result.errors == []
    assert not (tipped.folder / "converged.toml").exists() and not (tipped.folder / "convergence.png").exists()


def test_a_scene_for_limit_analysis_alone_is_refused_before_anything_is_written(tmp_path):
    with pytest.raises(SceneError, match="vehicle"):
        converge(load("bridge"), tmp_path / "out", workers=0)
    assert not (tmp_path / "out").exists()


def test_what_is_wrong_is_one_message(capsys, tmp_path):
    for words, said in {
        ("--of", "peak_stres_pa"): "peak_stress_pa",
        ("--to", "40 %"): "--to 40 %: an error from '0.01 %'",
        ("--to", "1 mm"): "such as '1 %'",
        ("--cost", "0.5"): "1 or more",
        ("--workers", "-1"): "0 (all in this process) or more",
    }.items():
        assert main(["converge", "couplet", *words, "--out", str(tmp_path / "out"), "--quiet"]) == 2
        error = capsys.readouterr().err
        assert error.count("\n") == 1 and said in error, error


def test_the_runs_are_listed_with_what_they_cost(capsys):
    assert main(["converge", "couplet", "--list"]) == 0
    out = capsys.readouterr().out
    assert "pace finer by 2" in out and "drive.accuracy = 0.005" in out and "times the scene" in out

"""Bars of a sweep: which runs are refined, and what the others take from them."""

import csv
import json
from pathlib import Path

import numpy as np
import pytest

import masonry
from masonry.errors import SceneError
from masonry.sweeps.convergence import convergence
from masonry.sweeps.convergence.refinement.answers import Answer
from masonry.sweeps.convergence.refinement.numerical_errors import NumericalError
from masonry.sweeps.error_bars.sweep_bars import carried_over, farthest_apart, places_of
from masonry.sweeps.planned_runs import plan
from masonry.sweeps.read import sweep_of_tables
from masonry.sweeps.sweep_table import bars_text
from tests.sweep.samples import SHORT, marks

PEAK = "peak_stress_pa"
PRESSURES = {"confinement": ["0.1 MPa", "0.2 MPa", "0.5 MPa"]}


def error(value: float, limit: float, half_width: float, key: str = PEAK) -> NumericalError:
    return NumericalError(Answer(key, "peak"), value, limit, half_width, None, {}, 0.0, 0.0)


def row(value: float | None, status: str = "OK") -> dict:
    return {"status": status, PEAK: value, "final_stress_pa": -2.0}


def test_a_run_takes_the_bars_of_the_nearest_refined_run_relative_to_its_own_numbers():
    """By hand: 10 is 9 +- 0.5 without end, a tenth less and a twentieth; 40 is 42 +- 1, a twentieth more."""
    rows = [row(10.0), row(20.0), row(30.0), row(40.0), row(50.0, "STOPPED")]
    refined = {0: [error(10.0, 9.0, 0.5), error(-2.0, -2.2, 0.1, "final_stress_pa")], 3: [error(40.0, 42.0, 1.0)]}
    columns = carried_over(np.array([[0.0], [0.2], [0.6], [0.8], [1.0]]), rows, refined)
    assert columns["error_bar"] == ["refined", "as of run 0", "as of run 3", "refined", None]
    assert columns[f"{PEAK} limit"] == [9.0, 18.0, 31.5, 42.0, None]
    assert columns[f"{PEAK} half_width"] == [0.5, 1.0, 0.75, 1.0, None]
    assert columns["final_stress_pa limit"] == [-2.2, -2.2, None, None, None]
    assert columns["final_stress_pa half_width"] == [0.1, 0.1, None, None, None]
    assert bars_text({PEAK: [each[PEAK] for each in rows], **columns}).endswith("is off by up to 15 % (95 %)")


def test_numbers_that_are_no_column_of_a_sweep_make_none():
    columns = carried_over(np.zeros((1, 1)), [row(10.0)], {0: [error(5.0, 5.1, 0.1, "initial_stiffness_pa_per_m")]})
    assert list(columns) == ["error_bar"]


@pytest.mark.parametrize(
    ("count", "chosen"), [(1, [2]), (2, [0, 4]), (3, [0, 2, 4]), (4, [0, 1, 2, 4]), (9, [0, 1, 2, 3, 4])]
)
def test_runs_that_are_refined_lie_apart(count, chosen):
    assert farthest_apart(np.linspace(0.0, 1.0, 5)[:, None], range(5), count) == chosen


def test_only_runs_that_ended_are_refined():
    """Of a grid of 3 by 3 whose first corner was stopped: three other corners."""
    grid = np.array([(x, y) for x in (0.0, 0.5, 1.0) for y in (0.0, 0.5, 1.0)])
    assert farthest_apart(grid, range(1, 9), 3) == [2, 6, 8]
    assert farthest_apart(grid, [], 3) == []


def test_values_lie_by_their_order_and_words_as_they_come():
    tables = {"confinement": ["1 MPa", "0.01 MPa", "0.1 MPa"], "law": ["linear", "exponential"]}
    places = places_of(plan(sweep_of_tables(masonry.load("couplet"), tables)))
    assert places[:, 0].tolist() == [1.0, 1.0, 0.0, 0.0, 0.5, 0.5]
    assert places[:, 1].tolist() == [0.0, 1.0] * 3


@pytest.fixture(scope="module")
def couplet():
    return masonry.load("couplet", SHORT | {"solver.rows": 30})


@pytest.fixture(scope="module")
def refined(couplet, tmp_path_factory):
    """Sweep of three pressures, interrupted while it is refined, then ended; and the runs that were done before."""
    folder, tables = tmp_path_factory.mktemp("sweep") / "out", {"grid": PRESSURES, "error_bars": 2}
    with pytest.MonkeyPatch.context() as patch:
        measured, calls = convergence.Runner.measured, []

        def interrupted_once(self, campaign):
            calls.append(campaign)
            if len(calls) > 1:
                raise KeyboardInterrupt
            return measured(self, campaign)

        patch.setattr(convergence.Runner, "measured", interrupted_once)
        with pytest.raises(KeyboardInterrupt):
            masonry.sweep(couplet, tables, folder, workers=0)
    before = set(marks(folder))
    assert not (folder / "sweep.csv").exists()
    return masonry.sweep(couplet, tables, folder, workers=0), before


def test_a_sweep_that_was_interrupted_as_it_was_refined_goes_on(refined):
    result, before = refined
    assert len(before) > 3 and before < set(marks(result.folder))
    assert result.columns["error_bar"] == ["refined", "as of run 0", "refined"]
    assert "error bars: 2 of 3 runs are refined" in repr(result)


def test_the_bars_in_the_table_are_those_of_the_runs(refined):
    result, _ = refined
    rows = list(csv.DictReader((result.folder / "sweep.csv").open()))
    for number in (0, 2):
        summary = json.loads((Path(result.folder) / "runs" / rows[number]["key"] / "summary.json").read_text())
        bar = summary["numerical_error"]["numbers"][PEAK]
        assert (float(rows[number][f"{PEAK} limit"]), float(rows[number][f"{PEAK} half_width"])) == (
            bar["limit"],
            bar["half_width"],
        )
    ratio = float(rows[1][PEAK]) / float(rows[0][PEAK])
    assert float(rows[1][f"{PEAK} half_width"]) == pytest.approx(
        ratio * float(rows[0][f"{PEAK} half_width"]), rel=1e-12
    )


def test_bars_are_added_to_a_sweep_that_is_done_and_no_run_is_made_again(refined, couplet):
    """And without them its columns are as ever."""
    result, _ = refined
    there = {key: mark[0] for key, mark in marks(result.folder).items()}
    plain = masonry.sweep(couplet, PRESSURES, result.folder, workers=0)
    assert not any("error_bar" in name or name.endswith((" limit", "half_width")) for name in plain.columns)
    assert all(plain.columns[name] == result.columns[name] for name in plain.columns)
    assert "numerical_error" not in "".join(plain.columns)
    again = masonry.sweep(couplet, {"grid": PRESSURES, "error_bars": 2}, result.folder, workers=0)
    assert again.columns == result.columns and set(marks(result.folder)) == set(there)


@pytest.mark.parametrize("number", [0, -1, True, 2.0, "three"])
def test_a_number_of_refined_runs_that_is_none_is_one_message(couplet, number):
    with pytest.raises(SceneError, match="^sweep: error_bars: how many of the runs are refined, 1 or more, not "):
        masonry.sweep(couplet, {"grid": PRESSURES, "error_bars": number})

"""The table [ground.made] of a scene: its record shakes the specimen, and wrong keys are one message."""

import numpy as np
import pytest

from masonry.errors import SceneError
from masonry.scene import load, to_toml
from tests.ground.test_ground_keys import scene

QUICK = {"spectrum": "kanai-tajimi", "peak": "0.3 g", "duration": "5 s", "shortest": "0.1 s"}
CODE = {"spectrum": "eurocode-8-1", "a_g": "0.2 g", "soil": "C", "duration": "10 s"}
ROWS = [["0.1 s", "0.5 g"], ["0.5 s", "0.5 g"], ["2 s", "0.1 g"]]


def test_components_are_independent_records_to_scale(tmp_path):
    ground = scene(tmp_path, {"x": "first", "y": "second", "scale": 2, "made": QUICK}).shaken
    x, y = ground.motions["x"], ground.motions["y"]
    assert x.peak_acceleration == pytest.approx(0.6 * 9.80665, rel=1e-6) == y.peak_acceleration
    assert abs(np.corrcoef(x.acceleration, y.acceleration)[0, 1]) < 0.3
    assert abs(x.residual_velocity) < 1e-12 and abs(x.residual_displacement) < 1e-11
    assert ground.runs_for == pytest.approx(5.0)


def test_a_scene_that_is_written_out_has_the_same_record(tmp_path):
    first = scene(tmp_path, {"x": "first", "made": QUICK | {"seed": 5}})
    (tmp_path / "again.toml").write_text(to_toml(first))
    again = load(tmp_path / "again.toml")
    assert again.ground == first.ground
    assert np.array_equal(again.shaken.motions["x"].acceleration, first.shaken.motions["x"].acceleration)
    other = load(tmp_path / "again.toml", {"ground.made.seed": 6})
    assert not np.array_equal(other.shaken.motions["x"].acceleration, first.shaken.motions["x"].acceleration)


def test_a_record_of_a_table_of_periods_is_matched(tmp_path):
    made = {"spectrum": "table", "table": ROWS, "duration": "8 s", "shortest": "0.2 s"}
    record = scene(tmp_path, {"x": "first", "made": made}).ground[0].made.record()
    assert record.mismatch <= 0.1
    at = record.spectrum.periods
    assert np.exp(np.interp(np.log(at), np.log([0.1, 0.5, 2.0]), np.log([0.5, 0.5, 0.1]))) * 9.80665 == pytest.approx(
        record.target
    )


@pytest.mark.parametrize(
    ("ground", "words"),
    [
        ({"made": QUICK}, "ground.x: missing; name a column"),
        ({"x": "fourth", "made": QUICK}, "'fourth' is no component of"),
        ({"x": "first", "made": QUICK, "record": "own.csv"}, "keep one of them"),
        ({"x": "first", "made": QUICK, "duration": "5 s"}, "keep one of them"),
        ({"x": "first", "made": QUICK, "quantity": "velocity"}, "are accelerations"),
        ({"x": "first", "made": QUICK | {"a_g": "0.2 g"}}, "does not belong to spectrum = 'kanai-tajimi'"),
        ({"x": "first", "made": {k: v for k, v in CODE.items() if k != "a_g"}}, "a_g: missing"),
        ({"x": "first", "made": CODE | {"soil": "F"}}, "allowed: A, B, C, D, E"),
        ({"x": "first", "made": CODE | {"a_g": 0.2}}, "has no unit"),
        ({"x": "first", "made": CODE | {"duration": "10.003 s"}}, "whole number of steps"),
        ({"x": "first", "made": CODE | {"step": "0.05 s"}}, "four steps"),
        ({"x": "first", "made": CODE | {"strong": "9 s"}}, "shorter together"),
        ({"x": "first", "made": {"spectrum": "table", "table": [], "duration": "9 s"}}, "two rows or more"),
        ({"x": "first", "made": {"spectrum": "table", "table": ROWS[::-1], "duration": "9 s"}}, "must grow"),
        ({"x": "first", "made": {"spectrum": "table", "table": [["1 s"]] * 2, "duration": "9 s"}}, "is no row"),
    ],
)
def test_wrong_keys_are_one_message(tmp_path, ground, words):
    with pytest.raises(SceneError) as error:
        scene(tmp_path, ground)
    assert words in str(error.value) and len(error.value.lines) == 1


def test_a_record_that_cannot_be_matched_says_how_far_off_it_is(tmp_path):
    made = CODE | {"tolerance": 0.01, "duration": "5 s", "shortest": "0.25 s"}
    with pytest.raises(SceneError, match=r"ground.made.tolerance: 0.01 is not reached; .* off by"):
        print(scene(tmp_path, {"x": "first", "made": made}).shaken.motions)

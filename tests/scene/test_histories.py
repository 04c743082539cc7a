"""Histories of loading in a scene: the three forms, what they come to, and what is said of wrong ones."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from masonry.errors import SceneError
from masonry.loading.programs import passage
from masonry.scene import load, to_toml
from masonry.scene.tables.expression import read
from masonry.scene.tables.load_history import timed

SINE = "0.1 mm * sin(2 pi t / 1 s) * ramp(t / 4 s)"
T = np.linspace(0.0, 4.0, 101)


def cyclic(history, **drive):
    """The couplet along a history."""
    return load("couplet", {"drive.history": history, **{f"drive.{key}": value for key, value in drive.items()}})


@pytest.mark.parametrize(
    ("text", "kind", "wanted"),
    [
        (SINE, "length", 1e-4 * np.sin(2 * np.pi * T) * T / 4),
        ("50 µm/s * t", "length", 5e-5 * T),
        ("-(2 mm + 3e-3 m) * t / 2 s", "length", -2.5e-3 * T),
        ("1 - cos(90 deg * t / s)", "number", 1 - np.cos(np.pi / 2 * T)),
        ("ramp((t - 1 s) / 2 s)", "number", np.clip((T - 1) / 2, 0, 1)),
        ("triangle(pi t / 2 s)", "number", np.interp(T, [0, 1, 3, 4], [0, 1, -1, 0])),
        ("8 mm / 2 / 2", "length", np.full(101, 2e-3)),
        ("2 mm - 1 mm - 1 mm", "length", np.zeros(101)),
    ],
)
def test_an_expression_has_the_values_that_it_says(text, kind, wanted):
    assert read(text, kind)(T) == pytest.approx(wanted, abs=1e-12)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("sin(t)", "divide by a time"),
        ("2 mm + 3 s", "a length and a time cannot be added"),
        ("3 s", "is a time, and must be a length"),
        ("1 mm t * t", r"in m\^1 s\^2"),
        ("1 mmm", "'mmm' is no known unit"),
        ("1 MPa", "only units of length, time and angle"),
        ("__import__('os').system('ls')", "has no meaning here"),
        ("exec(1)", "'exec' is no known unit, or name"),
        ("1 mm ** 2", "expected a number or a name"),
        ("1 mm / 2 t", "after a division"),
        ("(1 mm", r"expected '\)'"),
        ("1 mm)", "expected the end"),
        ("", "expected a number"),
        ("(" * 21 + "1 mm" + ")" * 21, "more than 20 parentheses"),
        ("1 mm" + " + 1 mm" * 60, "at most 400"),
    ],
)
def test_a_wrong_expression_is_refused_with_its_place(text, words):
    with pytest.raises(SceneError, match=words) as caught:
        cyclic(text, duration="4 s")
    assert str(caught.value).startswith("drive.history: ") and "\n" not in str(caught.value)


@settings(max_examples=60, deadline=None, derandomize=True)
@given(st.text(st.sampled_from("0123456789.e tpismncorag+-*/()µ_[]'\"=;:"), max_size=40))
def test_any_text_is_an_expression_or_refused(text):
    try:
        values = read(text, "length")
    except ValueError:
        return
    with np.errstate(all="ignore"):
        assert values(T).shape == T.shape


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ({"history": []}, "drive.history: must be a list of turning points"),
        ({"history": [1, 2]}, "has no unit"),
        ({"history": ["1 mm", "1 mm"]}, "point 1, '1 mm', does not move the drive"),
        ({"history": ["0 mm"]}, "point 0, '0 mm', does not move the drive"),
        ({"history": [["0 s", "0 mm"], ["0 s", "1 mm"]]}, "time of row 1, '0 s', must be later"),
        ({"history": [["1 s", "0 mm"], ["2 s", "1 mm"]]}, "must be 0 s"),
        ({"history": [["0 s", "1 mm"], ["2 s", "0 mm"]]}, "must be 0 at t = 0"),
        ({"history": [["0 s", "0 mm"], ["2 s"]]}, "row 1 must hold a time and a length"),
        ({"history": [["0 s", "0 mm"]]}, "two or more"),
        ({"history": SINE}, "drive.duration|missing; an expression needs it"),
        ({"history": "0 mm * t / s", "duration": "1 s"}, "never passes"),
        ({"history": "1e9 m * t / s", "duration": "1 s"}, "at most 100000 m"),
        ({"history": "1 mm / (t / s)", "duration": "1 s"}, "no finite value at t = 0"),
        ({"history": ["1 mm"], "duration": "1 s"}, "duration: belongs to"),
        ({"history": SINE, "duration": "1 s", "rate": "1 mm/s"}, "a history with times has its own"),
        ({"history": ["1 mm"], "displacement": "1 mm"}, "exclude each other"),
    ],
)
def test_a_history_that_does_not_do_is_refused_in_one_sentence(keys, words):
    with pytest.raises(SceneError, match=words) as caught:
        cyclic(**keys)
    assert "\n" not in str(caught.value)


def test_a_history_takes_the_place_of_the_displacement_and_is_paced_as_it_is():
    assert cyclic(["1 mm", "-1 mm"]).drive.displacement is None
    assert cyclic(["1 mm", "-1 mm"]).drive.accuracy == 0.01
    assert load("couplet-cyclic", {"drive.displacement": "1 mm"}).drive.reversals == (1e-3,)
    assert cyclic(["1 mm", "-2 mm"]).drive.farthest == 2e-3


@pytest.mark.parametrize("history", [["0.1 mm", "-20 um"], [["0 s", "0 mm"], ["1.5 s", "3 mm"]], SINE])
def test_a_written_history_reads_back_as_it_was(history, tmp_path):
    scene = cyclic(history, **({"duration": "4 s"} if history == SINE else {}))
    (tmp_path / "again.toml").write_text(to_toml(scene))
    again = load(tmp_path / "again.toml")
    assert again.drive == scene.drive
    assert again.drive.reversals == scene.drive.reversals


def test_the_turning_points_of_an_expression_are_found_to_rounding():
    reversals = timed("2 mm * sin(2 pi t / 1 s) * t / 4 s", 4.0, "length").turning_points()
    wanted = np.arange(0, 8) * 0.5 + 0.25  # where tan(2 pi t) = -2 pi t
    for _ in range(50):
        wanted = (np.arctan(-2 * np.pi * wanted) + np.pi * np.arange(1, 9)) / (2 * np.pi)
    assert reversals[:-1] == pytest.approx(0.5e-3 * np.sin(2 * np.pi * wanted) * wanted, rel=1e-12)
    assert abs(reversals[-1]) < 1e-15


def test_a_table_turns_at_its_rows_and_nowhere_between():
    rows = ((0.0, 0.0), (1.0, 2e-3), (1.5, 1.9e-3), (4.0, -1e-3), (6.0, -1e-3))
    table = timed(rows, None, "length")
    assert table.turning_points() == pytest.approx((2e-3, -1e-3), rel=1e-9)
    assert np.abs(table.at(np.linspace(4.0, 6.0, 9)) + 1e-3).max() < 1e-18


@settings(max_examples=30, deadline=None, derandomize=True)
@given(st.lists(st.floats(-1, 1).map(lambda x: round(x, 2)), min_size=1, max_size=6), st.integers(2000, 3000))
def test_a_passage_visits_every_turning_point_and_goes_straight_there(reversals, steps):
    reversals = [b for a, b in zip([0.0, *reversals], reversals, strict=False) if a != b]
    if not reversals:
        return
    places = passage(tuple(reversals), steps)
    way = np.abs(np.diff([0.0, *reversals])).sum()
    assert len(places) == steps and places[0] == 0.0 and places[-1] == reversals[-1]
    assert set(reversals) <= set(places.tolist())
    assert np.abs(np.diff(places)).sum() == pytest.approx(way, rel=1e-12), "never beyond a turn"


def test_an_accuracy_cannot_pace_loads_that_vary():
    given = {"traction.0.history": "ramp(t / 1 s)", "traction.0.duration": "1 s"}
    with pytest.raises(SceneError, match=r"traction.0.history: an accuracy controls the drive only"):
        load("couplet", given)
    assert load("couplet", {**given, "drive.steps": 10}).traction[0].history == "ramp(t / 1 s)"

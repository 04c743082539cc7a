"""Curves as engineers draw them: displacement across, load up; both peaks of a cycle; time where the scene asks."""

import numpy as np
import pytest

from masonry.curves.curve import curve_figure
from masonry.laboratory.text import summary_text
from masonry.movies.movie import paths_of
from masonry.pictures.camera import usual_view
from masonry.pictures.crack_picture import frames_to_draw
from masonry.results.table import csv_text
from tests.results.sample import sample
from tests.results.test_pictures import resting
from tests.results.test_words_in_pictures import boxes


def grown(falls=True, **gauges):
    """The sample under a load that grows to 0.8 at row 80, and falls at 0.81 from there on."""
    result = resting(**gauges)
    count = len(result.history.rows["step"])
    factor = np.where(np.arange(count) <= 80, 0.01 * np.arange(count), 0.81)
    result.history.rows["load_factor"] = factor
    result.summary |= {
        "collapse_load": {
            "pattern": "gravity",
            "borne": 0.8,
            "falls": 0.81 if falls else None,
            "first": 7,
            "sets": ["top"],
        }
    }
    return result


def test_the_load_is_drawn_up_and_the_displacement_across_and_a_fall_goes_out_of_the_picture():
    sway = np.where(np.arange(101) <= 80, 1e-6 * np.arange(101), 1e-3 * (np.arange(101) - 79))
    result = grown(sway=sway)
    curve, ledger = curve_figure(result).axes
    assert curve.get_ylabel() == "load factor [1]" and ledger.get_xlabel() == "sway [mm]"
    rests, fall, dot = curve.get_lines()[:3]
    np.testing.assert_allclose(rests.get_xdata(), 1e3 * sway[:81], rtol=1e-12)
    np.testing.assert_allclose(rests.get_ydata(), 0.01 * np.arange(81), rtol=1e-12)
    assert (rests.get_label(), fall.get_label()) == ("at rest", "falls")
    assert (dot.get_xdata()[0], dot.get_ydata()[0]) == pytest.approx((0.08, 0.8))
    assert fall.get_xdata()[-1] > 100.0 * curve.get_xlim()[1]
    (words,) = [text.get_text() for text in curve.texts if text.get_text()]
    assert words == "0.8 is borne,\n0.81 is not"
    ((line,), across, up) = paths_of(result)
    assert (across, up) == ("sway [mm]", "load factor [1]") and line.up[50] == pytest.approx(0.5)


def test_without_a_gauge_the_block_that_moves_most_is_drawn_to_the_side_to_which_it_moves():
    result = grown()
    corners = result.history.frames[-1].corners
    corners[8 * 7 : 8 * 8, 0] = -3e-4
    curve, ledger = curve_figure(result).axes
    assert ledger.get_xlabel() == "block 7 of 'top', -x [mm]"
    assert curve.get_lines()[1].get_xdata()[-1] == pytest.approx(0.3)


def test_a_bar_with_a_name_is_no_gauge_across():
    named, plain = grown(tie=np.linspace(0.0, 5e4, 101)), grown()
    named.history.units = {"tie": "N"}
    (curve, ledger), (as_before, _) = curve_figure(named).axes, curve_figure(plain).axes
    assert curve.get_ylabel() == "load factor [1]" and ledger.get_xlabel() == "block 7 of 'top', x [mm]"
    for line, other in zip(curve.get_lines(), as_before.get_lines(), strict=True):
        np.testing.assert_array_equal(line.get_xydata(), other.get_xydata())


def test_where_nothing_fell_all_is_at_rest_and_the_words_say_it():
    curve = curve_figure(grown(falls=False, sway=np.linspace(0.0, 1e-4, 101))).axes[0]
    assert [line.get_label() for line in curve.get_lines() if not line.get_label().startswith("_")] == ["at rest"]
    assert "0.8 is borne:\nthe load ends here" in [text.get_text() for text in curve.texts]


def test_what_gives_way_across_the_front_in_small_displacement_is_seen_from_the_side():
    result = grown()
    assert usual_view(result) == "front", "it moves along x"
    corners = result.history.frames[-1].corners
    corners[:, 1], corners[:, 0] = 1e-4, 1e-6
    assert usual_view(result) == "side"
    result.summary |= {"collapse_load": None}
    assert usual_view(result) == "front", "nothing fell"


def to_and_fro():
    """The sample, driven beyond its start, with a lowest stress that is larger than its peak."""
    result = sample()
    rows = result.history.rows
    rows["displacement"][60:] = np.linspace(1e-4, -2e-4, 41)
    rows["stress"][60:] = np.linspace(5e4, -6e5, 41)
    rows["stress"][90] = -7e5
    cycle = {"dissipated_j": 0.1, "closed": False}
    result.summary |= {"cycles": [cycle], "lowest_stress_pa": -7e5, "displacement_at_lowest_m": -1.25e-4}
    return result


def test_both_peaks_of_a_cycle_are_marked_and_told_and_the_stronger_side_is_drawn():
    result = to_and_fro()
    loops = curve_figure(result).axes[0]
    (dots,) = [line for line in loops.get_lines() if line.get_label() == "peak"]
    assert dots.get_ydata() == pytest.approx([0.19, -0.7]) and dots.get_xdata()[1] == pytest.approx(-0.125)
    words = {text.get_text().split()[0] for text in loops.texts if text.get_text()}
    assert words == {"highest", "lowest"}
    told = " ".join(summary_text(result.summary).split())
    assert "lowest stress -0.7 MPa" in told and "displacement there -0.125 mm" in told
    (name, frame), *_ = frames_to_draw(result)
    assert (name, frame.step) == ("at the end", 1000), "nearest to the lowest stress at step 900"
    result.summary |= {"lowest_stress_pa": -1e5}
    assert frames_to_draw(result)[0][0] == "at the peak"


def test_cycles_are_drawn_over_the_time_where_the_scene_asks():
    result = to_and_fro()
    result.scene_toml = '[curve]\nx = "time"\n'
    curve, ledger = curve_figure(result).axes
    assert ledger.get_xlabel() == "time [s]"
    np.testing.assert_allclose(curve.get_lines()[0].get_xdata(), result.history.rows["time"])


def test_a_run_without_a_drive_has_no_columns_of_one():
    result = grown(sway=np.linspace(0.0, 1e-4, 101))
    header = csv_text(result.history, result.has_drive).splitlines()[0].split(",")
    assert header[:3] == ["sway [m]", "load_factor [1]", "step [1]"]
    assert not {"displacement [m]", "stress [Pa]", "support_stress [Pa]", "force [N]"} & set(header)
    assert csv_text(sample().history).startswith("displacement [m],stress [Pa]")


@pytest.mark.parametrize("make", [to_and_fro, lambda: grown(sway=np.linspace(0.0, 1e-4, 101)), sample])
def test_no_words_lie_on_a_line_or_on_other_words(make):
    figure = curve_figure(make())
    texts, legends = boxes(figure)
    curve = figure.axes[0]
    words = {text: box for text, box in texts.items() if text}
    assert words
    for number, box in enumerate(words.values()):
        others = [*legends, *list(words.values())[number + 1 :]]
        assert not any(box.overlaps(other) for other in others)
        assert curve.bbox.x0 <= box.x0 and box.x1 <= curve.bbox.x1
        for line in curve.get_lines():
            points = line.get_transform().transform(np.column_stack([line.get_xdata(), line.get_ydata()]))
            assert not np.any(np.all((points > box.min) & (points < box.max), axis=1)), line.get_label()

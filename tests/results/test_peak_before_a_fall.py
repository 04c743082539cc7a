"""The peak of a specimen that falls is what it bore before; what then hits the drive is told apart."""

from functools import cache
from types import SimpleNamespace

import numpy as np
import pytest

import masonry
from masonry.curves.time_curve import FALLING, shown_until
from masonry.laboratory.text import summary_text
from masonry.movies.movie import Movie
from masonry.pictures.crack_picture import frames_to_draw
from masonry.results.frame_choice import uncaught_fall
from masonry.results.store import read
from masonry.rows.peak import at_peak

FINE = {"settle.steps": 8000, "solver.rows": 20000}


NOTES: list[str] = []


@cache
def slid_off():
    """A unit that bears 0.11 MPa, slides, and hits the drive with 0.55 MPa as it comes off."""
    return masonry.run(masonry.load("couplet-slid-off", FINE), progress=lambda now, whole, note: NOTES.append(note))


def test_the_progress_tells_a_stress_with_three_digits():
    last = slid_off().history.rows["stress"][-1]
    assert NOTES[-1].endswith(f"stress {1e-6 * last:.3g} MPa") and "0.000 MPa" not in NOTES[-1]


def test_the_peak_is_that_of_the_joint_and_the_blow_of_the_fall_is_told_apart():
    summary, rows = slid_off().summary, slid_off().history.rows
    standing = rows["step"] <= summary["collapse"]["step"]
    highest = rows["stress"][standing].max()
    assert highest <= summary["peak_stress_pa"] < 1.05 * highest
    assert 0.0 < summary["displacement_at_peak_m"] < 1e-3
    assert summary["collapse"]["blow_pa"] > 2.0 * summary["peak_stress_pa"]
    assert not any("blow" in words for words in summary["warnings"])
    text = " ".join(summary_text(summary).split())
    assert f"peak stress {1e-6 * summary['peak_stress_pa']:.4g} MPa" in text
    assert f"later, blocks that fell hit the drive with up to {1e-6 * summary['collapse']['blow_pa']:.4g} MPa" in text


def test_curve_and_pictures_show_the_same_peak(tmp_path):
    result = slid_off()
    curve = result.plot().axes[0]
    (dot,) = [line for line in curve.get_lines() if line.get_label() == "peak"]
    place, height = 1e3 * result.peak.displacement, 1e-6 * result.peak.stress
    assert (dot.get_xdata()[0], dot.get_ydata()[0]) == pytest.approx((place, height), rel=1e-12)
    assert curve.get_ylim()[1] < 1.5 * height, "blows go out of the picture"
    assert Movie(result).figure.axes[1].get_ylim()[1] < 1.5 * height, "out of movies as well"
    (marked,) = [line for line in curve.get_lines() if line.get_label().startswith("a block has fallen")]
    assert marked.get_xdata()[0] == pytest.approx(1e3 * result.summary["collapse"]["displacement_m"], rel=1e-12)
    (name, frame), _ = frames_to_draw(result)
    assert name == "at the peak" and frame.step == result.summary["reactions"]["peak"]["step"]
    row = int(np.searchsorted(result.history.rows["step"], frame.step))
    assert result.history.rows["stress"][row] > 0.95 * result.peak.stress
    result.save_numbers(tmp_path)
    assert read(tmp_path)["summary"]["collapse"]["blow_pa"] == result.summary["collapse"]["blow_pa"]


def test_a_fall_that_no_floor_ends_is_drawn_as_it_begins():
    frames = [SimpleNamespace(step=step) for step in (10, 20, 30, 40)]
    rows = {"step": np.arange(0, 41, 10), "time": 0.1 * np.arange(5)}
    result = SimpleNamespace(
        history=SimpleNamespace(frames=frames, rows=rows), is_shaken=True, scene_table={},
        summary=SimpleNamespace(collapse=SimpleNamespace(step=25), time_step_s=0.01),
    )  # fmt: skip
    ((name, frame),) = frames_to_draw(result)
    assert (name, frame.step) == ("as it falls", 30)
    assert shown_until(result) == pytest.approx(0.25 + FALLING)
    result.scene_table["floor"] = {}
    assert uncaught_fall(result) is None and shown_until(result) == np.inf


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_value_at_the_peak_lies_between_the_rows_whichever_way_the_drive_goes(sign):
    rows = {"displacement": sign * np.array([0.0, 1.0, 2.0]), "stress": np.array([0.0, 1.0, 1.0])}
    assert at_peak(rows, np.array([0.0, 10.0, 30.0]), sign * 1.5) == pytest.approx(20.0)

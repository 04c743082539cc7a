"""A run with its error bar: the bar stands where the number stands, and a run without one knows nothing of it."""

import json
import re
from pathlib import Path

import numpy as np
import pytest
import tomli_w

import masonry
from masonry.cli import error_bar_words
from masonry.cli.main import main
from masonry.curves.curve import curve_figure
from masonry.errors import SceneError
from masonry.laboratory.text import summary_text
from masonry.reporting.run_report import write_report
from masonry.results.records.convergence_record import LIMITS_OF_USE, RefinedNumber
from masonry.results.summary import Summary
from masonry.scene import load
from masonry.sweeps.convergence import convergence
from masonry.sweeps.error_bars import run_with_bar
from masonry.sweeps.error_bars.run_with_bar import begin_refinement, forget, is_begun, refine
from masonry.sweeps.run_store import Store
from tests.convergence.samples import TIPPED

PEAK, END = "peak_stress_pa", "final_stress_pa"


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    """A scene, its run with a bar, and its run without."""
    folder = tmp_path_factory.mktemp("runs")
    (folder / "tipped.toml").write_text(tomli_w.dumps(TIPPED))
    words = ["run", str(folder / "tipped.toml"), "--quiet", "--out"]
    assert main([*words, str(folder / "with"), "--error-bar", "--workers", "0"]) == 0
    assert main([*words, str(folder / "without")]) == 0
    return folder


def summary_of(folder: Path) -> dict:
    return json.loads((folder / "summary.json").read_text())


def test_the_bar_in_the_summary_is_that_of_the_table(place):
    error = summary_of(place / "with")["numerical_error"]
    table = json.loads((place / "with" / "convergence" / "convergence.json").read_text())
    assert {number["number"] for number in table["numbers"]} == set(error["numbers"]) >= {PEAK, END, "dissipated_j"}
    for number in table["numbers"]:
        written = error["numbers"][number["number"]]
        assert written == {key: number[key] for key in ("limit", "half_width", "order", "parts")}
    runs = [run for run in table["runs"] if run["name"] == "points along x"]
    assert error["refined"]["points along x"] == max(run["factor"] for run in runs) >= 2.0
    assert set(error["refined"]) == set(error["numbers"][PEAK]["parts"])
    assert set(error) == {"numbers", "refined"}


def test_the_run_of_the_scene_as_it_is_has_the_same_bar(place):
    """In the folder of the refinements, as `masonry converge` leaves it; a row of that run has no word of it."""
    folder = place / "with" / "convergence"
    key = json.loads((folder / "convergence.json").read_text())["runs"][0]["key"]
    assert summary_of(folder / "runs" / key) == summary_of(place / "with")
    assert not any("numerical_error" in name for name in Store(folder).row(key))


def test_a_run_without_a_bar_is_as_ever(place):
    """All numbers are the same but times, and no key is new."""
    plain, refined = summary_of(place / "without"), summary_of(place / "with")
    assert list(plain) == [key for key in refined if key != "numerical_error"]
    assert all(plain[key] == refined[key] for key in plain if not key.startswith("seconds"))
    for name in ("curve.csv", "resultants.csv", "scene.toml"):
        assert (place / "without" / name).read_bytes() == (place / "with" / name).read_bytes()
    assert not (place / "without" / "convergence").exists()


def test_the_number_without_end_stands_below_the_number(place):
    result = masonry.load_result(place / "with")
    lines = summary_text(result.summary).splitlines()
    first = next(n for n, line in enumerate(lines) if line.startswith("peak stress"))
    limit = result.summary.numerical_error.of(PEAK).limit
    assert lines[first + 1].strip().startswith(f"without end {limit / 1e6:.4f}")
    assert all(sentence in summary_text(result.summary) for sentence in LIMITS_OF_USE)
    assert "without end" not in summary_text(masonry.load_result(place / "without").summary)


def test_a_bar_is_told_with_two_digits_and_the_number_with_as_many_decimals():
    peak = RefinedNumber(0.96512e6, 4.26e3)
    assert peak.interval(1e-6, "MPa") == "0.9651 \u00b1 0.0043 MPa"
    assert RefinedNumber(12345.0, 678.0).interval() == "12340 \u00b1 680"
    assert RefinedNumber(2.5e9, 3.0).interval(1e-9, "GPa") == "2.5 \u00b1 0 GPa"
    rows = {"numbers": {PEAK: peak, "collapse_load.borne": RefinedNumber(0.64, 0.0033)}, "refined": {"pace": 2.0}}
    said = summary_text(Summary(peak_stress_pa=0.971e6, displacement_at_peak_m=1e-3) | {"numerical_error": rows})
    assert "peak stress" in said and "0.971 MPa\n" in said and "without end 0.9651 \u00b1 0.0043 MPa" in said
    assert "collapse_load.borne 0.6400 \u00b1 0.0033" in said  # no row of its own here


def test_bars_of_gauges_of_a_motion_are_told_in_the_units_of_the_gauge():
    swings = {
        "top": {"quantity": "displacement"},
        "base": {"quantity": "acceleration"},
        "way": {"quantity": "velocity"},
    }
    keys = [f"shaking.gauges.{name}.peak" for name in swings]
    numbers = {key: RefinedNumber(limit, 0.01 * limit) for key, limit in zip(keys, (0.02, 9.80665, 0.3), strict=True)}
    said = summary_text(Summary.read({"shaking": {"gauges": swings}, "numerical_error": {"numbers": numbers}}))
    for bar in ("20.00 \u00b1 0.20 mm at most", "1.000 \u00b1 0.010 g at most", "0.3000 \u00b1 0.0030 m/s at most"):
        assert f"without end {bar}" in said


def test_the_curve_has_the_bars_of_peak_and_end(place):
    result = masonry.load_result(place / "with")
    axes = curve_figure(result).axes[0]
    drawn = [container.lines[2][-1].get_segments()[0] for container in axes.containers]
    for segment, key in zip(drawn, (PEAK, END), strict=True):
        number = result.summary.numerical_error.of(key)
        ends = np.array([number.limit - number.half_width, number.limit + number.half_width]) / 1e6
        assert np.allclose(sorted(segment[:, 1]), ends, rtol=1e-12)
    assert drawn[1][0, 0] == pytest.approx(0.2)  # mm, the end of the drive
    assert not curve_figure(masonry.load_result(place / "without")).axes[0].containers


def test_the_page_for_a_client_has_the_bar_and_what_it_does_not_say(place, tmp_path):
    page = write_report(masonry.load_result(place / "with"), tmp_path / "page.html").read_text()
    assert "without end 0.0019" in page and all(sentence in page for sentence in LIMITS_OF_USE)


def test_a_run_whose_refinement_is_interrupted_is_resumed(place, tmp_path, monkeypatch, capsys):
    words = ["run", str(place / "tipped.toml"), "--out", str(tmp_path / "out"), "--error-bar", "--workers", "0"]
    with monkeypatch.context() as patch:
        patch.setattr(convergence.Runner, "measured", interrupted)
        assert main(words) == 130
    said = capsys.readouterr().err
    assert f"masonry resume {tmp_path / 'out'}" in said and is_begun(tmp_path / "out")
    assert "numerical_error" not in summary_of(tmp_path / "out")
    monkeypatch.setattr(error_bar_words, "processors", lambda: 0)
    assert main(["resume", str(tmp_path / "out")]) == 0
    assert re.search(r"\b1 of \d+ runs are done already", capsys.readouterr().err)  # the run itself
    table = json.loads((tmp_path / "out" / "convergence" / "convergence.json").read_text())
    bar = summary_of(tmp_path / "out")["numerical_error"]["numbers"][PEAK]
    assert bar["limit"] == next(number["limit"] for number in table["numbers"] if number["number"] == PEAK)
    assert not is_begun(tmp_path / "out")


def interrupted(*_):
    raise KeyboardInterrupt


def test_results_of_another_scene_get_no_bar(place, tmp_path):
    other = load(TIPPED, {"contact.unit_unit.tan_friction_angle": 0.8, "drive.displacement": "0.1 mm"})
    main(["run", str(place / "tipped.toml"), "--quiet", "--out", str(tmp_path / "out")])
    begin_refinement(other, tmp_path / "out")
    with pytest.raises(SceneError, match="another scene"):
        refine(tmp_path / "out", 0)
    assert "numerical_error" not in summary_of(tmp_path / "out")


def test_a_run_that_left_nothing_leaves_no_word_of_a_bar(tmp_path):
    begin_refinement(load(TIPPED), tmp_path / "out")
    forget(tmp_path / "out")
    assert not (tmp_path / "out").exists()


def test_what_is_not_ours_in_the_place_of_the_refinements_is_refused_before_anything_runs(place, tmp_path, capsys):
    (tmp_path / "out" / "convergence").mkdir(parents=True)
    (tmp_path / "out" / "convergence" / "scene.toml").write_text("mine")
    words = ["run", str(place / "tipped.toml"), "--out", str(tmp_path / "out"), "--overwrite", "--error-bar"]
    assert main(words) == 2
    assert "convergence" in capsys.readouterr().err
    assert [path.name for path in (tmp_path / "out").iterdir()] == ["convergence"]
    assert (tmp_path / "out" / "convergence" / "scene.toml").read_text() == "mine"


def test_words_that_need_a_bar_are_one_message(capsys):
    assert main(["run", "couplet", "--workers", "2"]) == 2
    assert "--error-bar" in capsys.readouterr().err


def test_a_run_from_python_has_its_bar(place, monkeypatch):
    monkeypatch.setattr(run_with_bar, "processors", lambda: 0)
    result = masonry.run(TIPPED, error_bar=True)
    here, there = result.summary.numerical_error, masonry.load_result(place / "with").summary.numerical_error
    assert set(here.numbers) == set(there.numbers) and set(here.refined) == set(there.refined)
    for key in (PEAK, END):  # which runs there are in the second round depends on the time that those of the first took
        bars = here.of(key), there.of(key)
        assert abs(bars[0].limit - bars[1].limit) <= max(bar.half_width for bar in bars)

"""`masonry sensitivity`: a table and a picture of one scene run in several ways."""

import csv
import json
import os
from pathlib import Path

import pytest

import masonry
from masonry.cli.main import main
from masonry.errors import SceneError
from masonry.sweeps import engine
from masonry.sweeps.sensitivity import study_table
from masonry.sweeps.sensitivity.picture import figure_of
from masonry.sweeps.sensitivity.study import _deviations
from tests.sweep.samples import marks, mistaken

SHORT = {"drive.accuracy": "10 %", "settle.steps": 300, "confinement": "0.1 MPa"}
KINDS = ["pace", "coupling", "softening"]


@pytest.fixture(scope="module")
def done(tmp_path_factory):
    """A couplet with three kinds of variants, in one process."""
    out = tmp_path_factory.mktemp("couplet")
    return masonry.sensitivity(masonry.load("couplet", SHORT), out, KINDS, quick=True, workers=1)


def test_rows_have_the_figures_of_their_runs_and_their_deviation_from_the_first(done):
    base, *others = done.rows
    assert [row["kind"] for row in done.rows] == ["base", *KINDS]
    assert base["peak_stress_pa"] == pytest.approx(0.971e6, rel=5e-3)
    for row in done.rows:
        summary = json.loads((done.folder / "runs" / row["key"] / "summary.json").read_text(encoding="utf-8"))
        terms = summary["energy_j"]
        dissipated = terms["fracture_mode_1"] + terms["fracture_mode_2"] + terms["friction"]
        assert row["dissipated_j"] == pytest.approx(dissipated) and row["final_stress_pa"] == summary["final_stress_pa"]
        assert row["dissipated_j_deviation"] == pytest.approx(dissipated / base["dissipated_j"] - 1.0)
        assert row["verdict"] == summary["verdict"] and row["trust_sentence"].startswith(row["verdict"])
        assert row["doubts"] == ", ".join(doubt["name"] for doubt in summary["doubts"])
    softening = others[-1]  # plastic slip lacks the elastic part: strength falls sooner
    assert -0.05 < softening["dissipated_j_deviation"] < -0.001


def test_the_table_stands_in_three_forms_and_the_picture_beside_it(done):
    with (done.folder / "sensitivity.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [row["variant"] for row in rows] == [row["variant"] for row in done.rows]
    assert float(rows[2]["peak_stress_pa"]) == done.rows[2]["peak_stress_pa"]
    assert rows[2]["settings"] == "contact.unit_unit.coupling = 'independent'"
    content = json.loads((done.folder / "sensitivity.json").read_text(encoding="utf-8"))
    assert content["runs"] == done.rows and content["sentence"] == study_table.sentence(done.rows)
    assert (done.folder / "sensitivity.png").read_bytes()[1:4] == b"PNG"
    assert repr(done).splitlines()[0].split("  ")[0] == "run" and "as it is" in repr(done)


def test_the_picture_has_a_curve_and_a_line_of_its_own_for_each_run_and_units(done):
    axes, moved = figure_of("Couplet", done.folder, done.rows).axes
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("displacement [mm]", "stress [MPa]")
    assert [text.get_text() for text in moved.get_yticklabels()] == [row["variant"] for row in done.rows]
    dots = [line for line in moved.get_lines() if line.get_marker() == "o"]
    expected = [100.0 * row["peak_stress_pa_deviation"] for row in done.rows]
    assert [dot.get_xdata()[0] for dot in dots] == pytest.approx(expected)
    assert [dot.get_ydata()[0] for dot in dots] == list(range(len(done.rows))), "no two lie on each other"
    assert moved.get_xlim()[0] <= -1.0 and moved.get_xlim()[1] >= 1.0, "what is robust looks robust"


def test_the_same_again_runs_nothing_and_another_scene_is_refused(done, monkeypatch):
    monkeypatch.setattr(engine, "compute", mistaken)
    before, lines = marks(done.folder), []
    scene = masonry.load("couplet", SHORT)
    again = masonry.sensitivity(scene, done.folder, KINDS, quick=True, workers=1, tell=lines.append)
    assert again.rows == done.rows and marks(done.folder) == before
    assert "4 of 4 runs are done already" in lines
    with pytest.raises(SceneError, match="holds runs of another scene"):
        masonry.sensitivity(scene.with_(confinement="0.2 MPa"), done.folder, KINDS, quick=True)


def test_the_shell_says_how_far_it_is_and_where_the_results_are(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    words = ["sensitivity", "couplet", "--only", "coupling", "--workers", "1"]
    words += [word for key, value in SHORT.items() for word in ("--set", f"{key}={value}")]
    assert main(words) == 0
    said = capsys.readouterr()
    assert "[1/2] as it is" in said.err and "in all" in said.err
    assert "No variant moves any of these by more than 1 %" in said.out
    folder = Path("results/couplet-sensitivity-1")
    assert {"sensitivity.csv", "sensitivity.json", "sensitivity.png", "scene.toml", "runs"} <= set(os.listdir(folder))
    os.unlink(folder / "sensitivity.json")  # as if it had been killed before the end
    assert main([*words, "--quiet", "--format", "pdf"]) == 0 and capsys.readouterr() == ("", "")
    assert (folder / "sensitivity.pdf").read_bytes()[:4] == b"%PDF" and not (folder / "sensitivity.png").exists()
    assert (folder / "sensitivity.json").is_file() and not Path("results/couplet-sensitivity-2").exists()


def test_a_scene_that_is_stopped_leaves_the_table_and_its_own_code(tmp_path, capsys):
    words = ["sensitivity", "couplet", "--only", "coupling", "--workers", "1", "--out", str(tmp_path / "r")]
    assert main([*words, "--set", "drive.displacement='500 mm'", "--set", "drive.accuracy='10 %'"]) == 3
    said = capsys.readouterr()
    assert "did not come to its end" in said.out and "solver.slip_limit" in said.err
    assert "stopped" in (tmp_path / "r" / "sensitivity.csv").read_text(encoding="utf-8")


def test_listing_runs_nothing_and_wrong_words_are_one_message(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["sensitivity", "wallette-mode-1", "--list", "--quick"]) == 0
    assert "plates     right plate free to turn" in capsys.readouterr().out
    assert os.listdir() == []
    for words in (
        ["nowhere"],
        ["couplet", "--only", "cell"],
        ["couplet", "--workers", "-1"],
        ["couplet", "--set", "x=1"],
    ):
        assert main(["sensitivity", *words]) == 2
        assert capsys.readouterr().err.startswith("masonry: ")
    assert os.listdir() == []


def row(**more):
    figures = {"peak_stress_pa": 1e6, "displacement_at_peak_m": 1e-4, "final_stress_pa": 5e5, "dissipated_j": 2.0}
    plain = {
        "variant": "as it is",
        "kind": "base",
        "status": "OK",
        "verdict": "sound",
        "doubts": "",
        "trust_sentence": "",
        "seconds": 1.0,
    }
    return plain | figures | more


def compared(*rows):
    return [{**one, **_deviations(one, rows[0])} for one in rows]


def test_the_sentence_names_what_moves_each_figure_most():
    weak = row(variant="plates", kind="plates", peak_stress_pa=0.9e6, dissipated_j=2.01)
    tough = row(variant="coupling", kind="coupling", peak_stress_pa=1.02e6, final_stress_pa=6e5)
    assert study_table.sentence(compared(row(), weak, tough)) == (
        "The answer rests on these choices: they move the peak by -10 % (plates), the end stress by +20 % (coupling)."
    )


def test_what_did_not_end_is_not_compared_and_an_end_stress_of_nothing_is_held_against_the_peak():
    lost = row(
        variant="pace", kind="pace", status="STOPPED", verdict="stopped", trust_sentence="why", peak_stress_pa=3e6
    )
    base, near = row(final_stress_pa=1e3), row(variant="cells", kind="cells", final_stress_pa=2e3)
    said = study_table.sentence(compared(base, lost, near))
    assert said.startswith("No variant moves any of these by more than 1 %") and "pace (stopped)" in said
    assert "pace: stopped, why" in study_table.text(compared(base, lost, near))
    far = row(variant="cells", kind="cells", final_stress_pa=2e5)
    assert "the end stress by +20 % of the peak (cells)" in study_table.sentence(compared(base, far))


def test_a_figure_that_is_nothing_in_the_base_has_no_deviation():
    base = row(final_stress_pa=0.0, dissipated_j=0.0)
    deviations = _deviations(row(final_stress_pa=1.0), base)
    assert deviations["final_stress_pa_deviation"] is None and deviations["dissipated_j_deviation"] is None
    assert deviations["peak_stress_pa_deviation"] == 0.0


def test_of_a_load_that_grows_the_answer_is_its_factor(tmp_path):
    pushed = masonry.load("arch-own-weight", {"limit.accuracy": "5 %"})
    study = masonry.sensitivity(pushed, tmp_path / "out", ["damping"], quick=True, workers=1)
    assert all(row["collapse_load.borne"] > 0.0 and row["peak_stress_pa"] is None for row in study.rows)
    heads = repr(study).splitlines()[0].split()
    assert heads == ["run", "verdict", "load", "factor", "dissipated", "[J]", "time", "doubts"]
    axes, moved = figure_of("Pushed", study.folder, study.rows).axes
    assert axes.get_ylabel() == "load factor" and moved.get_xlabel() == "change of the load factor [%]"

"""The engine runs what is missing, in any number of processes, and every run ends as a row."""

import json

import pytest

from masonry.errors import SceneError
from masonry.laboratory.result import load_result
from masonry.runtime.lock import sole
from masonry.sweeps import engine
from masonry.sweeps.job import SHOWING, Job, names
from masonry.sweeps.run_store import Store
from masonry.sweeps.sweep_folder import DOING
from masonry.sweeps.sweep_table import verdicts_text
from tests.sweep.samples import SHORT, dying, jobs, marks, mistaken, untimed

FOUR = ("0.1 MPa", "0.2 MPa", "0.3 MPa", "0.4 MPa")


@pytest.fixture(scope="module")
def done(tmp_path_factory):
    """Four runs by two processes: folder and rows."""
    folder = tmp_path_factory.mktemp("four")
    return folder, engine.run(jobs(*FOUR), folder, 2)


def test_a_row_has_the_numbers_of_its_run_and_its_folder_the_history(done):
    folder, rows = done
    for job, row in zip(jobs(*FOUR), rows, strict=True):
        assert (row["key"], row["status"], row["reason"]) == (job.key(), "OK", "")
        result = load_result(folder / "runs" / row["key"])
        assert row["peak_stress_pa"] == result.summary["peak_stress_pa"] > 1e5
        assert row["energy_j.friction"] == result.summary["energy_j"]["friction"]
        assert len(result.history.rows["stress"]) > 10 and result.history.frames
    peaks = [row["peak_stress_pa"] for row in rows]
    assert peaks == sorted(peaks), "a couplet is the stronger in shear, the more it is compressed"


def test_one_process_and_two_give_the_same_rows(done, tmp_path):
    assert untimed(engine.run(jobs(*FOUR), tmp_path, 1)) == untimed(done[1])


def test_what_is_done_is_not_run_again(done, monkeypatch):
    folder, rows = done
    before, lines = marks(folder), []
    monkeypatch.setattr(engine, "compute", mistaken)
    assert engine.run(jobs(*reversed(FOUR)), folder, 2, lines.append) == rows[::-1]
    assert marks(folder) == before and len(before) == 4
    assert lines == ["4 of 4 runs are done already"]


def test_the_same_job_twice_is_run_once(tmp_path):
    lines = []
    rows = engine.run(jobs("0.1 MPa", "100 kPa", "0.1 MPa"), tmp_path, 1, lines.append)
    assert rows[0] == rows[1] == rows[2]
    assert len(lines) == 1 and "[1/1]" in lines[0]


def test_a_run_that_is_refused_or_stopped_is_a_row_with_its_reason_and_no_other_suffers(tmp_path):
    refused = {"specimen.cells.total": 1, "specimen.cells.regularise": False, "kinematics": "affine"}
    asked = [
        Job("couplet", SHORT | refused),
        Job("couplet", SHORT | {"drive.steps": 60, "drive.displacement": "5 m"}),
        *jobs("0.1 MPa"),
    ]
    rows = engine.run(asked, tmp_path, 2)
    assert [row["status"] for row in rows] == ["REFUSED", "STOPPED", "OK"]
    assert "cells" in rows[0]["reason"] and "step" in rows[1]["reason"]
    for row in rows[:2]:
        failure = json.loads((tmp_path / "runs" / row["key"] / "failure.json").read_text(encoding="utf-8"))
        assert failure["reason"] == row["reason"] and row["seconds"] >= 0.0
    assert engine.run(asked, tmp_path, 2) == rows


def test_a_process_that_dies_costs_its_own_run_only_which_is_tried_again_next_time(tmp_path, monkeypatch):
    monkeypatch.setattr(engine, "compute", dying)
    rows = engine.run(jobs(*FOUR), tmp_path, 1)
    assert [row["status"] for row in rows] == ["OK", "ERROR", "OK", "OK"]
    assert rows[1]["reason"] == "the process died (exit code 7)"
    before = marks(tmp_path)
    monkeypatch.undo()
    again = engine.run(jobs(*FOUR), tmp_path, 1)
    assert [row["status"] for row in again] == ["OK"] * 4
    assert before.items() <= marks(tmp_path).items()


def test_a_wrong_scene_among_many_is_told_before_anything_is_written(tmp_path):
    with pytest.raises(SceneError, match="did you mean 'cohesion'"):
        engine.run([*jobs("0.1 MPa"), Job("couplet", {"contact.unit_unit.cohesoin": "1 MPa"})], tmp_path / "new")
    assert not (tmp_path / "new").exists()


def test_two_sweeps_do_not_share_a_folder(tmp_path):
    with (
        sole(tmp_path, DOING),
        pytest.raises(SceneError, match=r"is in use: process \d+ runs a sweep into it"),
    ):
        engine.run(jobs("0.1 MPa"), tmp_path)


def test_a_folder_that_cannot_be_written_to_is_said_in_words(tmp_path):
    (tmp_path / "file").touch()
    with pytest.raises(SceneError, match="cannot write results to"):
        engine.run(jobs("0.1 MPa"), tmp_path / "file" / "below")


def test_the_key_tells_the_scene_its_blocks_and_the_sources(tmp_path, monkeypatch):
    one, other = jobs("0.1 MPa", "0.2 MPa")
    assert one.key() == jobs("100 kPa")[0].key() != other.key()
    monkeypatch.setattr("masonry.sweeps.job.source_hash", lambda *_: "others")
    assert jobs("0.1 MPa")[0].key() != one.key()


def test_runs_are_called_by_what_differs_between_them():
    assert names(jobs("0.1 MPa", "100000.0 Pa")) == ["confinement=0.1 MPa", "confinement=1e+05 Pa"]
    assert names(jobs("0.1 MPa")) == ["couplet"]


def test_no_run_loads_a_source_that_only_shows(tmp_path):
    """The key of a run leaves those sources out."""
    import subprocess
    import sys
    from fnmatch import fnmatchcase

    code = (
        "import sys; from pathlib import Path; from masonry import scene; from masonry.laboratory import laboratory; "
        f"laboratory.run(scene.load('couplet', {SHORT!r})).save_numbers(Path(sys.argv[1])); print(*sys.modules)"
    )
    loaded = subprocess.run([sys.executable, "-c", code, str(tmp_path)], capture_output=True, text=True, check=True)
    files = [name.replace(".", "/") + ".py" for name in loaded.stdout.split() if name.startswith("masonry.")]
    assert "masonry/timeloop/timeloop.py" in files
    shown = [file for file in files for pattern in SHOWING if fnmatchcase(file, pattern)]
    assert shown == ["masonry/shell_functions.py"], "which masonry offers, and a run does not call"


@pytest.mark.parametrize(
    "failure", ['{"status": {"a": 1}, "reason": "", "seconds": 1}', '{"status": "ERROR", "reason": 3}']
)
def test_a_failure_that_nobody_wrote_so_is_none(tmp_path, failure):
    folder = tmp_path / "runs" / "abc"
    folder.mkdir(parents=True)
    (folder / "failure.json").write_text(failure, encoding="utf-8")
    assert Store(tmp_path).row("abc") is None


def test_verdicts_are_counted_with_the_most_frequent_doubt_and_old_rows_have_none():
    rows = [
        {"verdict": "sound", "doubts": ""},
        {"verdict": "with care", "doubts": "overlap, slip"},
        {"verdict": "stopped", "doubts": "stopped, slip"},
        {"verdict": None, "doubts": None},
    ]
    assert verdicts_text(rows) == "1 sound, 1 with care, 1 stopped; most frequent doubt: slip (2 of 4 runs)"
    assert verdicts_text([{"verdict": "sound", "doubts": ""}]) == "1 sound"
    assert verdicts_text([{}, {}]) == ""


def test_of_runs_that_were_stopped_it_is_told_why_and_not_that_they_were():
    stopped = {"verdict": "stopped", "doubts": "stopped", "reason": "step 9: a block has slid"}
    assert verdicts_text([stopped] * 2) == "2 stopped; stopped, for one: step 9: a block has slid"
    others = [stopped | {"doubts": "stopped, slip"}, {"verdict": "with care", "doubts": "interrupted, overlap, slip"}]
    assert verdicts_text([stopped, *others]) == (
        "1 with care, 2 stopped; most frequent doubt: slip (2 of 3 runs); stopped, for one: step 9: a block has slid"
    )

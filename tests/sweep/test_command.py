"""`masonry sweep`: a table and a picture, whatever stopped it before; and one message for what is wrong."""

import csv
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from pyarrow import parquet

from masonry.cli.main import main
from masonry.runtime.folders.own_files import LIST
from masonry.sweeps import engine
from masonry.sweeps.sweep_table import write_table
from tests.docs.pages import blocks
from tests.sweep.samples import dying, marks, text, untimed

ROOT = Path(__file__).resolve().parents[2]
GRID = '[grid]\nconfinement = ["0.1 MPa", "0.2 MPa", "0.3 MPa"]\n"solver.damping" = [0.7, 0.8]\n'
LONG = 100_000
"""Steps that take a run a quarter of a second."""


@pytest.fixture
def sweep(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)

    def write(body, **more):
        Path("sweep.toml").write_text(text(body, **more), encoding="utf-8")
        return "sweep.toml"

    return write


def table(folder):
    return untimed(parquet.read_table(Path(folder) / "sweep.parquet").to_pylist())


def started(*words):
    return subprocess.Popen(
        [sys.executable, "-m", "masonry", "sweep", *words],
        env=os.environ | {"PYTHONPATH": str(ROOT)},
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )


def test_a_sweep_leaves_a_row_a_run_with_values_as_given_and_in_si(sweep, capsys):
    path = sweep('[grid]\nconfinement = ["0.1 MPa", "250 kPa"]\n"solver.damping" = {times = [1, 0.5]}')
    assert main(["sweep", path, "--workers", "1"]) == 0
    said = capsys.readouterr()
    assert "4 OK" in said.out and "left" in said.err and "in all" in said.err
    rows = table("results/sweep-1")
    assert [row["index"] for row in rows] == [0, 1, 2, 3]
    assert [row["confinement"] for row in rows] == ["0.1 MPa"] * 2 + ["250 kPa"] * 2
    assert [row["confinement [Pa]"] for row in rows] == [1e5, 1e5, 2.5e5, 2.5e5]
    assert [row["solver.damping times"] for row in rows] == [1.0, 0.5, 1.0, 0.5]
    assert all(row["status"] == "OK" and row["peak_stress_pa"] > 1e5 for row in rows)
    sound = sum(row["verdict"] == "sound" for row in rows)
    assert all((row["verdict"] == "sound") == (row["doubts"] == "") for row in rows)
    assert (f"{sound} sound" in said.out) == (sound > 0) and ("most frequent doubt" in said.out) == (sound < 4)
    with Path("results/sweep-1/sweep.csv").open(encoding="utf-8") as file:
        people = list(csv.DictReader(file))
    assert [float(row["peak_stress_pa"]) for row in people] == [row["peak_stress_pa"] for row in rows]
    assert list(people[0]) == parquet.read_table("results/sweep-1/sweep.parquet").column_names
    assert Path("results/sweep-1/sweep.png").stat().st_size > 10_000


def test_without_pyarrow_the_table_is_a_csv_file_alone(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    assert write_table(tmp_path, {"index": [0, 1], "seconds": [1.5, None]}) == ("sweep.csv",)
    assert {file.name for file in tmp_path.iterdir()} == {"sweep.csv", LIST}
    assert (tmp_path / "sweep.csv").read_text(encoding="utf-8") == "index,seconds\n0,1.5\n1,\n"


def test_a_sweep_killed_half_way_runs_only_what_is_missing_and_gives_the_same_table(sweep):
    path = sweep(GRID, steps=LONG)
    process = started(path, "--out", "killed", "--workers", "1")
    wait_for(2, "killed", process)
    os.killpg(process.pid, signal.SIGKILL)
    process.communicate()
    before = marks(Path("killed"))
    assert 2 <= len(before) < 6 and not Path("killed/sweep.csv").exists()
    assert main(["sweep", path, "--out", "killed", "--workers", "1", "--quiet"]) == 0
    assert before.items() <= marks(Path("killed")).items()
    assert main(["sweep", path, "--out", "whole", "--quiet"]) == 0
    assert table("killed") == table("whole") and len(table("whole")) == 6
    assert not list(Path("killed/runs").glob(".*unfinished*"))


def wait_for(count, folder, process):
    """Wait until so many runs are done."""
    end = time.monotonic() + 120
    while len(marks(Path(folder))) < count:
        assert process.poll() is None and time.monotonic() < end, process.communicate()[1]
        time.sleep(0.02)


def test_a_sweep_that_is_told_to_end_ends_and_the_same_command_goes_on(sweep, capsys):
    path, folder = sweep(GRID, steps=LONG), Path("results/sweep-1")
    for done, number, code in ((1, signal.SIGINT, 130), (3, signal.SIGTERM, 143)):
        process = started(path, "--workers", "1")
        wait_for(done, folder, process)
        os.killpg(process.pid, number)
        said = process.communicate(timeout=60)[1]
        assert process.returncode == code and "Traceback" not in said
    before = marks(folder)
    assert main(["sweep", path, "--workers", "1"]) == 0
    assert f"{len(before)} of 6 runs are done already" in capsys.readouterr().err
    assert before.items() <= marks(folder).items() and os.listdir("results") == ["sweep-1"]


def test_workers_end_with_the_process_that_started_them(sweep):
    process = started(sweep(GRID, steps=200 * LONG), "--out", "here", "--workers", "2")
    workers = []
    while not workers:
        assert process.poll() is None
        children = Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()
        workers = [int(pid) for pid in children] if Path("here/runs").exists() and len(children) >= 2 else []
        time.sleep(0.05)
    time.sleep(2.0)  # they are started, and compute
    process.kill()
    process.communicate()
    end = time.monotonic() + 20
    while any(Path(f"/proc/{pid}").exists() for pid in workers):
        assert time.monotonic() < end, "workers go on without anyone to wait for them"
        time.sleep(0.1)


def test_another_sweep_in_the_folder_is_refused_with_what_differs(sweep, capsys):
    main(["sweep", sweep('[grid]\nconfinement = ["0.1 MPa"]'), "--out", "here", "--quiet"])
    before = marks(Path("here"))
    path = sweep('[grid]\nconfinement = ["0.1 MPa", "0.2 MPa"]  # one more')
    assert main(["sweep", path, "--out", "here"]) == 2
    assert "grid.confinement is ['0.1 MPa'] there, ['0.1 MPa', '0.2 MPa'] here" in capsys.readouterr().err
    assert len(table("here")) == 1
    assert main(["sweep", path, "--out", "here", "--overwrite", "--quiet"]) == 0
    assert len(table("here")) == 2 and before.items() <= marks(Path("here")).items()


def test_a_wrong_key_is_one_message_and_nothing_is_written(sweep, capsys):
    path = sweep('[grid]\n"contact.unit_unit.cohesoin" = ["1 MPa"]')
    assert main(["sweep", path]) == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1 and "did you mean 'cohesion'" in said
    assert sorted(os.listdir()) == ["sweep.toml"]


def test_a_sweep_of_which_no_run_came_to_its_end_says_why_and_does_not_return_0(sweep, capsys, monkeypatch):
    path = sweep('[grid]\nconfinement = ["0.2 MPa"]\n"solver.damping" = [0.7, 0.8]')
    with monkeypatch.context() as patched:
        patched.setattr(engine, "compute", dying)
        assert main(["sweep", path, "--workers", "1", "--out", "out", "--quiet"]) == 3
    said = capsys.readouterr()
    reason = "no run came to its end; of 2 of 2 runs: the process died (exit code 7)"
    assert said.err == f"masonry: {reason}\n" and [row["status"] for row in table("out")] == ["ERROR"] * 2
    assert main(["sweep", path, "--workers", "1", "--out", "out", "--quiet"]) == 0


WRONG = {
    "--workers -1": "--workers -1: 0 (all in this process) or more",
    "--out sweep.toml": "is a file; results need a folder",
    "--out sweep.toml/below": "cannot write results",
    "--out full": "is not empty",
}


@pytest.mark.parametrize("words", WRONG)
def test_words_that_cannot_be_followed_are_said_in_one_line(sweep, capsys, words):
    path = sweep(GRID)
    Path("full").mkdir()
    Path("full/mine.txt").touch()
    assert main(["sweep", path, *words.split()]) == 2
    said = capsys.readouterr().err
    assert WRONG[words] in said and "Traceback" not in said


def test_a_sweep_that_is_not_there_is_said(capsys):
    assert main(["sweep", "nowhere.toml"]) == 2
    assert "no sweep 'nowhere.toml': no such file" in capsys.readouterr().err


EXAMPLES = [block.text for block in blocks("docs/sweep.md") if block.language == "toml"]


@pytest.mark.parametrize(("number", "runs"), list(enumerate((6, 10, 6))))
def test_the_sweeps_of_the_documentation_run_as_they_stand(tmp_path, number, runs):
    path = tmp_path / "sweep.toml"
    path.write_text(EXAMPLES[number], encoding="utf-8")
    assert main(["sweep", str(path), "--out", str(tmp_path / "out"), "--workers", "1", "--quiet"]) == 0
    rows = table(tmp_path / "out")
    assert len(rows) == runs == len({row["key"] for row in rows})
    assert [row["status"] for row in rows] == ["OK"] * runs
    assert all(row["energy_imbalance"] < 1e-6 for row in rows)

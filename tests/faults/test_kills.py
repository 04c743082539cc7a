"""Killed, a run loses nothing that was written: it goes on from there, to the same bits."""

import random
import shutil
import signal

import pytest

from masonry.cli.main import main
from tests.faults.compare import differences
from tests.faults.kills import MOMENTS, kill_and_resume, leave_alone
from tests.faults.process import Process
from tests.faults.samples import half_done, resume, run
from tests.faults.trials import TRIALS


def test_a_run_killed_at_any_moment_goes_on_to_the_same_bits(tmp_path):
    trial = TRIALS[0]
    left_alone = leave_alone(trial, tmp_path / "alone")
    for number, moment in enumerate(MOMENTS):
        killed = kill_and_resume(trial, left_alone, tmp_path / f"{number}", moment, random.Random(number))
        assert not killed.differs, f"killed at {moment}, found {killed.found}"


@pytest.mark.slow
@pytest.mark.parametrize("trial", TRIALS, ids=lambda trial: trial.name)
def test_every_kind_of_run_killed_at_random_moments_goes_on_to_the_same_bits(trial, tmp_path, request):
    left_alone = leave_alone(trial, tmp_path / "alone")
    for number in range(-(-request.config.getoption("--kills", 100) // len(TRIALS))):
        moment = MOMENTS[number % len(MOMENTS)]
        killed = kill_and_resume(trial, left_alone, tmp_path / f"{number}", moment, random.Random(number))
        assert not killed.differs, f"kill {number} at {moment}, found {killed.found}: {killed.differs}"
        shutil.rmtree(tmp_path / f"{number}")


def test_a_run_that_dies_again_and_again_still_comes_to_the_same_bits(alone, tmp_path, monkeypatch):
    half_done(tmp_path / "out", monkeypatch)
    for _ in range(2):
        process = Process(["resume", "out", "--checkpoint-every", "1e-6 s"], tmp_path)
        process.wait_for(lambda: bool(list((tmp_path / "out").glob(".masonry-lock"))))
        process.sleep(0.3)
        process.send(signal.SIGKILL)
        process.end()
    assert resume(tmp_path / "out") == 0
    assert differences(alone, tmp_path / "out") == []


def test_what_a_killed_run_leaves_names_the_command_that_goes_on(tmp_path, monkeypatch, capsys):
    kept = half_done(tmp_path / "out", monkeypatch)
    command = f"masonry resume {tmp_path / 'out'}"
    assert command in (kept.folder / "HOW-TO-GO-ON.txt").read_text(encoding="utf-8")
    for path in (tmp_path / "out").glob("*.*"):
        path.unlink()
    assert main(["plot", str(tmp_path / "out")]) == 2
    assert command in capsys.readouterr().err


def test_a_run_killed_before_its_first_checkpoint_begins_anew_by_resume(alone, tmp_path, monkeypatch, capsys):
    kept = half_done(tmp_path / "out", monkeypatch)
    for _, path in kept.states():
        path.unlink()
    assert resume(tmp_path / "out") == 0
    assert differences(alone, tmp_path / "out") == []


def test_what_a_run_killed_at_its_very_beginning_leaves_is_no_content_of_the_folder(tmp_path):
    (tmp_path / "out" / "checkpoint").mkdir(parents=True)
    (tmp_path / "out" / ".masonry-lock").touch()
    (tmp_path / "out" / "checkpoint" / ".masonry-12-unfinished-scene.toml").touch()
    assert run(tmp_path / "out") == 0


def test_a_run_that_is_done_leaves_results_only_and_says_so_when_resumed(tmp_path, capsys):
    assert run(tmp_path / "out") == 0
    names = {path.name for path in (tmp_path / "out").iterdir()}
    assert "summary.json" in names and not {"checkpoint", ".masonry-lock"} & names
    assert main(["resume", str(tmp_path / "out")]) == 0
    assert capsys.readouterr().out == f"the run in '{tmp_path / 'out'}' is finished\n"


def test_a_run_stopped_as_unsound_cannot_be_resumed_and_says_why(tmp_path, capsys):
    too_large = ["--set", "solver.masses=real", "--set", "solver.time_step=1e-3 s"]
    assert run(tmp_path / "out", *too_large) == 3
    capsys.readouterr()
    assert resume(tmp_path / "out") == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1 and "stopped for good" in said and "unstable at step" in said


def test_a_new_run_never_takes_the_place_of_one_that_is_not_done_without_a_word(tmp_path, monkeypatch, capsys):
    half_done(tmp_path / "out", monkeypatch)
    assert run(tmp_path / "out") == 2
    assert "masonry resume" in capsys.readouterr().err
    assert run(tmp_path / "out", "--overwrite") == 0
    assert not (tmp_path / "out" / "checkpoint").exists()


@pytest.mark.parametrize("there", ["nothing", "a file", "other files", "a broken summary"])
def test_what_is_no_run_gives_one_message_and_exit_code_2(there, tmp_path, capsys):
    folder = tmp_path / "out"
    if there == "a file":
        folder.touch()
    elif there != "nothing":
        folder.mkdir()
        (folder / "summary.json").write_text("[1" if there == "a broken summary" else "[]")
    assert resume(folder) == 2
    said = capsys.readouterr().err
    assert said.startswith("masonry: ") and said.count("\n") == 1

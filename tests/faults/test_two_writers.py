"""One process at a time in a folder, and none in a folder that cannot be written to."""

import os
import signal
import threading

import pytest

from masonry.errors import SceneError
from masonry.runtime.lock import LOCK, sole
from tests.faults.compare import differences
from tests.faults.process import Process, states
from tests.faults.samples import LONG, forbid_writing, half_done, read_only, resume, run

WORDS = ["run", "couplet", *LONG, "--out", "out", "--quiet", "--checkpoint-every", "0.02 s"]


def test_a_second_run_or_resume_in_a_folder_says_who_is_there_and_harms_nothing(tmp_path, monkeypatch, capsys):
    first = Process(WORDS, tmp_path)
    out = tmp_path / "out"
    assert first.wait_for(lambda: bool(states(out)))
    first.send(signal.SIGSTOP)
    assert (run(out), run(out, "--overwrite"), resume(out)) == (2, 2, 2)
    first.send(signal.SIGCONT)
    said = capsys.readouterr().err.splitlines()
    assert len(said) == 3
    for line in said:
        assert f"'{out}' is in use: process {first.process.pid} runs a scene into it (on " in line
    assert first.end() == 0 and (out / "summary.json").is_file() and not (out / LOCK).exists()


def test_the_lock_of_a_killed_process_holds_nobody_up(alone, tmp_path, monkeypatch):
    half_done(tmp_path / "out", monkeypatch)
    (tmp_path / "out" / LOCK).write_text("process 1 runs a scene into it")
    assert resume(tmp_path / "out") == 0
    assert differences(alone, tmp_path / "out") == []


def test_of_many_at_once_one_is_in_the_folder_at_any_time(tmp_path):
    """A lock that is removed as it is given back must not let two in."""
    inside, most, refused = [], [0], [0]

    def enter() -> None:
        for _ in range(200):
            try:
                with sole(tmp_path, "tries"):
                    inside.append(1)
                    most[0] = max(most[0], len(inside))
                    inside.pop()
            except SceneError:
                refused[0] += 1

    crowd = [threading.Thread(target=enter) for _ in range(4)]
    for one in crowd:
        one.start()
    for one in crowd:
        one.join()
    assert most[0] == 1 and not list(tmp_path.iterdir())


@pytest.mark.parametrize("act", [run, resume])
def test_a_folder_that_cannot_be_written_to_is_said_in_one_line_before_anything_is_computed(
    act, tmp_path, monkeypatch, capsys
):
    with read_only(tmp_path / "disk") as folder:
        half_done(folder / "out", monkeypatch)
        before = {path.name: path.read_bytes() for path in (folder / "out" / "checkpoint").iterdir()}
        forbid_writing(folder if not os.geteuid() else folder / "out")
        monkeypatch.setattr("masonry.laboratory.laboratory.run", lambda *_, **__: pytest.fail("it was computed"))
        assert act(folder / "out") == 2
        said = capsys.readouterr().err
        assert said.count("\n") == 1 and f"cannot write results to '{folder / 'out'}'" in said
        assert {path.name: path.read_bytes() for path in (folder / "out" / "checkpoint").iterdir()} == before

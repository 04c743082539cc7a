"""Ctrl-C, SIGTERM, SIGHUP: the present steps are finished, all is written, the exit code says which; twice, at once."""

import os
import signal
import subprocess
import sys
import threading

import pytest

from masonry.results import store
from masonry.runtime.interrupts import interruptible
from tests.faults.compare import differences
from tests.faults.process import Process, states
from tests.faults.samples import LONG, ended_after, resume, run

WORDS = ["run", "couplet", *LONG, "--out", "out", "--quiet", "--checkpoint-every", "0.02 s"]


@pytest.mark.parametrize(("number", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 143), (signal.SIGHUP, 129)])
def test_a_signal_ends_the_run_with_results_a_checkpoint_and_the_way_to_go_on(number, code, tmp_path):
    process = Process(WORDS, tmp_path)
    assert process.wait_for(lambda: bool(states(tmp_path / "out")))
    process.send(number)
    assert process.end() == code
    assert "resume with: masonry resume out" in process.said and "Traceback" not in process.said
    assert (tmp_path / "out" / "curve.csv").is_file() and states(tmp_path / "out")
    assert not (tmp_path / "out" / ".masonry-lock").exists()


@pytest.mark.parametrize("chunks", [1, 5, 13])
def test_a_run_ended_by_a_signal_goes_on_to_the_same_bits(chunks, alone, tmp_path, monkeypatch):
    out = tmp_path / "out"
    with ended_after(chunks, signal.SIGTERM, monkeypatch):
        assert run(out, "--checkpoint-every", "5min") == 143
    assert len(states(out)) == 1
    with ended_after(2, signal.SIGINT, monkeypatch):
        assert resume(out) == 130
    assert resume(out) == 0
    assert differences(alone, out) == []


def test_a_run_without_checkpoints_ends_with_its_results_and_says_that_it_cannot_go_on(tmp_path, monkeypatch, capsys):
    with ended_after(5, signal.SIGINT, monkeypatch):
        assert run(tmp_path / "out", "--checkpoint-every", "never") == 130
    assert "resume" not in capsys.readouterr().err
    assert resume(tmp_path / "out") == 2
    assert "kept no checkpoint" in capsys.readouterr().err


def test_a_signal_before_the_first_step_leaves_nothing_of_a_new_run_and_all_of_an_old_one(tmp_path, monkeypatch):
    with ended_after(0, signal.SIGTERM, monkeypatch):
        assert run(tmp_path / "out") == 143
    assert not (tmp_path / "out").exists()
    with ended_after(5, signal.SIGTERM, monkeypatch):
        assert run(tmp_path / "out") == 143
    with ended_after(0, signal.SIGINT, monkeypatch):
        assert resume(tmp_path / "out") == 130
    assert resume(tmp_path / "out") == 0


def test_a_second_ctrl_c_ends_at_once_with_what_was_written_before(tmp_path):
    process = Process(WORDS, tmp_path)
    assert process.wait_for(lambda: bool(states(tmp_path / "out")))
    process.send(signal.SIGINT)
    process.wait_for(lambda: "once more" in process._said.read_text())
    process.send(signal.SIGINT)
    assert process.end() == 130
    assert "ended at once; resume with: masonry resume out" in process.said and "Traceback" not in process.said
    assert not (tmp_path / "out" / "cracks.png").exists() and states(tmp_path / "out")


@pytest.mark.parametrize(
    ("number", "code", "word"), [(signal.SIGINT, 130, "interrupted"), (signal.SIGHUP, 129, "hung")]
)
def test_a_signal_while_results_are_written_leaves_all_of_them_and_tells_the_shell(
    number, code, word, alone, tmp_path, monkeypatch, capsys
):
    save_fields = store.save_fields

    def signalled(*what: object) -> None:
        signal.raise_signal(number)
        save_fields(*what)

    monkeypatch.setattr(store, "save_fields", signalled)
    assert run(tmp_path / "out") == code
    said = capsys.readouterr().err
    assert f"masonry: {word}" in said and f"its results are in '{tmp_path / 'out'}'" in said
    assert differences(alone, tmp_path / "out") == [] and not (tmp_path / "out" / "checkpoint").exists()


HALF_MADE = """
import os, signal, zipfile
from masonry.results import store
from masonry.runtime.interrupts import interruptible
with interruptible() as asked:
    asked()
    os.kill(os.getpid(), signal.SIGINT)
    half = zipfile.ZipFile.__new__(zipfile.ZipFile)
    half.fp = 1
    try:
        os.kill(os.getpid(), signal.SIGINT)
    except KeyboardInterrupt:
        del half
"""


def test_a_file_that_a_second_ctrl_c_leaves_half_made_shows_no_traceback():
    done = subprocess.run([sys.executable, "-c", HALF_MADE], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0
    assert done.stderr == "masonry: ending after the present steps; once more ends it at once\n"


def test_outside_the_main_thread_signals_stay_as_they_are():
    before, handlers = signal.getsignal(signal.SIGTERM), []

    def listen() -> None:
        with interruptible() as asked:
            handlers.append((asked(), signal.getsignal(signal.SIGTERM)))

    thread = threading.Thread(target=listen)
    thread.start()
    thread.join()
    assert handlers == [(False, before)]


def test_signals_are_given_back_afterwards():
    usual = signal.getsignal(signal.SIGINT), signal.getsignal(signal.SIGTERM)
    with interruptible() as asked:
        assert not asked()
        os.kill(os.getpid(), signal.SIGTERM)
        assert asked() and asked.code == 143
        with pytest.raises(KeyboardInterrupt):
            os.kill(os.getpid(), signal.SIGTERM)
    assert (signal.getsignal(signal.SIGINT), signal.getsignal(signal.SIGTERM)) == usual

"""Bad input of every kind, a few of each: one message, and nothing else. More: `python -m verification.fuzz`."""

import os
import tempfile
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from verification.fuzz.campaign import shared_out, tasks_of
from verification.fuzz.kind import Attempt, Kind, all_kinds
from verification.fuzz.room import Room
from verification.fuzz.trial import tried
from verification.fuzz.worker import no_runs

FEW = {"results": 3, "sweep-folders": 3, "iges-brep": 4, "step": 6, "vtu": 8, "msh": 8, "tess": 10}
"""Inputs of the kinds whose every input takes long; the others have 25."""


@pytest.fixture
def room(tmp_path, monkeypatch):
    """A room that leaves this process as it was."""
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path / "tmp"))
    for name, most in (("BLOCKS", 100), ("CONTACT_POINTS", 5000), ("TETS", 5000)):
        monkeypatch.setattr(f"masonry.assembly.size_limits.{name}", most)
    monkeypatch.setattr("masonry.sweep.engine.work", no_runs)
    there = os.getcwd()
    yield Room(tmp_path, ())
    os.chdir(there)


@pytest.mark.parametrize("name", sorted(set(all_kinds()) - {"scene"} - set(FEW)))
def test_bad_input_ends_in_one_message(name, room):
    _try_some(name, 25, room)


def test_a_bad_scene_ends_in_one_message(room):
    _try_some("scene", 40, room)


@pytest.mark.parametrize("name", sorted(FEW))
def test_a_bad_file_of_another_program_ends_in_one_message(name, room, monkeypatch):
    from verification.fuzz.inputs import reading

    monkeypatch.setattr("geometry.files.sandbox.begin", lambda task, folder, alive: reading.Forked(task, folder))
    _try_some(name, FEW[name], room)


def _try_some(name: str, count: int, room: Room) -> None:
    @settings(
        max_examples=count, derandomize=True, database=None, deadline=None, suppress_health_check=list(HealthCheck)
    )
    @given(st.randoms(use_true_random=False))
    def ends_well(draw):
        trial = tried(all_kinds()[name], draw, 0, room)
        assert not trial.faults

    ends_well()


def _clumsy(draw, folder: Path) -> Attempt:
    return Attempt(["list"])


@pytest.mark.parametrize(
    ("act", "words"),
    [
        (lambda words: (_ for _ in ()).throw(ValueError("no")), "traceback"),
        (lambda words: Path("elsewhere").write_text("x") and 0, "outside: elsewhere"),
        (lambda words: (Path(tempfile.tempdir) / "left").write_text("x") and 0, "left over: tmp/left"),
        (lambda words: print("\x1b[2J") or 0, "control characters"),
        (lambda words: print("masonry-fuzz-forged-line") or 0, "a line of its own"),
        (lambda words: print("root:$6$fuzzsecretsalt") or 0, "repeated"),
        (lambda words: 2, "no message"),
        (lambda words: 1000, "exit code"),
        (lambda words: len(bytearray(b"x" * (200 << 20))) * 0, "memory"),
    ],
)
def test_a_clumsy_program_is_found_out(act, words, room, monkeypatch):
    monkeypatch.setattr("masonry.cli.main.main", act)
    monkeypatch.setattr("verification.fuzz.trial.MEMORY", 0 if words == "memory" else 1 << 40)
    trial = tried(Kind("clumsy", "", 1, _clumsy), None, 0, room)
    assert any(words in fault for fault in trial.faults), trial.faults


def test_inputs_are_shared_out_among_all_kinds_and_add_up():
    counts = shared_out(1000, list(all_kinds().values()))
    assert sum(counts.values()) == 1000
    assert min(counts.values()) >= 1
    tasks = tasks_of(counts, 1, Path("/tmp"))
    first = {task.kind for task in tasks[:500]}
    assert first == set(counts)

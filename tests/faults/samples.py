"""A short run from the shell, ways to end it early, and disks that are full or cannot be written to."""

import contextlib
import os
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest

from masonry.cli.main import main
from masonry.runtime.interrupts import Interrupts
from masonry.timeloop.checkpoint import Checkpoints

SHORT = [*("--set", "settle.steps=100"), *("--set", "drive.steps=2000"), *("--set", "solver.rows=40")]
LONG = [*("--set", "drive.steps=40000"), *("--set", "solver.rows=300")]
ALWAYS = ["--checkpoint-every", "1e-6 s"]
"""A checkpoint after each chunk of steps."""


def run(out: Path, *more: str) -> int:
    """`masonry run` of a couplet with a checkpoint after each chunk; the exit code."""
    return main(["run", "couplet", *SHORT, "--out", str(out), "--quiet", *ALWAYS, *more])


def resume(out: Path, *more: str) -> int:
    """`masonry resume`; the exit code."""
    return main(["resume", str(out), "--quiet", *more])


class Dies(BaseException):
    """Stands for a kill: nothing that a run does on its way out is done."""


@contextlib.contextmanager
def ended_after(chunks: int, number: int, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Within, a run is told to end by a signal of this number after some chunks of steps."""
    with monkeypatch.context() as patched:
        calls: list[int] = []

        def told(asked: Interrupts) -> bool:
            calls.append(1)
            if len(calls) > chunks:
                asked.number = number
            return asked.number != 0

        patched.setattr(Interrupts, "__call__", told)
        yield


def half_done(out: Path, monkeypatch: pytest.MonkeyPatch, chunks: int = 8) -> Checkpoints:
    """A folder as a kill leaves it: two checkpoints, no results."""
    with monkeypatch.context() as patched:
        done: list[int] = []
        write = Checkpoints.write

        def last(kept: Checkpoints, state: dict) -> None:
            write(kept, state)
            done.append(1)
            if len(done) == chunks:
                raise Dies

        patched.setattr(Checkpoints, "write", last)
        with pytest.raises(Dies):
            run(out)
    kept = Checkpoints(out)
    assert [number for number, _ in kept.states()] == [chunks, chunks - 1]
    assert {path.name for path in out.iterdir()} == {"checkpoint"}
    return kept


@contextlib.contextmanager
def disk(place: Path, size: str) -> Iterator[Path]:
    """A disk of its own at a new folder; skips the test where none can be mounted."""
    place.mkdir()
    made = subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}", "masonry", place], capture_output=True)
    if made.returncode:
        pytest.skip("no disk can be mounted here")
    try:
        yield place
    finally:
        subprocess.run(["umount", "-l", place], check=True)


def remount(place: Path, options: str) -> None:
    """Change the size of the disk, or whether it can be written to."""
    subprocess.run(["mount", "-o", f"remount,{options}", place], check=True)


@contextlib.contextmanager
def read_only(folder: Path) -> Iterator[Path]:
    """A folder that nobody may write to; for root, who may always, on a disk that is read only."""
    if os.geteuid():
        folder.mkdir()
        yield folder
        folder.chmod(0o755)
        return
    with disk(folder, "1m"):
        yield folder
        remount(folder, "rw")


def forbid_writing(folder: Path) -> None:
    """Make it so, when it holds what it should."""
    if os.geteuid():
        folder.chmod(0o555)
    else:
        remount(folder, "ro")

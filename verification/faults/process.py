"""A `masonry` process that can be ended at any moment, and what it left in its folder."""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

POLL = 0.0005
PATIENCE = 600.0
"""Seconds after which a process is taken to hang."""


class Process:
    """`masonry WORDS`, from its start; `said` is what it wrote when it has ended."""

    def __init__(self, words: list[str], cwd: Path, before: Callable[[], None] | None = None) -> None:
        self.begun = time.monotonic()
        self.process = subprocess.Popen(
            [sys.executable, "-m", "masonry", *words],
            cwd=cwd,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            preexec_fn=before,
            env={**os.environ, "OMP_WAIT_POLICY": "passive", "PYTHONPATH": str(Path(__file__).resolve().parents[2])},
        )
        self.said = ""
        self.answer = ""

    @property
    def age(self) -> float:
        """Seconds since its start."""
        return time.monotonic() - self.begun

    @property
    def runs(self) -> bool:
        return self.process.poll() is None

    def wait_for(self, happened: Callable[[], bool]) -> bool:
        """Whether something happened before the process ended."""
        while not happened():
            if not self.runs:
                return False
            if self.age > PATIENCE:
                self.send(signal.SIGKILL)
                raise TimeoutError(f"nothing happened for {PATIENCE:g} s")
            time.sleep(POLL)
        return True

    def sleep(self, seconds: float) -> None:
        """Wait, at most as long as the process runs."""
        until = time.monotonic() + seconds
        self.wait_for(lambda: time.monotonic() >= until)

    def send(self, number: int) -> None:
        self.process.send_signal(number)

    def end(self) -> int:
        """Its exit code, when it has ended by itself or by a signal (negative)."""
        self.answer, self.said = self.process.communicate(timeout=PATIENCE)
        return self.process.returncode


def states(folder: Path) -> list[str]:
    """Names of the checkpoints that are there, oldest first."""
    return sorted(path.name for path in (folder / "checkpoint").glob("state-*.npz"))


def half_written(folder: Path) -> list[str]:
    """Names of what was being written as its process died."""
    return sorted(path.name for path in (*folder.glob(".*-unfinished-*"), *folder.glob("checkpoint/.*-unfinished-*")))

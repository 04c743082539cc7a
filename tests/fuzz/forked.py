"""The reader of foreign files as a fork of this process: the same code under the same limits, begun in milliseconds.

Started afresh, as the program does it, a reader needs most of a second to begin; tests/geometry/files does that.
"""

import os
import subprocess
from multiprocessing import get_context
from pathlib import Path

from geometry.files import sandbox


class Forked:
    """As far as `geometry.files.sandbox` needs a subprocess.Popen; takes what its `begin` takes."""

    stdin = None

    def __init__(self, task: str, folder: Path) -> None:
        self.process = get_context("fork").Process(target=_read, args=(task, folder), daemon=True)
        self.process.start()
        self.kill = self.process.kill

    def poll(self) -> int | None:
        """The exit code, None while it runs."""
        return self.process.exitcode

    def wait(self, timeout: float | None = None) -> int:
        """The exit code at the end. Raises subprocess.TimeoutExpired."""
        self.process.join(timeout)
        if self.process.exitcode is None:
            raise subprocess.TimeoutExpired("reader", timeout or 0.0)
        return self.process.exitcode


def _read(task: str, folder: Path) -> None:
    os.chdir(folder)
    nothing = os.open(os.devnull, os.O_RDWR)
    for stream in range(3):
        os.dup2(nothing, stream)
    os._exit(sandbox.serve(task))

"""A `masonry` process that can be ended at any moment, and what it left in its folder."""

import os
import signal
import sys
import tempfile
import time
from collections.abc import Callable
from functools import cache
from multiprocessing import get_context
from pathlib import Path
from typing import Any

POLL = 0.001
PATIENCE = 900.0
"""Seconds after which a process is taken to hang."""
LOADED = (
    *(
        "masonry.cli.main",
        "masonry.laboratory.run_command",
        "masonry.laboratory.laboratory",
        "masonry.laboratory.summary.provenance",
    ),
    *("masonry.results.archive", "masonry.results.fields", "masonry.curves.curve", "masonry.pictures.crack_picture"),
    *("h5py", "scipy.spatial"),
)
"""Modules that each process finds loaded: a hundred of them then start in no time."""


@cache
def _context() -> Any:
    context = get_context("forkserver")
    context.set_forkserver_preload(list(LOADED))
    return context


def _act(words: list[str], cwd: str, said: str, before: Callable[[], None] | None) -> None:
    """The whole life of the process: what the shell would have called."""
    handle = os.open(said, os.O_WRONLY | os.O_APPEND)
    os.dup2(handle, 1)
    os.dup2(handle, 2)
    os.chdir(cwd)
    signal.signal(signal.SIGINT, signal.default_int_handler)
    os.environ["OMP_WAIT_POLICY"] = "passive"  # threads that wait give way: there may be more of them than processors
    if before is not None:
        before()
    from masonry.cli.main import main

    sys.exit(main(words))


class Process:
    """`masonry WORDS`, from its start; `said` is what it wrote when it has ended.

    before  a function of a module that is called in the process first
    """

    def __init__(self, words: list[str], cwd: Path, before: Callable[[], None] | None = None) -> None:
        handle, said = tempfile.mkstemp(prefix="masonry-said-")
        os.close(handle)
        self._said = Path(said)
        self.process = _context().Process(target=_act, args=(words, str(cwd), said, before), daemon=True)
        self.begun = time.monotonic()
        self.process.start()
        self.said = ""

    @property
    def age(self) -> float:
        """Seconds since its start."""
        return time.monotonic() - self.begun

    @property
    def runs(self) -> bool:
        return bool(self.process.is_alive())

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
        if self.runs:
            os.kill(self.process.pid, number)

    def end(self) -> int:
        """Its exit code, when it has ended by itself or by a signal (negative)."""
        self.wait_for(lambda: False)
        self.process.join()
        self.said = self._said.read_text(encoding="utf-8", errors="replace")
        self._said.unlink()
        return int(self.process.exitcode)


def states(folder: Path) -> list[str]:
    """Names of the checkpoints that are there, oldest first."""
    return sorted(path.name for path in (folder / "checkpoint").glob("state-*.npz"))


def half_written(folder: Path) -> list[str]:
    """Names of what was being written as its process died."""
    return sorted(path.name for path in (*folder.glob(".*-unfinished-*"), *folder.glob("checkpoint/.*-unfinished-*")))

"""Draws the pictures of a run in processes of their own, which load what they need while the run computes.

What draws takes longer to load than a short run takes to compute. The process is forked before anything else is loaded,
waits for the folder, reads the numbers that lie there, and draws both pictures at once. Whatever goes wrong there is
tried again by the run itself, which then says what it is.
"""

import contextlib
import os
import signal
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import NoReturn

from masonry.runtime.processors import processors

HEAVY = ("numpy", "numba", "matplotlib")
"""Where one of these is loaded, threads may run, or there is nothing to be gained."""


@contextlib.contextmanager
def painter() -> "Iterator[Painter | None]":
    """A painter while a command runs; None where it would not help."""
    if not hasattr(os, "fork") or processors() < 2 or any(name in sys.modules for name in HEAVY):
        yield None
        return
    with contextlib.closing(Painter()) as hired:
        yield hired


class Painter:
    """A process that waits for a folder of results, and draws its pictures."""

    def __init__(self) -> None:
        order, self._order = os.pipe()
        self.process = os.fork()
        if self.process == 0:
            os.close(self._order)
            _wait_and_draw(order)
        os.close(order)
        self._begun = False

    @property
    def is_gone(self) -> bool:
        """Whether it has come to its end."""
        return self.process == 0

    def begin(self, folder: Path) -> None:
        """The numbers are in this folder: draw them."""
        with contextlib.suppress(BrokenPipeError):
            os.write(self._order, os.fsencode(folder.absolute()))
        self._begun = True
        self._let_go()

    def has_drawn(self) -> bool:
        """Wait until it is done; whether both pictures are there."""
        return os.waitstatus_to_exitcode(self._ended()) == 0

    def close(self) -> None:
        """Without an order it goes at once."""
        if not self.is_gone:
            if not self._begun:
                os.kill(self.process, signal.SIGKILL)
                self._let_go()
            self._ended()

    def _let_go(self) -> None:
        os.close(self._order)

    def _ended(self) -> int:
        status = os.waitpid(self.process, 0)[1]
        self.process = 0
        return status


def _wait_and_draw(order: int) -> NoReturn:
    """The life of the process, which no exception leaves."""
    try:
        signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the run, which still wants its pictures
        _load()
        folder = os.fsdecode(os.read(order, os.fpathconf(order, "PC_PIPE_BUF")))
        drawn = not folder or _draw(Path(folder))
    except BaseException:
        drawn = False
    os._exit(0 if drawn else 1)


def _load() -> None:
    """What reads a result and draws it."""
    import h5py  # noqa: F401
    import matplotlib.backends.backend_agg  # noqa: F401

    from masonry.results import data as results  # noqa: F401


def _draw(folder: Path) -> bool:
    """Both pictures, one of them in another process."""
    from masonry.results.data import load_history

    result = load_history(folder)
    other = os.fork()
    if other == 0:
        code = 1
        try:
            result.save_picture(folder, "cracks.png")
            code = 0
        finally:
            os._exit(code)
    result.save_picture(folder, "curve.png")
    return os.waitstatus_to_exitcode(os.waitpid(other, 0)[1]) == 0

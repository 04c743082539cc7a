"""Ctrl-C, SIGTERM and SIGHUP: asked once, a run ends after the present steps; asked twice, it ends at once."""

import contextlib
import os
import signal
import threading
from collections.abc import Iterator
from typing import Any

from masonry.runtime.shell import ENDING

SIGNALS = (signal.SIGINT, *ENDING)


class Interrupts:
    """Whether this process has been asked to end, and by which signal; call it to know."""

    def __init__(self) -> None:
        self.number = 0

    def __call__(self) -> bool:
        return self.number != 0

    @property
    def code(self) -> int:
        """The exit code that tells a shell: 130 for Ctrl-C, 143 for SIGTERM, 129 for SIGHUP."""
        return 128 + (self.number or signal.SIGINT)

    def hear(self, number: int, frame: Any) -> None:
        """A signal came. Raises KeyboardInterrupt if it is not the first."""
        if self.number:
            raise KeyboardInterrupt
        self.number = number
        with contextlib.suppress(OSError):
            os.write(2, b"masonry: ending after the present steps; once more ends it at once\n")


@contextlib.contextmanager
def interruptible() -> Iterator[Interrupts]:
    """Listen to them for a while, but to what is ignored (nohup); outside the main thread nothing changes."""
    interrupts = Interrupts()
    if threading.current_thread() is not threading.main_thread():
        yield interrupts
        return
    heard = [number for number in SIGNALS if number == signal.SIGINT or signal.getsignal(number) != signal.SIG_IGN]
    usual = {number: signal.signal(number, interrupts.hear) for number in heard}
    try:
        yield interrupts
    finally:
        for number, handler in usual.items():
            signal.signal(number, handler)

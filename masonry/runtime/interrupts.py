"""Ctrl-C, SIGTERM and SIGHUP: asked once, a run ends after the present steps; asked twice, it ends at once."""

import contextlib
import os
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator
from typing import Any, TypeVar

from masonry.runtime.shell import ENDING

SIGNALS = (signal.SIGINT, *ENDING)
LOOK_SECONDS = 1.0
Answer = TypeVar("Answer")


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
        """A signal came. Raises KeyboardInterrupt if it is not the first; what that leaves half made (a file that is
        written) says nothing of it."""
        if self.number:
            sys.unraisablehook = lambda _: None
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
    usual, told = {number: signal.signal(number, interrupts.hear) for number in heard}, sys.unraisablehook
    try:
        yield interrupts
    finally:
        sys.unraisablehook = told
        for number, handler in usual.items():
            signal.signal(number, handler)


@contextlib.contextmanager
def interrupt_afterwards() -> Iterator[list[int]]:
    """Ctrl-C fills a list, which may be looked at meanwhile, and is raised as KeyboardInterrupt at the end.

    Where somebody else looks after Ctrl-C, and outside the main thread, it stays so.
    """
    pressed: list[int] = []
    usual = signal.getsignal(signal.SIGINT)
    if threading.current_thread() is not threading.main_thread() or usual is not signal.default_int_handler:
        yield pressed
        return
    signal.signal(signal.SIGINT, lambda number, frame: pressed.append(number))
    try:
        yield pressed
    finally:
        signal.signal(signal.SIGINT, usual)
    if pressed:
        raise KeyboardInterrupt


def interruptible_wait(work: Callable[[], Answer], every: Callable[[float], None] | None = None) -> Answer:
    """What a call comes to that does not hear Ctrl-C itself: it works in a thread, which is left alone on Ctrl-C.

    every  is told the seconds so far, about once a second. Raises what the call raises.
    """
    found: list[Answer] = []
    raised: list[BaseException] = []

    def do() -> None:
        try:
            found.append(work())
        except BaseException as error:
            raised.append(error)

    begun, working = time.monotonic(), threading.Thread(target=do, daemon=True)
    working.start()
    while working.is_alive():
        working.join(LOOK_SECONDS)
        if every is not None and working.is_alive():
            every(time.monotonic() - begun)
    if raised:
        raise raised[0]
    return found[0]

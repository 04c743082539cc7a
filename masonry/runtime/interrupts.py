"""Ctrl-C, SIGTERM and SIGHUP: asked once, a run that has begun ends after the present steps; asked twice, at once."""

import atexit
import contextlib
import os
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator
from typing import Any, TypeVar

from masonry.runtime import ending
from masonry.runtime.ending import SIGNALS, Ended

LOOK_SECONDS = 1.0
Answer = TypeVar("Answer")


class Interrupts:
    """Whether this process has been asked to end, and by which signal; call it to know. Until it is called for the
    first time nobody looks, as nothing has begun: a signal ends that at once."""

    def __init__(self) -> None:
        self.number, self.signals, self.begun = 0, 0, False
        self.untold = threading.Lock()

    def __call__(self) -> bool:
        self.begun = True
        return self.number != 0

    @property
    def code(self) -> int:
        """The exit code that tells a shell: 130 for Ctrl-C, 143 for SIGTERM, 129 for SIGHUP."""
        return 128 + (self.number or signal.SIGINT)

    def hear(self, number: int, frame: Any) -> None:
        """A signal came. Raises Ended if it is not the first, or nothing has begun; what that leaves half made (a file
        that is written) says nothing of it."""
        first, self.number = not self.number, self.number or number
        if not first or not self.begun:
            sys.unraisablehook = lambda _: None
            raise Ended(self.number)
        self.tell()

    def tell(self) -> None:
        """Say, once, that it was heard."""
        if self.untold.acquire(blocking=False):
            with contextlib.suppress(OSError):
                os.write(2, b"masonry: ending after the present steps; once more ends it at once\n")

    def waits(self) -> bool:
        """As `ending.Command.waits`, which hears of a signal while the steps are at work."""
        self.signals += 1
        if self.begun and self.signals == 1:
            self.tell()
            return True
        return False


@contextlib.contextmanager
def interruptible() -> Iterator[Interrupts]:
    """Listen to them for a while, but to what is ignored (nohup); outside the main thread nothing changes."""
    interrupts = Interrupts()
    if threading.current_thread() is not threading.main_thread():
        yield interrupts
        return
    heard = [number for number in SIGNALS if number == signal.SIGINT or signal.getsignal(number) != signal.SIG_IGN]
    usual, hook = {number: signal.signal(number, interrupts.hear) for number in heard}, sys.unraisablehook
    command = ending.CURRENT
    before, command.waits = command.waits, interrupts.waits
    try:
        yield interrupts
    finally:
        command.waits = before
        sys.unraisablehook = hook
        for number, handler in usual.items():
            signal.signal(number, handler)


@contextlib.contextmanager
def interrupt_afterwards() -> Iterator[list[int]]:
    """Interrupts until the end of a block: each that would raise KeyboardInterrupt (Ctrl-C; of a command all that ends
    it) is added to a list, which may be looked at meanwhile, and is raised at the end.

    Where somebody else looks after it, and outside the main thread, it stays so.
    """
    pressed: list[int] = []
    if threading.current_thread() is not threading.main_thread():
        yield pressed
        return
    handlers = {number: signal.getsignal(number) for number in SIGNALS}
    usual = {n: h for n, h in handlers.items() if h in (signal.default_int_handler, ending.CURRENT.end)}
    for number in usual:
        signal.signal(number, lambda number, frame: pressed.append(number))
    try:
        yield pressed
    finally:
        for number, handler in usual.items():
            signal.signal(number, handler)
    if pressed:
        signal.raise_signal(pressed[0])


def interruptible_wait(work: Callable[[], Answer], every: Callable[[float], None] | None = None) -> Answer:
    """Result of a call that does not hear Ctrl-C itself: it works in a thread, which is left alone on Ctrl-C, and for
    which the process does not wait at its end.

    every  is told the seconds so far, about once a second. Raises what the call raises.

    Whether the work is over is asked of what it left, not of the thread: a `join` that a signal ends takes a thread for
    dead that is alive (Python 3.11).
    """
    if threading.current_thread() is not threading.main_thread():
        return work()
    answers: list[Answer] = []
    raised: list[BaseException] = []

    def do() -> None:
        try:
            answers.append(work())
        except BaseException as error:
            raised.append(error)

    def over() -> bool:
        return bool(answers or raised)

    begun, working = time.monotonic(), threading.Thread(target=do, daemon=True)
    try:
        working.start()
        while not over():
            working.join(LOOK_SECONDS)
            if every is not None and not over():
                every(time.monotonic() - begun)
    except KeyboardInterrupt as ended:
        atexit.register(_end_with, over, ending.code_of(ended))
        raise
    if raised:
        raise raised[0]
    return answers[0]


def _end_with(over: Callable[[], bool], code: int) -> None:
    """At the end of the process: native code that is still at work must not see its libraries taken down."""
    if not over():
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(code)

"""Ctrl-C, SIGTERM and SIGHUP end a command: in order, if that takes no longer than GRACE, else at once.

A signal raises Ended in the main thread, so that all that is half-done is put away. Python raises it between two of
its own instructions only: native code that works for long keeps it waiting, and a callback of native code may swallow
it, or make another error of it. So another thread hears of signals as well, by a pipe that the system writes to.
"""

import contextlib
import os
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from typing import NoReturn

from geometry.operating_system import SYSTEM
from masonry.runtime.shell import INTERRUPTED

SIGNALS = (signal.SIGINT, *SYSTEM.ending)
"""Ctrl-C, and what asks a process to end: a system that shuts down, a terminal that is closed."""
GRACE = 3.0
"""Seconds that a command has to put away what is half-done."""
WORDS = {signal.SIGINT: "interrupted", signal.SIGTERM: "terminated"}


class Ended(KeyboardInterrupt):
    """A signal of this number asked the process to end."""

    def __init__(self, number: int) -> None:
        super().__init__(number)
        self.number = number


def code_of(error: KeyboardInterrupt) -> int:
    """The exit code that tells a shell: 130 for Ctrl-C, 143 for SIGTERM, 129 for SIGHUP."""
    return 128 + error.number if isinstance(error, Ended) else INTERRUPTED


def word_of(error: KeyboardInterrupt) -> str:
    """End of a command by an interrupt, in a word."""
    return word_of_signal(code_of(error) - 128)


def word_of_signal(number: int) -> str:
    """End of a command by a signal of this number, in a word."""
    return WORDS.get(signal.Signals(number), "hung up")


class Command:
    """A command that signals may end.

    number   of the signal that ends it, 0 so far
    waits    says, on each signal, whether the command goes on for now: a run that finishes its steps
    """

    def __init__(self) -> None:
        self.number = 0
        self.waits: Callable[[], bool] = lambda: False
        self.over = threading.Event()

    def end(self, number: int, frame: object = None) -> NoReturn | None:
        """The handler: raises Ended, once."""
        if self.number:
            return None
        self.number = number
        sys.unraisablehook = lambda _: None  # where a callback swallows it, and says so
        raise Ended(number)

    def look_on(self, pipe: int) -> None:
        """End the process at once where a signal has no effect in time; the pipe brings each number, 0 at last."""
        while number := os.read(pipe, 1)[0]:
            if number not in SIGNALS or self.waits():
                continue
            if not self.over.wait(GRACE):
                os.write(2, f"masonry: {word_of_signal(number)}; ended at once\n".encode())
                os._exit(128 + number)


CURRENT = Command()
"""The command that this process carries out; one that no signal reaches where there is none."""


@contextlib.contextmanager
def ended_by_signals() -> Iterator[Command]:
    """Have them end what is done within, but what is ignored (nohup); outside the main thread nothing changes."""
    global CURRENT
    if threading.current_thread() is not threading.main_thread():
        yield CURRENT
        return
    before, hook, CURRENT = CURRENT, sys.unraisablehook, Command()
    usual = {n: signal.getsignal(n) for n in SIGNALS}
    ours = [n for n, handler in usual.items() if handler in (signal.SIG_DFL, signal.default_int_handler)]
    theirs, mine = SYSTEM.wakeup_pipe()
    looking = threading.Thread(target=CURRENT.look_on, args=(theirs,), daemon=True)
    looking.start()
    wakeup = signal.set_wakeup_fd(mine, warn_on_full_buffer=False)
    for number in ours:
        signal.signal(number, CURRENT.end)
    try:
        yield CURRENT
    finally:
        for number in ours:
            signal.signal(number, usual[number])
        signal.set_wakeup_fd(wakeup)
        CURRENT.over.set()
        os.write(mine, b"\0")
        looking.join()
        os.close(mine)
        os.close(theirs)
        CURRENT, sys.unraisablehook = before, hook

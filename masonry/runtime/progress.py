"""Progress of a long run: a bar with time left on a terminal, plain lines when the output goes to a file or a pipe."""

import contextlib
import sys
import threading
import time
from collections.abc import Callable, Iterable, Iterator
from typing import Any, TextIO

LINE_FRACTION = 0.1
LINE_SECONDS = 10.0
"""A plain line is due after this share of the steps, or after this time."""
TICK_SECONDS = 1.0
"""While nobody knows how far it is, the time that it took is told anew so often on a terminal."""
BAR_SECONDS = 0.1
"""A bar is drawn at most this often."""


class Progress:
    """Says how far a run is, in steps or in parts of the displacement.

    Use as a context manager; `update`, or a call of the object itself, as often as one likes.

    `total_steps` may be 0 while it is not known and set later. Time left is counted from the first update, so that
    compiling does not spoil it.
    """

    def __init__(
        self,
        total_steps: int = 0,
        label: str = "",
        stream: TextIO | None = None,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self.total_steps = total_steps
        self.label = label
        self._stream = sys.stderr if stream is None else stream
        self._clock = clock
        self._begun = False
        self._first: tuple[int, float] | None = None
        self._said_at = 0.0
        self._said_step = 0
        self._announced = ""
        self._bar: Any = None
        self._task: Any = None

    def __enter__(self) -> "Progress":
        self._begin()
        return self

    def __exit__(self, *exception: object) -> None:
        if self._bar is not None:
            self._bar.refresh()
            self._bar.stop()
            self._bar = None

    def update(self, step: int, note: str = "") -> None:
        """`step` steps are done; `note` is a few words on the state of the run."""
        self._begin()
        now = self._clock()
        if step == 0:
            self._announce(note, now)
            return
        self._first = self._first or (step, now)
        done = bool(self.total_steps) and step >= self.total_steps
        if self._bar is not None:
            if done or now - self._said_at >= BAR_SECONDS:
                self._said_at = now
                self._bar.update(self._task, total=self.total_steps or None, completed=step, note=note, refresh=True)
            return
        due = step - self._said_step >= LINE_FRACTION * self.total_steps > 0 or now - self._said_at >= LINE_SECONDS
        if step > self._said_step and (due or done):
            self._said_at, self._said_step = now, step
            self._say(self.line(step, note, now))

    def _announce(self, note: str, now: float) -> None:
        """What is done before the first part, such as compiling; it does not count in the time left.

        As plain lines, notes that begin alike (`step 40, ...`, `step 80, ...`) are said only now and then.
        """
        if self._bar is not None:
            self._bar.update(self._task, total=self.total_steps or None, note=note, refresh=True)
            return
        first_word = note.partition(" ")[0]
        if note and (first_word != self._announced or now - self._said_at >= LINE_SECONDS):
            self._announced, self._said_at = first_word, now
            self._say("  ".join([self.label, note] if self.label else [note]))

    @contextlib.contextmanager
    def waiting(self, note: str) -> Iterator[None]:
        """While something is done that cannot say how far it is: the note, and how long it has taken so far."""
        over, begun = threading.Event(), self._clock()

        def tick() -> None:
            while not over.wait(TICK_SECONDS):
                self.update(0, f"{note}: {self._clock() - begun:.0f} s")

        ticking = threading.Thread(target=tick, daemon=True)
        ticking.start()
        try:
            yield
        finally:
            over.set()
            ticking.join()

    def __call__(self, step: int, total_steps: int, note: str = "") -> None:
        """What a time loop calls: `step` of `total_steps` are done."""
        self.total_steps = total_steps
        self.update(step, note)

    def line(self, step: int, note: str, now: float) -> str:
        """One plain line: `couplet  40 %  1.2 s left  step 20000, stress 0.12 MPa`."""
        words = [self.label] if self.label else []
        if self.total_steps:
            words.append(f"{100 * step / self.total_steps:.0f} %")
            first, then = self._first or (step, now)
            if first < step < self.total_steps:
                words.append(f"{duration((now - then) * (self.total_steps - step) / (step - first))} left")
        else:
            words.append(f"{step} steps")
        return "  ".join([*words, *([note] if note else [])])

    def _begin(self) -> None:
        if self._begun:
            return
        self._begun = True
        self._said_at = self._clock()
        if self._stream is not None and self._stream.isatty():
            self._bar = _bar(self._stream)
            self._task = self._bar.add_task(self.label, total=self.total_steps or None, note="")
            self._bar.start()

    def _say(self, line: str) -> None:
        """A reader that has gone, or a disk that is full, must not end the run."""
        with contextlib.suppress(OSError):
            print(line, file=self._stream, flush=True)


def duration(seconds: float) -> str:
    """Seconds in words: `0.12 s`, `12 s`, `3 min 05 s`, `2 h 10 min`."""
    if seconds < 59.5:
        return f"{seconds:.2g} s"
    minutes, rest = divmod(round(seconds), 60)
    if minutes < 60:
        return f"{minutes} min {rest:02d} s"
    return f"{minutes // 60} h {minutes % 60:02d} min"


def _bar(stream: TextIO) -> Any:
    from rich.console import Console
    from rich.progress import BarColumn, TaskProgressColumn, TextColumn, TimeRemainingColumn
    from rich.progress import Progress as RichProgress

    return RichProgress(
        TextColumn("{task.description}", markup=False),
        BarColumn(),
        TaskProgressColumn(),
        TimeRemainingColumn(),
        TextColumn("{task.fields[note]}", markup=False),
        console=Console(file=stream),
        auto_refresh=False,
    )


Tell = Callable[[str], None]


class ProgressLines:
    """One line for each that ends: `[ 3/12] couplet   OK     1.2 s   about 10 s left`."""

    def __init__(self, names: Iterable[str], tell: Tell | None) -> None:
        names = list(names)
        self.total, self.tell = len(names), tell
        self.margin = max(map(len, names), default=0)
        self.count = 0
        self.begun = time.perf_counter()

    def ended(self, name: str, status: str, seconds: float) -> None:
        """One more is done."""
        self.count += 1
        if self.tell is None:
            return
        left = self.total - self.count
        passed = time.perf_counter() - self.begun
        rest = f"about {duration(passed / self.count * left)} left" if left else f"{duration(passed)} in all"
        self.tell(
            f"[{self.count:>{len(str(self.total))}}/{self.total}] {name:<{self.margin}}  {status:<9} "
            f"{duration(seconds):>11}   {rest}"
        )

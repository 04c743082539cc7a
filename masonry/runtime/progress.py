"""Progress of a long run: a bar with time left on a terminal, plain lines when the output goes to a file or a pipe."""

import contextlib
import sys
import threading
import time
from collections.abc import Callable, Iterable, Iterator
from math import inf, sqrt
from typing import Any, NamedTuple, TextIO

LINE_FRACTION = 0.1
LINE_SECONDS = 10.0
"""A plain line is due after this share of the steps, or after this time."""
TICK_SECONDS = 1.0
"""While nobody knows how far it is, the time that it took is told anew so often on a terminal."""
BAR_SECONDS = 0.1
"""A bar is drawn at most this often."""
EVIDENCE, EVIDENCE_SECONDS = 0.05, 1.0
"""Share of the whole that must have been done, and the time that must have passed meanwhile, before a word is said of
the time left."""
LATELY = 0.25
"""Share of the time passed whose pace counts beside that of all of it."""
ALIKE, NOTHING = 2.0, 0.1
"""Bounds that lie closer together are said as one number, and a lower one is left out below this share of the upper."""


class Effort(NamedTuple):
    """How much work is done, in any measure in which it goes on about steadily, and how much is left, at least and at
    most; infinite where nobody knows."""

    done: float
    minimum: float
    maximum: float


class TimeLeft:
    """How much longer it takes, between two bounds: by the mean, as factors, of the pace of all that was seen and of
    that of the last part; where these differ, neither is left out."""

    def __init__(self) -> None:
        self.looks: list[tuple[float, float]] = []

    def look(self, effort: Effort, now: float) -> None:
        """So much is done by now (s). A look in a hundredth of the way is enough; where nobody knows how much is left,
        the pace is another one as well."""
        if effort.maximum == inf:
            return
        if not self.looks or effort.done - self.looks[-1][0] >= 0.01 * (effort.done - self.looks[0][0]):
            self.looks.append((effort.done, now))

    def bounds(self, effort: Effort, now: float) -> tuple[float, float] | None:
        """(s) at least and at most; None before there is enough evidence, or where nobody knows."""
        if not self.looks or effort.maximum == inf:
            return None
        first, begun = self.looks[0]
        made, passed, expected = effort.done - first, now - begun, sqrt(effort.minimum * effort.maximum)
        whole = effort.done + (expected or 0.5 * effort.maximum)
        if made < EVIDENCE * whole or made <= 0.0 or passed < EVIDENCE_SECONDS:
            return None
        before = [(done, time) for done, time in self.looks if time <= now - LATELY * passed]
        done, time = before[-1]
        slow, fast = sorted([made / passed, max(effort.done - done, 1e-3 * made) / max(now - time, 1e-9)])
        pace = sqrt(slow * fast)
        return min(effort.minimum / pace, expected / fast), max(effort.maximum / pace, expected / slow)

    def words(self, effort: Effort, now: float) -> str:
        """`12 s left`, `10 s to 1 min 05 s left`, `at most 30 s left`; nothing before there is evidence, or at the
        end."""
        bounds = self.bounds(effort, now)
        if bounds is None or effort.maximum <= 0.0:
            return ""
        minimum, maximum = bounds
        if maximum <= ALIKE * minimum:
            return f"{duration(sqrt(minimum * maximum))} left"
        return (
            f"at most {duration(maximum)} left"
            if minimum < NOTHING * maximum
            else f"{duration(minimum)} to {duration(maximum)} left"
        )


class Progress:
    """Says how far a run is, in steps or in parts of the displacement.

    Use as a context manager; `update`, or a call of the object itself, as often as one likes.

    `total_steps` may be 0 while it is not known and set later. Time left is counted from the first update, so that
    compiling does not spoil it; it follows `effort`, where parts of a run take longer than others.
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
        self.effort: Effort | None = None
        self._left = TimeLeft()
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
        effort = self.effort or Effort(step, self.total_steps - step, self.total_steps - step)
        self._left.look(effort, now)
        remaining = self._left.words(effort, now) if step >= EVIDENCE * self.total_steps > 0 else ""
        done = bool(self.total_steps) and step >= self.total_steps
        if self._bar is not None:
            if done or now - self._said_at >= BAR_SECONDS:
                self._said_at = now
                total = self.total_steps or None
                self._bar.update(self._task, total=total, completed=step, left=remaining, note=note, refresh=True)
            return
        due = step - self._said_step >= LINE_FRACTION * self.total_steps > 0 or now - self._said_at >= LINE_SECONDS
        if step > self._said_step and (due or done):
            self._said_at, self._said_step = now, step
            self._say(self.line(step, remaining, note))

    def _announce(self, note: str, now: float) -> None:
        """Note on the work before the first part, such as compiling; it does not count in the time left.

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
    def waiting(self, note: str, last: float | None = None) -> Iterator[None]:
        """While something is done that cannot say how far it is: the note, and how long it has taken so far; of how
        long (s) it took last time, where that is known."""
        of = "" if last is None else f" of about {duration(last)}"
        over, begun = threading.Event(), self._clock()

        def tick() -> None:
            while not over.wait(TICK_SECONDS):
                self.update(0, f"{note}: {self._clock() - begun:.0f} s{of}")

        ticking = threading.Thread(target=tick, daemon=True)
        ticking.start()
        try:
            yield
        finally:
            over.set()
            ticking.join()

    def __call__(self, step: int, total_steps: int, note: str = "") -> None:
        """Call from a time loop: `step` of `total_steps` are done."""
        self.total_steps = total_steps
        self.update(step, note)

    def line(self, step: int, remaining: str, note: str) -> str:
        """One plain line: `couplet  40 %  12 s left  step 20000, stress 0.12 MPa`."""
        progress = f"{100 * step / self.total_steps:.0f} %" if self.total_steps else f"{step} steps"
        return "  ".join(filter(None, [self.label, progress, remaining, note]))

    def _begin(self) -> None:
        if self._begun:
            return
        self._begun = True
        self._said_at = self._clock()
        if self._stream is not None and self._stream.isatty():
            self._bar = _bar(self._stream)
            self._task = self._bar.add_task(self.label, total=self.total_steps or None, left="", note="")
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
    from rich.progress import BarColumn, TaskProgressColumn, TextColumn
    from rich.progress import Progress as RichProgress

    return RichProgress(
        TextColumn("{task.description}", markup=False),
        BarColumn(),
        TaskProgressColumn(),
        TextColumn("{task.fields[left]}"),
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
        remaining = self.total - self.count
        passed = time.perf_counter() - self.begun
        rest = f"about {duration(passed / self.count * remaining)} left" if remaining else f"{duration(passed)} in all"
        self.tell(
            f"[{self.count:>{len(str(self.total))}}/{self.total}] {name:<{self.margin}}  {status:<9} "
            f"{duration(seconds):>11}   {rest}"
        )

"""The time loop: chunks of compiled steps; between chunks the history, the watch for instability, progress, Ctrl-C."""

import contextlib
import signal
import threading
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

import numba
import numpy as np

from masonry import energy
from masonry.errors import Stopped
from masonry.gauges import Gauge
from masonry.history import UNITS, Frame, History
from masonry.kernels.compiler import kind_of, once
from masonry.kernels.step import advance, reaction
from masonry.loads import Controlled, Program
from masonry.model import Model
from masonry.overlap import Overlap
from masonry.pace import Chunk
from masonry.paces import Pace, pace_of
from masonry.watch import Watch, frame_of

FRAMES = 24
"""Frames that are kept of a run, about."""


@dataclass
class Outcome:
    """What the loop found besides the rows: the peak seen at any step, and the lowest force; the largest rotation, the
    times, the force that was still unbalanced when the dead loads had settled, over the dead loads, how far a contact
    closed, over the extent of its thinner block, and the widest opening at each row (m).
    """

    history: History
    peak_force: float = 0.0
    displacement_at_peak: float = 0.0
    lowest_force: float = 0.0
    displacement_at_lowest: float = 0.0
    seconds_run: float = 0.0
    seconds_compile: float = 0.0
    rotation_max: float = 0.0
    unbalanced: float = 0.0
    overlap_max: float = 0.0
    widest: list[float] = field(default_factory=list)
    steps: int = 0
    interrupted: bool = False
    stopped: str = ""
    control: dict[str, float] = field(default_factory=dict)
    log: list[str] = field(default_factory=list)


@dataclass(frozen=True)
class Recording:
    """How forces become stresses (section, m2; sign of the drive), how often to look, and which gauges to read then."""

    section: float
    sign: float = 1.0
    rows: int = 1000
    rotation_limit: float = 0.02
    gauges: tuple[Gauge, ...] = ()


def run(
    model: Model,
    plan: Program | Controlled,
    recording: Recording,
    threads: int = 1,
    progress: Callable[[int, int, str], None] | None = None,
) -> Outcome:
    """Run the whole plan. An unstable or too large motion ends it: Outcome.stopped says why, rows stay trusted."""
    outcome = Outcome(History({key: np.zeros(0) for key in UNITS}))
    if threads > 1:
        numba.set_num_threads(min(threads, numba.config.NUMBA_NUM_THREADS))
    begun = time.perf_counter()
    pace = pace_of(model, plan, recording.rows)
    if progress is not None:
        progress(0, pace.progress()[1], "compiling the step for this scene, or loading it")
    compile_for(model, threads)
    outcome.seconds_compile = time.perf_counter() - begun
    begun = time.perf_counter()
    loop = _Loop(model, pace, plan.settle, recording, threads, outcome)
    try:
        loop.run(progress)
    except KeyboardInterrupt:
        outcome.interrupted = True
    except Stopped as stop:
        outcome.stopped = str(stop)
    outcome.seconds_run = time.perf_counter() - begun
    loop.finish()
    return outcome


def compile_for(model: Model, threads: int) -> None:
    """Compile (or load from the cache) the step for exactly this model, without taking one."""
    parallel = True if threads > 1 else None
    kind = parallel, model.damping, model.groups, model.contacts, model.bodies, model.drives
    with once(kind_of(kind)), interrupt_afterwards():
        advance_model(model, Chunk(np.zeros(1), np.zeros(1), False), threads, 0, 0, np.zeros(0))
        energy.observe(model)


@contextlib.contextmanager
def interrupt_afterwards() -> Iterator[None]:
    """Ctrl-C waits for the compiler, which cannot be interrupted cleanly, and counts when it is done."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    pressed: list[int] = []
    usual = signal.signal(signal.SIGINT, lambda number, frame: pressed.append(number))
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, usual)
    if pressed:
        raise KeyboardInterrupt


def advance_model(model: Model, chunk: Chunk, threads: int, first: int, steps: int, gauge: np.ndarray) -> None:
    """Take some compiled steps of a chunk; gauge (steps,) N out: force of the drive after each."""
    advance(
        True if threads > 1 else None,
        first,
        steps,
        model.dt,
        model.damping,
        chunk.dead_load,
        chunk.speed,
        model.groups,
        model.contacts,
        model.bodies,
        model.drives,
        gauge,
    )


class _Loop:
    """State of one run between chunks."""

    def __init__(
        self, model: Model, pace: Pace, settle: int, recording: Recording, threads: int, outcome: Outcome
    ) -> None:
        self.model, self.pace, self.settle, self.recording = model, pace, settle, recording
        self.threads, self.outcome = threads, outcome
        self.place = 0.0
        self.rows: list[list[float]] = []
        self.watch = Watch(model, recording.rotation_limit)
        self.overlap = Overlap(model)
        self.frames: list[Frame] = []
        self.peak_frame: Frame | None = None
        self.highest_row = -np.inf
        self.take_row(0, energy.velocities(model))

    def run(self, progress: Callable[[int, int, str], None] | None) -> None:
        done = frames = 0
        while (chunk := self.pace.next()) is not None:
            before = self.take_steps(done, chunk)
            done += chunk.steps
            if not chunk.row:
                continue
            now, whole = self.pace.progress()
            frame_due = now * FRAMES >= (frames + 1) * whole or now == whole
            frames = now * FRAMES // whole
            self.take_row(done, before, frame_due)
            self.outcome.steps = done
            if progress is not None:
                progress(now, whole, f"step {done}, stress {self.rows[-1][3] / 1e6:.3f} MPa")

    def take_steps(self, done: int, chunk: Chunk) -> list[np.ndarray]:
        """The steps of a chunk, and a look whether they can be trusted; returns the velocities before the last."""
        count, gauge = chunk.steps, np.zeros(chunk.steps)
        if count > 1:
            advance_model(self.model, chunk, self.threads, 0, count - 1, gauge)
        before = energy.velocities(self.model)
        advance_model(self.model, chunk, self.threads, count - 1, 1, gauge[count - 1 :])
        self.watch.check(done + count)
        path = self.place + np.cumsum(chunk.speed[:-1]) * self.model.dt
        self.place = float(path[-1]) if chunk.place is None else chunk.place
        self.find_peak(path, gauge)
        return before

    def find_peak(self, path: np.ndarray, gauge: np.ndarray) -> None:
        """The peak, and the lowest force, are looked for at every step, not only at rows."""
        force = gauge * self.recording.sign
        k, low = int(np.argmax(force)), int(np.argmin(force))
        if force[k] > self.outcome.peak_force:
            self.outcome.peak_force = float(force[k])
            self.outcome.displacement_at_peak = self.along(float(path[k]))
        if force[low] < self.outcome.lowest_force:
            self.outcome.lowest_force = float(force[low])
            self.outcome.displacement_at_lowest = self.along(float(path[low]))

    def along(self, place: float) -> float:
        """A place of the drive (m) along its direction, for one along an axis."""
        return self.recording.sign * place + 0.0

    def take_row(self, step: int, before: list[np.ndarray], frame_due: bool = True) -> None:
        model, area = self.model, self.recording.section
        view = energy.observe(model)
        stress, support = (
            sum(reaction(b, f) for b, f in zip(model.bodies, freedoms, strict=True)) / area * self.recording.sign
            for freedoms in (model.drives, model.supports)
        )
        terms = energy.ledger(model, view, before)
        self.watch.check_energies(step, terms)
        if step <= self.settle:
            self.outcome.unbalanced = energy.unbalanced(model, before)
        place = self.along(self.place)
        force = area * self.recording.sign
        gauges = [gauge.read(model) for gauge in self.recording.gauges]
        motion = [step, step * model.dt, place, stress, -support, area * stress]
        self.rows.append([*motion, *(terms[k] for k in list(UNITS)[len(motion) :]), *gauges])
        self.pace.look(stress * force, -support * force, view.seen, terms)
        self.outcome.rotation_max = self.watch.rotation
        self.overlap.look(view.seen[:, 0])
        self.outcome.widest.append(float(view.seen[:, 0].max(initial=0.0)))
        self.outcome.overlap_max = self.overlap.largest
        higher = stress > self.highest_row and step > 0
        if frame_due or higher:
            frame = frame_of(model, view, step, place, self.watch.nearest)
            if frame_due:
                self.frames.append(frame)
            if higher:
                self.peak_frame, self.highest_row = frame, stress

    def finish(self) -> None:
        """Columns from rows; the frame at the peak among the others, oldest first."""
        columns = [*UNITS, *(gauge.name for gauge in self.recording.gauges)]
        table = np.array(self.rows).reshape(-1, len(columns))
        self.outcome.history.rows = {key: table[:, i].copy() for i, key in enumerate(columns)}
        frames = {frame.step: frame for frame in self.frames}
        if self.peak_frame is not None:
            frames[self.peak_frame.step] = self.peak_frame
        self.outcome.control = self.pace.report()
        self.outcome.history.frames = [frames[step] for step in sorted(frames)]

"""The time loop: chunks of compiled steps; between chunks the history, and the watch for instability."""

from collections.abc import Callable
from dataclasses import asdict
from typing import Any

import numpy as np

from masonry.configuration import energy
from masonry.configuration.chunk import Chunk
from masonry.configuration.configuration import configuration_of
from masonry.configuration.parts.parts import parts_of
from masonry.configuration.setting_off import damp, set_off
from masonry.elements.element import readings_of
from masonry.errors import MovedTooFar, TurnedTooFar
from masonry.loading.loading import Loading
from masonry.model.model import Model
from masonry.monitors.frames import Frames
from masonry.monitors.observer import Observer, ObserverRecords, View
from masonry.monitors.recording import Recording
from masonry.monitors.stability import Watch
from masonry.rows.columns import FACTOR, INPUT_ENERGY, UNITS
from masonry.rows.history import Frame, Standing
from masonry.rows.peak import borne
from masonry.runtime.processors import Seconds
from masonry.runtime.progress import Progress
from masonry.runtime.state_file import State, attributes, load_attributes
from masonry.timeloop.checkpointer import Checkpointer
from masonry.timeloop.gauge_columns import finish_columns
from masonry.timeloop.observers import observers_of
from masonry.timeloop.peak_watch import PeakWatch, by_field
from masonry.timeloop.run_outcome import Outcome

OF_OUTCOME = ("steps", "log")
"""Of an outcome before the run is over, besides the history and the peak."""
REMEMBERED = ("place", "done", "frames_done", "dead_load_factor")
Columns = dict[str, list[float]]


class Loop:
    """State of one run between chunks."""

    def __init__(
        self,
        model: Model,
        loading: Loading,
        settle: int,
        recording: Recording,
        threads: int,
        outcome: Outcome,
    ) -> None:
        self.model, self.loading, self.settle, self.recording = model, loading, settle, recording
        self.threads, self.outcome = threads, outcome
        self.place = self.dead_load_factor = 0.0
        self.done = self.frames_done = 0
        self.configuration = configuration_of(model)
        gauges = (gauge.name for gauge in recording.gauges)
        columns = *UNITS, *energy.columns_of_joints(model), *loading.columns(), *gauges
        self.rows: Columns = {key: [] for key in columns}
        self.observed: Columns = {}
        self.watch = Watch(model, recording.rotation_limit)
        self.observers: dict[str, Observer] = {"watch": self.watch, **observers_of(model, recording)}
        self.driven, self.supported = holding(model, model.drives), holding(model, model.supports)
        self.loads_along = recording.surroundings.along(model, recording.axis)
        self.camera = Frames(model)
        self.frames: list[Frame] = []
        self.peak = PeakWatch(outcome, recording)
        self.earlier, self.begun = Seconds(), Seconds.now()

    @property
    def seconds(self) -> Seconds:
        """Time of the run so far, that of processes before this one included."""
        return self.earlier + Seconds.now() - self.begun

    def run(self, progress: Callable[[int, int, str], None] | None, checkpointer: Checkpointer | None) -> None:
        if not self.observed:
            self.take_row(0, energy.velocities(self.model))
        damp(self.model, self.done >= self.settle)
        while (chunk := self.loading.next()) is not None:
            before, path, force = self.take_steps(self.done, chunk)
            begins, self.done = self.done < self.settle, self.done + chunk.steps
            self.loading.feel(self.done, before)
            if len(path) and self.driven:
                self.peak.see(path, self.loading.counted(before, path, force), begins, self.has_fallen)
            if chunk.row:
                self.close_row(before, progress)
            if self.done == self.settle:
                set_off(self.model, before)
            if checkpointer is not None and checkpointer.look(self):
                self.outcome.interrupted = True
                return

    def close_row(self, before: list[np.ndarray], progress: Callable[[int, int, str], None] | None) -> None:
        """A row, a frame where one is due, and a word on how far the run is."""
        now, whole = self.loading.progress()
        frame_due = now * self.recording.frames >= (self.frames_done + 1) * whole or now == whole
        self.frames_done = now * self.recording.frames // whole
        self.take_row(self.done, before, frame_due)
        self.configuration.after_row()
        self.outcome.steps = self.done
        if isinstance(progress, Progress):
            progress.effort = self.loading.effort()
        if progress is not None:
            progress(now, whole, f"step {self.done}, {self.state_of_the_run()}")

    def state_of_the_run(self) -> str:
        """In a few words: how far the loads have settled; then the stress at the drive, or the factor of a load; where
        nothing is driven, the energy of motion."""
        if self.done <= self.settle:
            return f"{self.observed['unbalanced'][-1]:.2g} of the dead loads unbalanced"
        if FACTOR in self.rows:
            return f"load factor {self.rows[FACTOR][-1]:.4g}"
        if not self.place and not self.rows["stress"][-1]:
            return f"kinetic energy {self.rows['kinetic'][-1]:.3g} J"
        return f"stress {self.rows['stress'][-1] / 1e6:.3g} MPa"

    def take_steps(self, done: int, chunk: Chunk) -> tuple[list[np.ndarray], np.ndarray, np.ndarray]:
        """The steps of a chunk, and a look whether they can be trusted; returns the velocities before the last, and of
        the steps from the last one of the settling on the places (n,) m of the drive and its forces (n,) N."""
        count, drive_force = chunk.steps, np.zeros(chunk.steps)
        if count > 1:
            self.configuration.advance(chunk, self.threads, 0, count - 1, drive_force)
        before = energy.velocities(self.model)
        self.configuration.advance(chunk, self.threads, count - 1, 1, drive_force[count - 1 :])
        self.dead_load_factor = min(float(chunk.dead_load[-1]), 1.0)
        try:
            self.watch.check(done + count)
        except TurnedTooFar:
            if not self.loading.turned_too_far():
                raise
        path = self.place + np.cumsum(chunk.speed[:-1]) * self.model.dt
        self.place = float(path[-1]) if chunk.place is None else chunk.place
        begun = max(self.settle - done - 1, 0)
        return before, path[begun:], drive_force[begun:]

    def load_factors(self) -> list[float]:
        """The factor of each dead load now."""
        varying = self.loading.load_factors()
        loads = self.recording.surroundings.loads
        return [self.dead_load_factor * (1.0 if load.varies is None else float(varying[load.varies])) for load in loads]

    @property
    def has_fallen(self) -> bool:
        """Whether a block has fallen, as far as rows have shown."""
        return any(observer.has_fallen for observer in self.observers.values())

    def take_row(self, step: int, before: list[np.ndarray], frame_due: bool = True) -> None:
        """Row of the state of the specimen now; and a frame where one is due, or the force is the highest so far."""
        model, load_factors, now = self.model, self.load_factors(), energy.observe(self.model)
        terms = energy.ledger(model, now, before)
        settling, rotation = step <= self.settle, self.watch.rotation
        view = View(now.seen, terms, before, load_factors, settling, rotation, now.least, now.longest)
        observed: dict[str, float] = {}
        stood = not self.has_fallen
        try:
            for observer in self.observers.values():
                observed |= observer.look(model, view, step)
        except MovedTooFar:
            if not self.loading.moved_too_far():
                raise
            observed, frame_due = {key: values[-1] for key, values in self.observed.items()} | observed, True
        row = {
            **self.drive(step, load_factors),
            **terms,
            **self.loading.columns(),
            **self.readings(before),
        }
        append(self.rows, row)
        append(self.observed, observed)
        force = self.recording.section * self.recording.sign
        self.loading.look(row["stress"] * force, row["support_stress"] * force, now.seen, terms)
        stress = float(borne(row, "stress"))
        higher = stood and stress > self.peak.highest_row and step >= max(self.settle, 1)
        shows = higher and self.peak.shows_more(stress)
        if frame_due or shows:
            place, forces = row["displacement"], self.configuration.joint_forces()
            standing = self.recording.surroundings.standing(model, before, forces, step, place, load_factors)
            frame = self.camera.take(now, forces, step, place)
            if frame_due:
                self.frames.append(frame)
                self.outcome.standing["end"] = standing
            if shows:
                self.peak.near.append((stress, frame, standing))
        if higher:
            self.peak.keep(stress)

    def readings(self, before: list[np.ndarray]) -> dict[str, float]:
        """By gauge what it reads, and by column what elements do. Velocities now are the mean of those half a step
        before and after."""
        model, gauges = self.model, self.recording.gauges
        velocities = {}
        if any(gauge.quantity == "velocity" for gauge in gauges):
            parts = zip(parts_of(model), before, strict=True)
            velocities = {part.name: 0.5 * (part.velocities(old) + part.body.v) for part, old in parts}
        return {gauge.name: gauge.look(model, velocities) for gauge in gauges} | readings_of(model.elements)

    def drive(self, step: int, load_factors: list[float]) -> dict[str, float]:
        """Where the drive is, and what it and its support exert, in the columns of a row; dead loads along the drive,
        and elements that hold blocks from outside, count with the support. Forces that hold are added up one after the
        other, as the step does."""
        model, area, sign = self.model, self.recording.section, self.recording.sign
        stress, support = (
            sum(float(np.cumsum(body.hold[dofs])[-1]) for body, dofs in bodies) / area * sign
            for bodies in (self.driven, self.supported)
        )
        ends_in_space = self.recording.surroundings.elements_along(model, self.recording.axis)
        support += (float(self.loads_along @ load_factors) + ends_in_space) / area * sign
        return {
            "step": step,
            "time": step * model.dt,
            "displacement": self.recording.along(self.place),
            "stress": stress,
            "support_stress": -support,
            "force": area * stress,
        }

    def finish(self) -> None:
        """Columns from rows; the frame at the peak among the others, oldest first."""
        history = self.outcome.history
        history.rows = {key: np.array(values, dtype=float) for key, values in self.rows.items()}
        recording, settled = self.recording, self.settle * self.model.dt
        history.units = finish_columns(history.rows, recording.gauges, recording.ground, settled)
        history.units |= dict.fromkeys(readings_of(self.model.elements), "N")
        self.outcome.observed = {key: np.array(values) for key, values in self.observed.items()}
        if (energy_in := self.outcome.observed.pop(INPUT_ENERGY, None)) is not None:
            history.rows[INPUT_ENERGY] = energy_in
        each = (record for observer in self.observers.values() for record in observer.records())
        self.outcome.records = ObserverRecords(each)
        self.peak.finish()
        self.outcome.take_extremes_of_rows()
        frames = {frame.step: frame for frame in [*self.frames, *self.peak.frames()]}
        self.outcome.standing = {k: v for k in ("peak", "end") if (v := self.outcome.standing.get(k)) is not None}
        peak = self.recording.sign * self.outcome.peak_force
        self.outcome.loading, self.outcome.events = self.loading.outcome(peak), self.loading.events
        self.outcome.history.frames = [frames[step] for step in sorted(frames)]

    def state(self) -> State:
        """All that the run remembers between two chunks, but for the model."""
        return {
            **attributes(self, REMEMBERED),
            "seconds": asdict(self.seconds),
            "rows": {key: np.array(values, dtype=float) for key, values in self.rows.items()},
            "observed": {key: np.array(values) for key, values in self.observed.items()},
            "frames": [by_field(frame) for frame in self.frames],
            "peak": self.peak.state(),
            "outcome": attributes(self.outcome, OF_OUTCOME),
            "standing": {when: by_field(standing) for when, standing in self.outcome.standing.items()},
            "loading": self.loading.state(),
            "observers": {name: observer.state() for name, observer in self.observers.items()},
        }

    def restore(self, state: State) -> None:
        """Go on from there."""
        load_attributes(self, REMEMBERED, state)
        load_attributes(self.outcome, OF_OUTCOME, state["outcome"])
        self.outcome.standing = {when: Standing(**kept) for when, kept in state["standing"].items()}
        self.earlier = Seconds(**state["seconds"])
        self.rows, self.observed = (
            {key: values.tolist() for key, values in state[name].items()} for name in ("rows", "observed")
        )
        self.frames = [Frame(**frame) for frame in state["frames"]]
        self.peak.restore(state["peak"])
        self.loading.restore(state["loading"])
        for name, observer in self.observers.items():
            observer.restore(state["observers"][name])


def holding(model: Model, dofs: tuple[np.ndarray | None, ...]) -> list[tuple[Any, tuple[np.ndarray, ...]]]:
    """Bodies and their held dofs, rows (n,) and numbers (n,); from those of each kind (n, 2) or None."""
    each = zip(model.bodies, dofs, strict=True)
    return [(body, tuple(rows.astype(np.intp).T)) for body, rows in each if rows is not None and len(rows)]


def append(columns: Columns, row: dict[str, float]) -> None:
    """A row below columns that have the same names, or none yet."""
    for key, value in row.items():
        columns.setdefault(key, []).append(value)

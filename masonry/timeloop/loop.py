"""The time loop: chunks of compiled steps; between chunks the history, and the watch for instability."""

import time
from collections.abc import Callable
from dataclasses import fields

import numpy as np

from masonry.history import UNITS, Frame, still_moving
from masonry.kernels.step import reaction
from masonry.loading.cycles import reached
from masonry.loading.dispatch import Pace
from masonry.loading.scheduled import Chunk
from masonry.loading.varying_loads import VaryingLoading
from masonry.model.model import Model
from masonry.model.motion import set_off
from masonry.monitors import energy
from masonry.monitors.collision import Collision
from masonry.monitors.mode_2_area import LawArea
from masonry.monitors.overlap import Overlap
from masonry.monitors.slide import Slide
from masonry.monitors.stability import Watch, frame_of
from masonry.runtime.state import State, attributes, put_back
from masonry.timeloop.checkpointer import Checkpointer
from masonry.timeloop.compiled_step import advance_model
from masonry.timeloop.reactions import Standing, WorkOfLoads
from masonry.timeloop.recording import Outcome, Recording

FOUND = (
    *("peak_force", "displacement_at_peak", "lowest_force", "displacement_at_lowest", "widest"),
    *("rotation_max", "unbalanced", "still_moving", "overlap_max", "slip_max", "met", "steps", "log"),
)
"""What an outcome has besides the history before the run is over."""
REMEMBERED = ("place", "done", "frames_done", "highest_row", "share", "heights")
ALIKE = 1e-4
"""Share by which one row must be higher than another for both to be kept as the peak, that is, ten at most."""
LOADS_DID = ("done", "settled", "moved", "shares")


class Loop:
    """State of one run between chunks."""

    def __init__(
        self, model: Model, pace: Pace, settle: int, recording: Recording, threads: int, outcome: Outcome
    ) -> None:
        self.model, self.pace, self.settle, self.recording = model, pace, settle, recording
        self.threads, self.outcome = threads, outcome
        self.place = self.share = 0.0
        self.done = self.frames_done = 0
        self.rows: list[list[float]] = []
        self.watch = Watch(model, recording.rotation_limit)
        self.overlap = Overlap(model)
        self.law_area = LawArea(model)
        self.slide = Slide(model, recording.slip_limit)
        self.collision = Collision(model, recording.sets)
        self.work_of_loads = WorkOfLoads(recording.surroundings)
        self.loads_along = recording.surroundings.along(model.layout, recording.axis)
        self.frames: list[Frame] = []
        self.peak_frame: Frame | None = None
        self.near_peak: list[tuple[float, Frame, Standing]] = []
        self.heights = np.zeros((0, 2))
        self.highest_row = -np.inf
        self.earlier, self.begun = 0.0, time.perf_counter()

    @property
    def seconds(self) -> float:
        """Wall time of the run so far, that of processes before this one included."""
        return self.earlier + time.perf_counter() - self.begun

    def run(self, progress: Callable[[int, int, str], None] | None, keeper: Checkpointer | None) -> None:
        if not self.rows:
            self.take_row(0, energy.velocities(self.model))
        while (chunk := self.pace.next()) is not None:
            before = self.take_steps(self.done, chunk)
            self.done += chunk.steps
            self.pace.feel(self.done, before)
            if chunk.row:
                self.close_row(before, progress)
            if self.done == self.settle:
                set_off(self.model, before)
            if keeper is not None and keeper.look(self):
                self.outcome.interrupted = True
                return

    def close_row(self, before: list[np.ndarray], progress: Callable[[int, int, str], None] | None) -> None:
        """A row, a frame where one is due, and a word on how far the run is."""
        now, whole = self.pace.progress()
        frame_due = now * self.recording.frames >= (self.frames_done + 1) * whole or now == whole
        self.frames_done = now * self.recording.frames // whole
        self.take_row(self.done, before, frame_due)
        self.outcome.steps = self.done
        if progress is not None:
            progress(now, whole, f"step {self.done}, {self.state_of_the_run()}")

    def state_of_the_run(self) -> str:
        """In a few words: the stress at the drive; without one, or before it moves, how far the loads have settled."""
        if self.done <= self.settle:
            return f"{self.outcome.unbalanced:.2g} of the dead loads unbalanced"
        return f"stress {self.rows[-1][3] / 1e6:.3f} MPa"

    def take_steps(self, done: int, chunk: Chunk) -> list[np.ndarray]:
        """The steps of a chunk, and a look whether they can be trusted; returns the velocities before the last."""
        count, gauge = chunk.steps, np.zeros(chunk.steps)
        if count > 1:
            advance_model(self.model, chunk, self.threads, 0, count - 1, gauge)
        before = energy.velocities(self.model)
        advance_model(self.model, chunk, self.threads, count - 1, 1, gauge[count - 1 :])
        self.share = min(float(chunk.dead_load[-1]), 1.0)
        self.watch.check(done + count)
        path = self.place + np.cumsum(chunk.speed[:-1]) * self.model.dt
        self.place = float(path[-1]) if chunk.place is None else chunk.place
        begun = max(self.settle - done - 1, 0)
        if begun < count:
            self.find_peak(path[begun:], gauge[begun:], done < self.settle)
        return before

    def find_peak(self, path: np.ndarray, gauge: np.ndarray, begins: bool) -> None:
        """The peak, and the lowest force, are looked for at every step from the last one of the settling on, where it
        `begins`, not only at rows."""
        force = gauge * self.recording.sign
        if begins:
            self.outcome.peak_force = float(force[0])
            self.heights = np.array([[force[0], path[0]]])
        k, low = int(np.argmax(force)), int(np.argmin(force))
        if force[k] > self.outcome.peak_force:
            self.rise(force[: k + 1], path[: k + 1])
        if force[low] < self.outcome.lowest_force:
            self.outcome.lowest_force = float(force[low])
            self.outcome.displacement_at_lowest = self.along(float(path[low]))

    def rise(self, force: np.ndarray, path: np.ndarray) -> None:
        """A higher peak, the last of these forces: it counts as reached where the first was near to it."""
        top = np.maximum.accumulate(np.concatenate([[self.outcome.peak_force], force]))
        new = np.flatnonzero(np.diff(top) > 0.0)
        seen = np.concatenate([self.heights, np.column_stack([force[new], path[new]])])
        self.outcome.peak_force = float(force[-1])
        self.heights = seen[seen[:, 0] >= reached(self.outcome.peak_force)]
        self.outcome.displacement_at_peak = self.along(float(self.heights[0, 1]))

    def keep_peak(self, stress: float, frame: Frame, standing: Standing) -> None:
        """Keep the frame of a row that is higher than all before, as long as it may be the first near to the peak;
        of frames that differ by next to nothing the first."""
        if not self.near_peak or stress > self.near_peak[-1][0] * (1.0 + ALIKE):
            self.near_peak.append((stress, frame, standing))
        self.near_peak = [kept for kept in self.near_peak if kept[0] >= reached(stress)] or [(stress, frame, standing)]
        self.highest_row, self.peak_frame, self.outcome.standing["peak"] = stress, *self.near_peak[0][1:]

    def along(self, place: float) -> float:
        """A place of the drive (m) along its direction, for one along an axis."""
        return self.recording.sign * place + 0.0

    def shares(self) -> list[float]:
        """The share of each dead load now."""
        varying = self.pace.shares[:, self.done] if isinstance(self.pace, VaryingLoading) else ()
        loads = self.recording.surroundings.loads
        return [self.share * (1.0 if load.varies is None else float(varying[load.varies])) for load in loads]

    def take_row(self, step: int, before: list[np.ndarray], frame_due: bool = True) -> None:
        model, area, shares = self.model, self.recording.section, self.shares()
        view = energy.observe(model)
        stress, support = (
            sum(reaction(b, f) for b, f in zip(model.bodies, freedoms, strict=True)) / area * self.recording.sign
            for freedoms in (model.drives, model.supports)
        )
        support += float(self.loads_along @ shares) / area * self.recording.sign
        terms = energy.ledger(model, view, before)
        self.watch.check_energies(step, terms)
        self.slide.look(step, view.seen)
        self.collision.look(step, view.seen.opening, self.watch.rotation)
        self.outcome.met = self.collision.words
        self.outcome.slip_max = self.slide.largest
        if step <= self.settle:
            self.outcome.unbalanced = energy.unbalanced(model, before)
            self.outcome.still_moving = still_moving(terms)
        place = self.along(self.place)
        force = area * self.recording.sign
        gauges = [gauge.read(model) for gauge in self.recording.gauges]
        motion = [step, step * model.dt, place, stress, -support, area * stress]
        self.rows.append([*motion, *(terms[k] for k in list(UNITS)[len(motion) :]), *gauges])
        self.pace.look(stress * force, -support * force, view.seen, terms)
        self.outcome.rotation_max = self.watch.rotation
        self.overlap.look(view.seen.opening)
        self.law_area.look(view.seen.sigma)
        self.outcome.widest.append(float(view.seen.opening.max(initial=0.0)))
        self.outcome.overlap_max = self.overlap.largest
        self.work_of_loads.look(model, shares, step <= self.settle)
        higher = stress > self.highest_row and step >= max(self.settle, 1)
        if frame_due or higher:
            standing = self.recording.surroundings.standing(model, before, step, place, shares)
            frame = frame_of(model, view, step, place, self.watch.nearest)
            if frame_due:
                self.frames.append(frame)
                self.outcome.standing["end"] = standing
            if higher:
                self.keep_peak(stress, frame, standing)

    def finish(self) -> None:
        """Columns from rows; the frame at the peak among the others, oldest first."""
        columns = [*UNITS, *(gauge.name for gauge in self.recording.gauges)]
        table = np.array(self.rows).reshape(-1, len(columns))
        self.outcome.history.rows = {key: table[:, i].copy() for i, key in enumerate(columns)}
        frames = {frame.step: frame for frame in self.frames}
        if self.peak_frame is not None:
            frames[self.peak_frame.step] = self.peak_frame
        self.outcome.work_of_loads = self.work_of_loads.done, self.work_of_loads.settled
        self.outcome.standing = {k: v for k in ("peak", "end") if (v := self.outcome.standing.get(k)) is not None}
        self.outcome.control = self.pace.report()
        self.outcome.events = [] if self.pace.events is None else self.pace.events.found
        self.outcome.mode_2_over_law = self.law_area.most_taken()
        self.outcome.history.frames = [frames[step] for step in sorted(frames)]

    def state(self) -> State:
        """All that the run remembers between two chunks, but for the model."""
        peak = self.peak_frame
        return {
            **attributes(self, REMEMBERED),
            "seconds": self.seconds,
            "rows": np.array(self.rows),
            "frames": [_kept(frame) for frame in self.frames],
            "peak_frame": None if peak is None else _kept(peak),
            "near_peak": [[stress, _kept(frame), _kept(standing)] for stress, frame, standing in self.near_peak],
            "found": attributes(self.outcome, FOUND),
            "standing": {when: _kept(standing) for when, standing in self.outcome.standing.items()},
            "work_of_loads": attributes(self.work_of_loads, LOADS_DID),
            "pace": self.pace.state(),
            "watch": self.watch.state(),
            "overlap": self.overlap.state(),
            "law_area": self.law_area.state(),
            "slide": self.slide.state(),
            "collision": self.collision.state(),
        }

    def restore(self, state: State) -> None:
        """Go on from there."""
        peak = state["peak_frame"]
        put_back(self, REMEMBERED, state)
        put_back(self.outcome, FOUND, state["found"])
        put_back(self.work_of_loads, LOADS_DID, state["work_of_loads"])
        self.outcome.standing = {when: Standing(**kept) for when, kept in state["standing"].items()}
        self.earlier = state["seconds"]
        self.rows = state["rows"].tolist()
        self.frames = [Frame(**frame) for frame in state["frames"]]
        self.peak_frame = None if peak is None else Frame(**peak)
        self.near_peak = [(height, Frame(**frame), Standing(**acts)) for height, frame, acts in state["near_peak"]]
        self.pace.restore(state["pace"])
        self.watch.restore(state["watch"])
        self.overlap.restore(state["overlap"])
        self.law_area.restore(state["law_area"])
        self.slide.restore(state["slide"])
        self.collision.restore(state["collision"])


def _kept(kept: Frame | Standing) -> State:
    return {entry.name: getattr(kept, entry.name) for entry in fields(kept)}

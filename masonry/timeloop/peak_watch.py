"""Watch for the peak of a drive: at every step its highest force and its lowest, at rows the frames near to it."""

from dataclasses import fields

import numpy as np

from masonry.monitors.recording import Recording
from masonry.rows.history import Frame, Standing
from masonry.rows.peak import reached
from masonry.runtime.state_file import State, attributes, load_attributes
from masonry.timeloop.around_peak import AroundPeak
from masonry.timeloop.run_outcome import Outcome

EXTREMES = ("peak_force", "displacement_at_peak", "blow", "lowest_force", "displacement_at_lowest")
"""Of an outcome, those that a checkpoint keeps."""
ALIKE = 1e-4
"""Share by which one row must be higher than another for both to be kept as the peak, that is, ten at most."""


class PeakWatch:
    """Writes the extremes of the force of a drive into an outcome.

    heights      (n, 2) force (N) and place (m) of the steps that are the first near to the peak so far
    around       the steps around it
    highest_row  Pa, of the rows so far
    near         stress (Pa), frame and standing of the rows that may be the first near to the highest one
    """

    REMEMBERED = ("heights", "highest_row")

    def __init__(self, outcome: Outcome, recording: Recording) -> None:
        self.outcome, self.recording = outcome, recording
        self.heights = np.zeros((0, 2))
        self.around = AroundPeak()
        self.highest_row = -np.inf
        self.near: list[tuple[float, Frame, Standing]] = []

    def see(self, path: np.ndarray, drive_force: np.ndarray, begins: bool, fallen: bool) -> None:
        """The peak, and the lowest force, are looked for at every step from the last one of the settling on, where it
        `begins`, not only at rows; places (n,) m of the drive, its forces (n,) N. A blow is none; and once a block has
        `fallen` there is none any more: it hits the drive."""
        force = drive_force * self.recording.sign
        if begins:
            self.outcome.peak_force = float(force[0])
            self.heights = np.array([[force[0], path[0]]])
        k, low = int(np.argmax(force)), int(np.argmin(force))
        struck = fallen or self.around.strikes(path, force, k, self.outcome.peak_force)
        higher = not struck and bool(force[k] > self.outcome.peak_force)
        self.around.see(path, force, k if higher else None)
        if struck:
            self.outcome.blow = max(self.outcome.blow, float(force[k]))
        elif higher:
            self._rise(force[: k + 1], path[: k + 1])
        if force[low] < self.outcome.lowest_force:
            self.outcome.lowest_force = float(force[low])
            self.outcome.displacement_at_lowest = self.recording.along(float(path[low]))

    def _rise(self, force: np.ndarray, path: np.ndarray) -> None:
        """A higher peak, the last of these forces: it counts as reached where the first was near to it."""
        top = np.maximum.accumulate(np.concatenate([[self.outcome.peak_force], force]))
        new = np.flatnonzero(np.diff(top) > 0.0)
        seen = np.concatenate([self.heights, np.column_stack([force[new], path[new]])])
        self.outcome.peak_force = float(force[-1])
        self.heights = seen[seen[:, 0] >= reached(self.outcome.peak_force)]
        self.outcome.displacement_at_peak = self.recording.along(float(self.heights[0, 1]))

    def shows_more(self, stress: float) -> bool:
        """Whether a frame of a row that is higher than all before is worth its while: of frames that differ by next to
        nothing the first is kept."""
        last = self.near[-1][0] if self.near else -np.inf
        return stress > last * (1.0 + ALIKE) or last < reached(stress)

    def keep(self, stress: float) -> None:
        """A row is higher than all before: keep the frames that may be the first near to the peak."""
        self.near = [one for one in self.near if one[0] >= reached(stress)]
        self.highest_row, self.outcome.standing["peak"] = stress, self.near[0][2]

    def frames(self) -> list[Frame]:
        """The frame at the peak, where there is one."""
        return [frame for _, frame, _ in self.near[:1]]

    def finish(self) -> None:
        """The force that may have been missed between two steps, and for how long the peak was borne."""
        self.outcome.missed_between_steps, self.outcome.borne_through = self.around.missed(), self.around.through

    def state(self) -> State:
        """All that it remembers, and the extremes so far."""
        near = [[stress, by_field(frame), by_field(standing)] for stress, frame, standing in self.near]
        remembered = {**attributes(self, self.REMEMBERED), **attributes(self.outcome, EXTREMES)}
        return {**remembered, "near": near, "around": self.around.state()}

    def restore(self, state: State) -> None:
        """Go on from there."""
        load_attributes(self, self.REMEMBERED, state)
        load_attributes(self.outcome, EXTREMES, state)
        self.near = [(height, Frame(**frame), Standing(**acts)) for height, frame, acts in state["near"]]
        self.around.restore(state["around"])


def by_field(record: Frame | Standing) -> State:
    """The fields of a record, by name."""
    return {entry.name: getattr(record, entry.name) for entry in fields(record)}

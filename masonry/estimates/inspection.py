"""A run that is looked at: what it was made of, what came of it, and its joint faces, found once for all who ask."""

from functools import cached_property

import numpy as np

from masonry.assembly.assemble import Assembly
from masonry.estimates.joint_faces import Faces, faces_of
from masonry.estimates.joint_loads import Look, Shear, look_at, shear_of
from masonry.rows.columns import FACTOR
from masonry.rows.history import Frame
from masonry.timeloop.run_outcome import Outcome

LEAST, WITHOUT = 0.015, 0.02
"""Least error of a strength that an estimate from joint faces can tell, whatever accuracy is asked for; that from which
on it is told, if none is."""
GAVE_WAY = 0.01
"""Of the work of joints behind a peak, from which on what is not elastic made it one."""


class Inspection:
    """An assembly, the outcome of its run, and what several doubts are measured from."""

    def __init__(self, assembly: Assembly, outcome: Outcome) -> None:
        self.assembly, self.outcome = assembly, outcome
        self._looks: dict[int, Look] = {}
        self._shears: dict[int, Shear] = {}

    @property
    def frames(self) -> list[Frame]:
        """Those of the run, in order."""
        return self.outcome.history.frames

    @cached_property
    def faces(self) -> Faces:
        """The joint faces of the specimen."""
        return faces_of(self.assembly)

    def look(self, number: int) -> Look:
        """The joint faces in the frame of a number."""
        if number not in self._looks:
            self._looks[number] = look_at(self.assembly, self.faces, self.frames[number])
        return self._looks[number]

    def shear(self, number: int) -> Shear:
        """How the joint faces are sheared in the frame of a number."""
        if number not in self._shears:
            self._shears[number] = shear_of(self.assembly, self.faces, self.frames[number])
        return self._shears[number]

    @cached_property
    def peak(self) -> int:
        """Number of the frame of the peak; without a drive, of the last one before anything fell."""
        outcome = self.outcome
        steps, rows = [frame.step for frame in self.frames], outcome.standing_rows
        if self.assembly.scene.drive is not None and "peak" in outcome.standing:
            step = outcome.standing["peak"].step
        elif FACTOR in rows and (borne := outcome.loading.borne) is not None:
            step = int(rows["step"][np.argmax(np.where(rows[FACTOR] <= borne, rows[FACTOR], -np.inf))])
        else:
            step = int(rows["step"][-1])
        return max(int(np.searchsorted(steps, step, side="right")) - 1, 0)

    @property
    def gave_way(self) -> bool:
        """Whether joints gave way behind the peak of a drive."""
        if self.assembly.scene.drive is None or self.peak + 1 >= len(self.frames):
            return False
        behind = self.look(self.peak + 1)
        return behind.inelastic.total > GAVE_WAY * behind.work.total

    @cached_property
    def plateau(self) -> list[int]:
        """Numbers of the frames in which the force against a drive is that of the peak, to the accuracy; none without a
        drive, and where it gives way to the force."""
        if self.assembly.scene.drive is None or self.frames[self.peak].displacement == 0.0:
            return []
        rows = self.outcome.history.rows
        row = np.searchsorted(rows["step"], [frame.step for frame in self.frames])
        stress = rows["stress"][np.minimum(row, len(rows["stress"]) - 1)]
        lowest = (1.0 - self.accuracy) * stress[self.peak]
        return [int(k) for k in np.flatnonzero(stress >= lowest)] if lowest > 0.0 else []

    @property
    def accuracy(self) -> float:
        """The accuracy that the scene asks for, but no less than that of an estimate from joint faces."""
        drive, limit = self.assembly.scene.drive, self.assembly.scene.limit
        wanted = drive.accuracy if drive is not None else None if limit is None else limit.run_accuracy
        return max(WITHOUT if wanted is None else wanted, LEAST)

    @property
    def is_for_strength(self) -> bool:
        """Whether the run is made for a load that is borne: that of a drive, or one that grows."""
        limit = self.assembly.scene.limit
        return self.assembly.scene.drive is not None or (limit is not None and limit.run_accuracy is not None)

    @property
    def strength(self) -> str:
        """Name of the number for which the run is made."""
        return "peak" if self.assembly.scene.drive is not None else "load that is borne"

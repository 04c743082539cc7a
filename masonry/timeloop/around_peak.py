"""The forces at the steps around a peak: by how much more a specimen may have borne between two of them."""

import numpy as np

from masonry.runtime.state_file import Remembering

BESIDE = 2
"""Steps before the peak, and after it, that are kept."""


class AroundPeak(Remembering):
    """Follows the force of a drive step by step.

    before   (2,) N, at the last steps so far
    forces   (<= 5,) N, from two steps before the peak so far to two steps after it
    """

    REMEMBERED = ("before", "forces")

    def __init__(self) -> None:
        self.before, self.forces = np.zeros(0), np.zeros(0)

    def see(self, force: np.ndarray, peak: int | None) -> None:
        """The force (n,) N of the next steps, and which of them is higher than all before; None where none is."""
        every = np.concatenate([self.before, force])
        if peak is not None:
            at = len(self.before) + peak
            self.forces = every[max(at - BESIDE, 0) : at + BESIDE + 1]
        elif len(self.forces):
            self.forces = np.concatenate([self.forces, force])[: 2 * BESIDE + 1]
        self.before = every[-BESIDE:]

    def missed(self) -> float:
        """Share by which the force may have been higher between two steps; 0 where it did not come down again.

        A force that rises by a at each step and falls by b passes its peak by at most a b / (a + b): straight lines
        through the steps before and after it meet no higher.
        """
        if len(self.forces) < 2 * BESIDE + 1 or self.forces[BESIDE] <= 0.0:
            return 0.0
        change = np.diff(self.forces)
        rise, fall = float(change[:BESIDE].max()), float(-change[BESIDE:].min())
        if rise <= 0.0 or fall <= 0.0:
            return 0.0
        return rise * fall / (rise + fall) / float(self.forces[BESIDE])

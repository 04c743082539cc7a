"""The forces at the steps around a peak: by how much more a specimen may have borne between two of them."""

import numpy as np

from masonry.runtime.state_file import Remembering

BESIDE = 2
"""Steps before the peak, and after it, that are kept."""
BORNE, THROUGH = 0.5, 1e-4
"""A force that has been above so much of the peak before it for less than such a share of the way is a blow. What fell
against a drive struck it for 1e-5 to 4e-5 of its way (from 2 to 30 steps); what is borne rises over a tenth of it."""


class AroundPeak(Remembering):
    """Follows the force of a drive step by step.

    before  (2, 2) place (m) and force (N) of the last steps so far
    curve   (2, <= 5) the same from two steps before the peak so far to two steps after it
    peak    number of the peak in that
    rises   m, the last place at which the force was below a share BORNE of the peak so far
    through share of the way since when the peak so far had been above that of the one before it
    """

    REMEMBERED = ("before", "curve", "peak", "rises", "through")

    def __init__(self) -> None:
        self.before, self.curve, self.peak, self.rises = np.zeros((2, 0)), np.zeros((2, 0)), 0, 0.0
        self.through = 1.0

    def strikes(self, place: np.ndarray, force: np.ndarray, highest: int, peak: float) -> bool:
        """Whether the highest of the forces (n,) N of the next steps, at places (n,) m, is a blow above such a peak
        (N); none is where nothing was borne before."""
        before = np.flatnonzero(force[:highest] < BORNE * peak)
        begins = place[before[-1]] if len(before) else self.rises
        way, through = abs(float(place[highest])), abs(float(place[highest] - begins))
        struck = bool(force[highest] > peak > 0.0 and through < THROUGH * way)
        if force[highest] > peak and not struck:
            peak, self.through = float(force[highest]), through / way if way else 1.0
        low = np.flatnonzero(force < BORNE * peak)
        if len(low):
            self.rises = float(place[low[-1]])
        return struck

    def see(self, place: np.ndarray, force: np.ndarray, peak: int | None) -> None:
        """The places (n,) m and forces (n,) N of the next steps, and which of them is higher than all before; None
        where none is."""
        steps = np.array([place, force])
        every = np.concatenate([self.before, steps], axis=1)
        if peak is not None:
            at = self.before.shape[1] + peak
            self.peak = min(at, BESIDE)
            self.curve = every[:, at - self.peak : at + BESIDE + 1]
        elif self.curve.size:
            self.curve = np.concatenate([self.curve, steps], axis=1)[:, : self.peak + BESIDE + 1]
        self.before = every[:, -BESIDE:]

    def missed(self) -> float:
        """Share by which the force may have been higher between two steps; 0 where it did not come down again.

        Where it rises by a along a step and falls by b, straight lines through the steps before and after it meet no
        higher than a b / (a + b) above it. Before the highest step that is no more than the line lies above it there.
        """
        place, force = self.curve
        if not len(force) or force[self.peak] <= 0.0:
            return 0.0
        way, change = np.abs(np.diff(place)), np.diff(force)
        slope = np.divide(change, way, out=np.zeros_like(change), where=way > 0.0)
        rise, fall = slope[: self.peak].max(initial=0.0), -slope[self.peak :].min(initial=0.0)
        if rise <= 0.0 or fall <= 0.0:
            return 0.0
        beyond = rise * fall / (rise + fall) * way[self.peak - 1 : self.peak + 1]
        above = (slope[0] - slope[1]) * way[1] if self.peak == BESIDE else 0.0
        return float(max(min(beyond[0], above), beyond[-1], 0.0) / force[self.peak])


def missed_between_rows(place: np.ndarray, force: np.ndarray, peak: int) -> float:
    """The same of the rows of a curve, places (n,) m and forces (n,) N, around the peak of a drive that turns back:
    where it turns nothing is missed."""
    leg = np.sign(np.diff(place))
    first, last = peak, peak
    while first > max(peak - BESIDE, 0) and leg[first - 1] == leg[peak - 1]:
        first -= 1
    while last < min(peak + BESIDE, len(leg)) and peak > 0 and leg[last] == leg[peak - 1]:
        last += 1
    around = AroundPeak()
    around.see(place[first : last + 1], force[first : last + 1], peak - first)
    return around.missed()

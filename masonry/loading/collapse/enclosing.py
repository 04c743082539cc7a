"""The factor of a load that grows, enclosed: what was borne, what was not, and what is tried next.

A load that goes to and fro goes leg by leg, from one of its turning points to the next, each leg as a load
that grows.
"""

from math import inf, log, log2

from masonry.loading.collapse.factor_path import FactorPath
from masonry.loading.collapse.growing_settings import GrowingSettings
from masonry.runtime.state_file import Remembering

LEAST = 1e-9
"""A factor that is nothing, where there is no other load to compare with."""
RAISED = 12.0
"""Trials by which a load may still be raised, each time by up to half of what it is."""
SLIVER = 1e-6
"""Share of an increment that is not left over at the end of a leg: it is but rounding of the sum of increments."""


class Enclosing(Remembering):
    """How far a load has come on its path, and by how much it is raised.

    leg     number of the present one; what follows are factors less that at its start, along it:
    stands  the greatest that was borne     falls  the least that was not; inf if none     target  what is tried
    done    in thousandths, how far the first of its falls was known, where that came to rest: what follows is the rest
    """

    REMEMBERED = ("leg", "stands", "falls", "target", "increment", "greatest", "trials", "done")

    def __init__(self, path: FactorPath, least: float, settings: GrowingSettings) -> None:
        """least: factor below which a load is none"""
        self.path, self.settings, self.least = path, settings, max(least, LEAST)
        self.leg = self.trials = self.done = 0
        self.stands = self.target = self.greatest = 0.0
        self.falls, self.increment = inf, min(self.longest, path.legs[0].length)

    @property
    def borne(self) -> float:
        """The factor that was borne last."""
        return self.path.legs[self.leg].at(self.stands)

    @property
    def tried(self) -> float:
        """The factor that is tried."""
        return self.path.legs[self.leg].at(self.target)

    @property
    def fallen(self) -> float | None:
        """The least factor that was not borne on this leg; None where there is none."""
        return None if self.falls == inf else self.path.legs[self.leg].at(self.falls)

    @property
    def longest(self) -> float:
        """The longest increment: a fraction of what is borne, or, to and fro, of all that the load goes through."""
        if self.path.reversals:
            return self.settings.to_and_fro(self.path.accuracy) * self.path.span
        return max(self.settings.first, self.settings.coarsest * self.stands)

    @property
    def is_narrow(self) -> bool:
        """Whether the factor is enclosed as narrowly as was asked for."""
        return self.falls - self.stands <= self.narrow

    @property
    def narrow(self) -> float:
        """How narrowly that is: a share of the factor; of one that went to and fro, of the greatest that was borne."""
        factor = max(abs(self.path.legs[self.leg].at(self.falls)), self.greatest)
        return max(self.path.accuracy * factor, self.least)

    def begin(self) -> None:
        """Set out for a higher factor."""
        end = self.path.legs[self.leg].length
        self.target = self.stands + self.increment
        if self.target > end - SLIVER * self.increment:
            self.target = end
        self.trials += 1

    def bear(self) -> None:
        """Update after a trial that is borne."""
        self.stands = self.target
        if self.stands >= self.falls:  # what was taken for a fall is borne after all, coming from nearer
            self.falls, self.increment = inf, 0.5 * self.path.accuracy * self.stands
        if self.falls == inf:
            self.increment = min(2.0 * self.increment, self.longest)

    def fail(self) -> bool:
        """Update after a trial that is not borne; whether it is the least that was not."""
        if self.target > self.falls:
            return False
        self.falls = self.target
        return True

    def catch(self) -> None:
        """Update after a fall that came to rest: the load not borne before is borne."""
        self.done = self.progress()
        self.stands, self.falls = max(self.target, self.falls), inf
        self.increment = 0.5 * self.path.accuracy * self.stands

    def go_on(self) -> bool:
        """By how much to raise the factor from here, on this leg or the next; False where the load has come to its
        end. Where the factor is known, what follows is the fall."""
        if self.stands >= self.path.legs[self.leg].length:
            if self.leg + 1 == len(self.path.legs):
                return False
            self.greatest = max(self.greatest, abs(self.borne))
            self.leg, self.stands, self.falls, self.increment = self.leg + 1, 0.0, inf, self.longest
        elif self.falls < inf:
            self.increment = (self.falls - self.stands) * (1.0 if self.is_narrow else 0.5)
        return True

    def trials_left(self) -> tuple[float, float]:
        """At least, and at most, of a load that grows one way: an interval is halved until it is narrow, but before
        something falls nobody knows how often the factor is still raised."""
        wide = self.increment if self.falls == inf else self.falls - self.stands
        narrow = self.path.accuracy * max(self.target, self.settings.first)
        halvings = max(log2(max(wide, narrow) / narrow), 0.0) + 1.0
        return halvings, halvings + (RAISED if self.falls == inf else 1.0)

    def progress(self) -> int:
        """How far the factor is known, in thousandths; to and fro, how far it has come."""
        if self.path.reversals:
            done = sum(leg.length for leg in self.path.legs[: self.leg]) + self.stands
            return int(999 * done / self.path.length)
        share = 0.5 * self.trials / (self.trials + 20)
        if self.falls < inf:
            share = 0.5 + 0.45 / (1.0 + log(max((self.falls - self.stands) / self.narrow, 1.0)))
        return self.done + int((1000 - self.done) * share)

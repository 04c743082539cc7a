"""The phases of a load that grows. Each says what the load does in its chunks, and which phase follows from a look:

settling   the dead loads settle                          then rising
rising     the factor goes to the one that is tried       then waiting, unless the specimen falls already
waiting    the factor stays, the specimen is watched      then showing, unless it falls or takes too long
showing    a row shows the rest                           then rising to the next factor, or the end
dropping   the fall is followed, to show who moves        then the end, or showing where it comes to rest
leading    a gauge is led on behind the collapse          then the end

Where the specimen falls, the model goes back to its last rest, and rising begins again by half as much, until the
factor is enclosed as narrowly as was asked for: then leading follows, where the scene names a gauge, else dropping.
"""

from abc import ABC, abstractmethod
from typing import ClassVar

import numpy as np

from masonry.configuration.chunk import Chunk
from masonry.loading.collapse.branch import FAR, TURNED
from masonry.loading.collapse.trials import Trials
from masonry.runtime.state_file import Remembering


class Phase(Remembering, ABC):
    """Base of all phases.

    name          by which a checkpoint knows it
    bears_turns   whether a block that turns too far ends the phase, and not the run
    bears_distance  the same of blocks that have crushed, slid or met further than can be told
    """

    name: ClassVar[str]
    bears_turns: ClassVar[bool] = False
    bears_distance = False

    def __init__(self, trials: Trials) -> None:
        self.trials, self.settings = trials, trials.settings

    @abstractmethod
    def chunk(self) -> Chunk | None:
        """The next steps; None where the phase is over without a look."""

    def following(self) -> "Phase":
        """The phase behind that."""
        return self

    def look(self, before: list[np.ndarray]) -> "Phase":
        """The next phase, by the specimen behind a chunk; `before`: velocities one step before."""
        return self

    def turned(self) -> "Phase":
        """The next phase, where a block has turned too far."""
        return self

    def moved(self) -> "Phase":
        """The next phase, where blocks have crushed, slid or met too far."""
        return self.turned()


class SettlingPhase(Phase):
    """The dead loads settle."""

    name = "settling"

    def chunk(self) -> Chunk | None:
        """As their program says."""
        return self.trials.settling.next()

    def following(self) -> Phase:
        """The first trial."""
        self.trials.travels.look()
        self.trials.keep()
        return rising(self.trials)


class RisingPhase(Phase):
    """The factor rises to the one that is tried. risen: looks so far"""

    name, bears_turns, REMEMBERED = "rising", True, ("risen",)

    def __init__(self, trials: Trials) -> None:
        super().__init__(trials)
        self.risen = 0

    def chunk(self) -> Chunk:
        """A part of the rise."""
        trials, passed = self.trials, (self.risen + 1) / self.trials.looks_of_rise
        borne, tried = trials.enclosing.borne, trials.enclosing.tried
        factor = tried if passed >= 1.0 else borne + passed * (tried - borne)
        return trials.load.pass_to(factor, self.settings.look)

    def look(self, before: list[np.ndarray]) -> Phase:
        """It goes on, unless the specimen falls already."""
        self.trials.look()
        self.risen += 1
        if self.trials.travels.travelled > self.trials.travels.away:
            return not_borne(self.trials)
        return WaitingPhase(self.trials) if self.risen >= self.trials.looks_of_rise else self

    def turned(self) -> Phase:
        """The trial did not come to rest."""
        return not_borne(self.trials, turning=True)


class WaitingPhase(Phase):
    """The factor stays, and the specimen is watched. calm: looks on end at which it rested"""

    name, bears_turns, REMEMBERED = "waiting", True, ("calm",)

    def __init__(self, trials: Trials) -> None:
        super().__init__(trials)
        self.calm = 0

    def chunk(self) -> Chunk:
        """The factor stays; where the specimen fell before the factor was there, it stays below the one that is
        tried."""
        return self.trials.load.pass_to(self.trials.load.factor, self.settings.look)

    def look(self, before: list[np.ndarray]) -> Phase:
        """Whether the specimen rests, falls, or has still to be waited for."""
        trials = self.trials
        trials.look()
        alone = self.count_rest(before)
        travels, watch = trials.travels, trials.watch
        if self.calm >= self.trials.rest_level.looks:
            return rested(trials)
        if travels.travelled > travels.away or travels.fallen():
            return not_borne(trials)
        if watch.falls(before, trials.rest.copies, travels.travelled, travels.alone_or_none(alone)):
            return not_borne(trials)
        if watch.too_long:
            trials.tally.undecided += 1
            return not_borne(trials)
        return self

    def count_rest(self, before: list[np.ndarray]) -> bool:
        """Count looks at which all rests; returns whether the sum over all does, and a block or a gauge does not."""
        rests, alone = self.trials.rests(before, self.calm)
        self.calm = self.calm + 1 if rests else 0
        return alone

    def turned(self) -> Phase:
        """The trial did not come to rest."""
        return not_borne(self.trials, turning=True)


class ShowingPhase(Phase):
    """A row shows the rest."""

    name = "showing"

    def chunk(self) -> Chunk:
        """The factor stays, and a row is due."""
        return self.trials.load.pass_to(self.trials.load.factor, self.settings.look, row=True)

    def look(self, before: list[np.ndarray]) -> Phase:
        """The next trial."""
        self.trials.look()
        return next_trial(self.trials)


class DroppingPhase(Phase):
    """The fall is followed, to show who moves, and on for as long as something may catch it.

    looked  looks so far     calm  looks on end at which it rested
    farthest, idle  m, how far it has come, and looks since
    next_question   look from which on it is asked whether anything may catch it
    """

    name, bears_turns = "dropping", True
    bears_distance = True
    REMEMBERED = ("looked", "calm", "farthest", "idle", "next_question")

    def __init__(self, trials: Trials) -> None:
        super().__init__(trials)
        self.looked = self.calm = self.idle = self.next_question = 0
        self.farthest, settings = 0.0, trials.settings
        far, self.most_looks = settings.fall, settings.fall_looks
        if trials.freely:
            far, self.most_looks = settings.far, settings.far_looks
        self.far = trials.travels.size * far

    def chunk(self) -> Chunk:
        """At the factor that was tried, as the specimen may have fallen before that was there; each look is a row until
        it has shown who moves."""
        row = self.looked < self.most_looks or self.looked % self.settings.row_of == 0
        return self.trials.load.pass_to(self.trials.enclosing.tried, self.settings.look, row)

    def look(self, before: list[np.ndarray]) -> Phase:
        """Until it rests, or has shown who moves and nothing can catch it any more."""
        trials = self.trials
        trials.look()
        self.looked += 1
        if trials.watch.brake(before, trials.travels.alone_or_none()) < 0.0:
            trials.watch.drag()
        self.calm = self.calm + 1 if trials.rests(before, self.calm)[0] else 0
        if self.calm >= trials.rest_level.looks:
            return self.rested()
        self.count_idle()
        if not (self.shown or self.looked >= self.most_looks):
            return self
        return self if self.goes_on() else EndPhase(trials)

    def rested(self) -> Phase:
        """The fall is none, or came to rest beyond the travel that ends one."""
        trials = self.trials
        if trials.travels.travelled > trials.catching.travel:
            return EndPhase(trials)
        trials.catch()
        return ShowingPhase(trials)

    def count_idle(self) -> None:
        """Count looks in which it came no farther."""
        travelled = self.trials.travels.travelled
        self.idle += 1
        if travelled > (1.0 + self.settings.onward) * self.farthest:
            self.farthest, self.idle = travelled, 0

    def goes_on(self) -> bool:
        """Whether it may still come to rest within the travel that ends a fall; asked now and then, where it falls."""
        trials, settings, travelled = self.trials, self.settings, self.trials.travels.travelled
        if trials.branch is not None:
            return False
        is_within = travelled <= trials.catching.travel
        if is_within and self.looked >= settings.looks_on:
            trials.tally.undecided += 1
            return False
        if is_within and (self.idle >= settings.stalled or self.looked < self.next_question):
            return True
        self.next_question = self.looked + settings.stalled
        comes = trials.catching.may_come(trials.rest.copies, travelled)
        if comes:
            trials.push_on()
        return comes and is_within

    @property
    def shown(self) -> bool:
        """Whether the fall has been followed for long enough."""
        travels = self.trials.travels
        if travels.alone.any():
            return travels.fallen(self.far / (self.settings.away * travels.size))
        return travels.travelled > self.far

    def turned(self) -> Phase:
        """That is far enough, unless something might have caught it yet."""
        trials = self.trials
        if trials.catching.may_come(trials.rest.copies, trials.travels.travelled):
            trials.tally.falls_by_turning = True
        return EndPhase(trials)

    def moved(self) -> Phase:
        """That is far enough; whether a bar would bear yet is told."""
        self.trials.catching.may_come(self.trials.rest.copies, self.trials.travels.travelled)
        return EndPhase(self.trials)


class LeadingPhase(Phase):
    """A gauge is led on behind the collapse."""

    name, bears_turns = "leading", True
    bears_distance = True

    def __init__(self, trials: Trials) -> None:
        super().__init__(trials)
        assert trials.branch is not None
        self.branch = trials.branch

    def chunk(self) -> Chunk:
        """The factor goes to where the servo wants it."""
        return self.trials.load.pass_to(self.branch.servo.factor, self.branch.interval, self.branch.row_due)

    def look(self, before: list[np.ndarray]) -> Phase:
        """Until the branch ends."""
        self.trials.look()
        return self if self.branch.goes_on(before) else EndPhase(self.trials)

    def turned(self) -> Phase:
        """The branch ends there."""
        self.branch.leave(TURNED)
        return EndPhase(self.trials)

    def moved(self) -> Phase:
        """So it does where blocks have moved too far."""
        self.branch.leave(FAR)
        return EndPhase(self.trials)


class EndPhase(Phase):
    """Nothing follows: a fall has ended, or the load has come to its end `at_rest`."""

    name = "end"

    def __init__(self, trials: Trials, at_rest: bool = False) -> None:
        super().__init__(trials)
        self.bears_distance = not at_rest

    def chunk(self) -> None:
        """There is none."""
        return None


PHASES = {
    phase.name: phase
    for phase in (SettlingPhase, RisingPhase, WaitingPhase, ShowingPhase, DroppingPhase, LeadingPhase, EndPhase)
}


def rising(trials: Trials) -> Phase:
    """A trial begins."""
    trials.begin()
    return RisingPhase(trials)


def next_trial(trials: Trials) -> Phase:
    """The next trial, after a rest, or the end of the path."""
    return rising(trials) if trials.enclosing.go_on() else EndPhase(trials, at_rest=True)


def rested(trials: Trials) -> Phase:
    """The specimen has come to rest: the factor is borne, unless it fell on the way, and it is not known yet at which
    factor that begins."""
    if not trials.leapt:
        trials.bear()
        return ShowingPhase(trials)
    trials.fail(turning=False)
    if trials.enclosing.is_narrow:
        trials.catch()
        return ShowingPhase(trials)
    trials.put_back()
    return next_trial(trials)


def not_borne(trials: Trials, turning: bool = False) -> Phase:
    """The factor is not borne: the next trial from the last rest; or, where the factor is enclosed as narrowly as was
    asked for, the fall from here, or a gauge that is led on from the last rest. turning: a block turned too far"""
    trials.fail(turning)
    is_enclosed = trials.enclosing.is_narrow
    if is_enclosed and not trials.can_lead():
        return DroppingPhase(trials)
    trials.put_back()
    return LeadingPhase(trials) if is_enclosed else next_trial(trials)

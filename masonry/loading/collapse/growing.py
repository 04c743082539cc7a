"""A load that grows until nothing balances it: the plan, and how a run advances along it.

Each trial raises the factor from one at which the specimen rests, and waits. Where it comes to rest again, the factor
is borne. Where it accelerates, the model goes back to where it rested, and the next trial raises the factor by half as
much. So the collapse factor is enclosed in one run (enclosing.py), between the greatest that was borne and the least
that was not. Where the scene names a gauge, that is then led on behind the collapse (branch.py). A load that goes to
and fro is borne at each of its turning points, or ends where nothing balances it before.
"""

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from masonry.configuration import energy, model_state
from masonry.configuration.chunk import Chunk
from masonry.loading.collapse.branch import Falling
from masonry.loading.collapse.enclosing import Enclosing
from masonry.loading.collapse.factor_path import FactorPath
from masonry.loading.collapse.outcome import CollapseOutcome
from masonry.loading.collapse.pace import Pace
from masonry.loading.collapse.settings import FALLING, GROWING, GrowingSettings
from masonry.loading.collapse.watching import Gathering
from masonry.loading.loading import Arrays, Expected, Loading
from masonry.loading.moves.travels import Limits, Travels
from masonry.loading.plan import PacedPlan
from masonry.loading.scheduled import Program
from masonry.loading.varying_loads import SharedLoads
from masonry.model.gauges import Gauge
from masonry.model.model import Model
from masonry.monitors.settling import unbalanced
from masonry.rows.columns import FACTOR, OFF_BALANCE
from masonry.runtime.state import State, attributes, load_attributes

REMEMBERED = (
    *("phase", "factor", "calm", "slowest", "undecided", "looked"),
    *("steps_of_trial", "risen", "falls_by_turning", "swayed"),
)
SETTLES, RISES, WAITS, SHOWS, DROPS, LEADS, OVER = "settles", "rises", "waits", "shows", "drops", "leads", "over"
"""Phases: dead loads settle; the factor rises; a trial is watched; its rest is shown; the fall is followed, or a gauge
is led on; the end."""


TRIALS, FEWEST_OF_TRIAL, ROWS_OF_TRIAL = 20, 2000, 5
"""What a run takes: trials, the steps of one at least, and rows of one, with the fall's."""
STEPS_OF_INCREMENT = 1500
"""The same of one that goes to and fro: 400 to 4,500 in single cases."""
STEPS_OF_BRANCH, ROWS_OF_BRANCH = 150_000, 200
"""Of a gauge that is led on behind the collapse: from 3,000 steps to a million in single cases."""


class Control(NamedTuple):
    """Behind its collapse a load is led by a gauge, by its name, until it reads so much (m)."""

    gauge: str
    until: float


@dataclass(frozen=True)
class Growing(PacedPlan):
    """A load whose factor grows along a path until nothing balances it.

    pattern     what the factor multiplies, in a word of the scene
    loops_over  the gauge over which the loops of a load that goes to and fro are seen
    """

    path: FactorPath
    pattern: str = "weight"
    control: Control | None = None
    loops_over: str | None = None

    @property
    def trials(self) -> int:
        """About how many: of a load that goes to and fro, increments."""
        if not self.path.reversals:
            return TRIALS
        return round(self.path.length / (GROWING.to_and_fro(self.path.accuracy) * self.path.span))

    def expected(self, model: Model, rows: int, axis: int | None) -> Expected:
        """About: a trial has few rows, and looks in between."""
        of_trial = STEPS_OF_INCREMENT if self.path.reversals else max(self.settle // 6, FEWEST_OF_TRIAL)
        before, behind = self.settle + self.trials * of_trial, 0 if self.control is None else STEPS_OF_BRANCH
        looks = before / GROWING.look + behind / FALLING.longest
        return Expected(before + behind, ROWS_OF_TRIAL * self.trials + (ROWS_OF_BRANCH if behind else 0), looks)

    def settling(self) -> Program:
        """The dead loads alone, as long as they settle; the load that grows is none yet."""
        varying = np.zeros((len(self.path.load_factors(0.0)), self.settle + 1))
        return replace(super().settling(), varying=varying)

    def loading(self, model: Model, rows: int, gauges: tuple[Gauge, ...] = ()) -> "GrowingLoading":
        """One trial after the other; what falls is put back to where it rested."""
        return GrowingLoading(model, self, rows, gauges)


class GrowingLoading(Loading):
    """The chunks of a run whose load grows."""

    def __init__(
        self,
        model: Model,
        plan: Growing,
        rows: int,
        gauges: tuple[Gauge, ...] = (),
        settings: GrowingSettings = GROWING,
    ) -> None:
        """Gauges  stand still at a rest; the one that the plan names is led on behind the collapse"""
        self.model, self.plan, self.settings = model, plan, settings
        self.settling = plan.settling().loading(model, max(1, rows // 10))
        self.loads = SharedLoads(model, 0 if plan.layers is None else len(plan.layers))
        limits = Limits(settings.still, settings.reading, settings.away, settings.usual)
        self.travels = Travels(model, limits, gauges)
        self.size = self.travels.size
        least = settings.at_rest * plan.path.accuracy * self.loads.rest_over_each()
        self.enclosing, self.gathering = Enclosing(plan.path, least, settings), Gathering(model, settings)
        self.fall, self.most_looks = self.size * settings.fall, settings.fall_looks
        if model.large is not None:
            self.fall, self.most_looks = self.size * settings.far, settings.far_looks
        self.phase, self.factor = SETTLES, 0.0
        self.rested: Arrays = {}
        self.pace, self.booked = Pace(plan.path.accuracy, settings), energy.works(model)
        self.calm = self.undecided = self.looked = self.steps_of_trial = self.risen = self.slowest = 0
        self.swayed = 0.0
        self.turned = self.falls_by_turning = False
        self.branch = None
        if plan.control is not None:
            gauge = next(gauge for gauge in gauges if gauge.name == plan.control.gauge)
            self.branch = Falling(model, plan.path, gauge, plan.control.until)

    def load_factors(self) -> np.ndarray:
        """(L + H,) of the loads that come on in layers, and of those that grow, now."""
        growing = self.plan.path.load_factors(self.factor)
        return np.concatenate([self.settling.load_factors()[: -len(growing)], growing])

    def columns(self) -> dict[str, float]:
        """What a row says besides."""
        return {FACTOR: self.factor} | ({} if self.branch is None else {OFF_BALANCE: self.branch.off})

    def next(self) -> Chunk | None:
        """The next chunk; None when the fall was followed, or the load has come to its end."""
        if self.phase == SETTLES:
            waiting = self.settling.next()
            if waiting is not None:
                return waiting
            self.travels.look()
            self.keep()
            self.begin()
        if self.phase == OVER:
            return None
        if self.phase == LEADS and self.branch is not None:
            return self.passing(self.branch.factor, self.branch.look, self.branch.row_due)
        if self.phase == RISES:
            return self.passing(self.rising(), self.settings.look)
        factor = self.enclosing.tried if self.phase == DROPS else self.factor  # it may fall before it is there
        return self.passing(factor, self.settings.look, self.phase in (SHOWS, DROPS))

    @property
    def window(self) -> int:
        """Looks by which patience is measured: a quarter of the slowest rest, or of a quarter of the settling."""
        return max(self.settings.window, max(self.slowest, self.plan.settle // 4) // (4 * self.settings.look))

    def passing(self, factor: float, steps: int, row: bool = False) -> Chunk:
        """Some steps in which the factor goes to another one."""
        dead = np.full(steps + 1, float(self.plan.dead_load[-1]))
        begin, end = (self.plan.path.load_factors(one) for one in (self.factor, factor))
        load_factor = self.loads.pass_over(begin, end, steps)
        self.factor = factor
        return Chunk(dead + load_factor, np.zeros(steps + 1), row)

    def keep(self) -> None:
        """The specimen rests here: trials begin from here."""
        self.rested, self.booked = model_state.state(self.model), energy.works(self.model)
        self.travels.rest()

    def begin(self) -> None:
        """Set out for a higher factor."""
        self.enclosing.begin()
        self.travels.begin()
        self.gathering.begin(self.window, self.travels.most)
        self.phase, self.calm, self.steps_of_trial, self.risen = RISES, 0, 0, 0

    def rising(self) -> float:
        """The factor behind the next look, on its way to the one that is tried."""
        borne, tried, passed = self.enclosing.borne, self.enclosing.tried, (self.risen + 1) / self.looks_of_rise
        return tried if passed >= 1.0 else borne + passed * (tried - borne)

    @property
    def looks_of_rise(self) -> int:
        """Looks in which the factor rises to the one that is tried."""
        return round(self.pace.slower * self.window)

    def feel(self, step: int, before: list[np.ndarray]) -> None:
        """Look at the specimen after each chunk; `before`: velocities one step before this one."""
        if self.phase in (SETTLES, OVER):
            return
        if self.turned:
            self.end_by_turning()
            return
        self.steps_of_trial += self.settings.look
        self.travels.look()
        if self.phase == RISES:
            self.rise()
        elif self.phase == WAITS:
            self.judge(before)
        elif self.phase == SHOWS:
            self.go_on()
        elif self.phase == LEADS and self.branch is not None:
            self.phase = self.phase if self.branch.goes_on(before) else OVER
        else:
            self.looked += 1
            self.gathering.brake(before, self.travels.alone_or_none())
            self.phase = OVER if self.dropped or self.looked >= self.most_looks else DROPS

    @property
    def dropped(self) -> bool:
        """Whether the fall has been followed for long enough to show who moves."""
        if self.travels.alone.any():
            return self.travels.fallen(self.fall / (self.settings.away * self.size))
        return self.travels.travelled > self.fall

    def turned_too_far(self) -> bool:
        """A block has turned further than small displacement allows: whether this is no more than the end of a trial,
        or of the fall that is followed."""
        self.turned = self.phase in (RISES, WAITS, DROPS, LEADS)
        if self.phase == LEADS and self.branch is not None:
            self.branch.turned()
        return self.turned

    def end_by_turning(self) -> None:
        """A trial in which a block turns too far did not come to rest."""
        self.turned = False
        if self.phase in (DROPS, LEADS):
            self.phase = OVER
            return
        self.fail(turning=True)

    def rise(self) -> None:
        """The factor goes on, unless the specimen falls already."""
        self.risen += 1
        if self.travels.travelled > self.travels.away:
            self.fail()
        elif self.risen >= self.looks_of_rise:
            self.phase = WAITS

    def judge(self, before: list[np.ndarray]) -> None:
        """Whether the specimen rests, accelerates, or has still to be waited for."""
        now = energy.observe(self.model)
        kinetic, stored = abs(energy.kinetic(self.model, before)), now.elastic_blocks + now.elastic_contacts
        loose = unbalanced(self.model, before) > self.settings.at_rest * self.plan.path.accuracy
        rests = not loose and kinetic <= self.settings.still * stored
        alone = rests and self.travels.moves_alone(before, self.settings.at_rest * self.plan.path.accuracy, self.calm)
        self.calm = self.calm + 1 if rests and not alone else 0
        travelled = self.travels.travelled
        far = travelled > self.travels.away or self.travels.fallen()
        if self.calm >= self.settings.looks:
            self.bear()
        elif far or self.gathering.falls(before, self.rested, travelled, self.travels.alone_or_none(alone)):
            self.fail()
        elif self.gathering.too_long:
            self.undecided += 1
            self.fail()

    def bear(self) -> None:
        """The factor is borne: a row shows it, and the next trial goes on from here."""
        if self.branch is not None:
            self.branch.learn(self.rested, self.enclosing.target - self.enclosing.stands)
        self.enclosing.bear()
        if self.plan.path.reversals:
            _, damped, work, *_ = energy.works(self.model) - self.booked
            self.pace.learn(work, -damped)
        self.slowest = max(self.slowest, self.steps_of_trial)
        self.swayed = self.travels.sways()
        self.keep()
        self.phase = SHOWS

    def go_on(self) -> None:
        """The next trial, after a rest; where the factor is known, the one that follows the fall."""
        if self.enclosing.go_on():
            self.begin()
        else:
            self.phase = OVER

    def fail(self, turning: bool = False) -> None:
        """The factor is not borne: go back to where the specimen rested, or follow the fall from here."""
        if self.enclosing.fail():
            self.falls_by_turning = turning
        stands, falls = self.enclosing.stands, self.enclosing.falls
        if self.enclosing.found and (self.branch is None or not self.branch.begin(self.rested, stands, falls)):
            self.phase, self.looked = DROPS, 0
            return
        model_state.restore(self.model, self.rested)
        self.gathering.hold()
        self.factor = self.enclosing.borne
        if self.enclosing.found:
            self.phase = LEADS
        else:
            self.go_on()

    def progress(self) -> tuple[int, int]:
        """How far the factor is known, in thousandths; where a gauge is to be led on, that is the first half."""
        if self.phase == OVER:
            return 1000, 1000
        enclosed = self.enclosing.progress()
        return enclosed if self.branch is None else self.branch.progress(enclosed), 1000

    def outcome(self) -> CollapseOutcome:
        """The interval of the factor, the mechanism, and the branch behind it."""
        enclosing = self.enclosing
        return CollapseOutcome(
            pattern=self.plan.pattern,
            path=self.plan.path,
            loops_over=self.plan.loops_over,
            borne=enclosing.borne if abs(enclosing.borne) > enclosing.least else 0.0,
            falls=enclosing.fallen,
            trials=enclosing.trials,
            leg=enclosing.leg + 1,
            undecided=self.undecided,
            falls_by_turning=self.falls_by_turning,
            swayed=self.swayed / self.size,
            freely=self.model.large is not None,
            mechanism=self.travels.relative(),
            branch=None if self.branch is None else self.branch.outcome(),
        )

    def state(self) -> State:
        """All that the next chunk depends on."""
        return {
            **attributes(self, REMEMBERED),
            "rested": self.rested,
            "travels": self.travels.state(),
            "settling": self.settling.state(),
            "enclosing": self.enclosing.state(),
            "gathering": self.gathering.state(),
            "pace": self.pace.state(),
            "booked": self.booked,
            **({} if self.branch is None else {"branch": self.branch.state()}),
        }

    def restore(self, state: State) -> None:
        """Go on from there."""
        load_attributes(self, REMEMBERED, state)
        self.rested = state["rested"]
        self.travels.restore(state["travels"])
        self.settling.restore(state["settling"])
        self.enclosing.restore(state["enclosing"])
        self.gathering.restore(state["gathering"])
        self.pace.restore(state["pace"])
        self.booked = state["booked"]
        if self.branch is not None:
            self.branch.restore(state["branch"])

"""A load that grows until nothing balances it: the plan, and how a run advances along it.

Each trial raises the factor from one at which the specimen rests, and waits. Where it comes to rest again, the factor
is borne. Where it accelerates, the model goes back to where it rested, and the next trial raises the factor by half as
much. So the collapse factor is enclosed in one run (enclosing.py), between the greatest that was borne and the least
that was not. Where the scene names a gauge, that is then led on behind the collapse (branch.py). A load that goes to
and fro is borne at each of its turning points, or ends where nothing balances it before.
"""

from dataclasses import dataclass
from math import inf
from typing import NamedTuple

import numpy as np

from masonry.configuration.chunk import Chunk
from masonry.loading.collapse.branch import Branch
from masonry.loading.collapse.factor_path import FactorPath
from masonry.loading.collapse.growing_settings import FALLING, GROWING, GrowingSettings
from masonry.loading.collapse.outcome import CollapseOutcome
from masonry.loading.collapse.phases import PHASES, EndPhase, Phase, SettlingPhase
from masonry.loading.collapse.trials import FactorLoad, Tally, Trials
from masonry.loading.loading import Expected, Loading
from masonry.loading.plan import PacedPlan
from masonry.loading.scheduled import LONGEST_CHUNK
from masonry.model.gauges import Gauge
from masonry.model.model import Model
from masonry.rows.columns import FACTOR, OFF_BALANCE
from masonry.runtime.progress import Effort
from masonry.runtime.state_file import State

TRIALS, OF_TRIAL, ROWS_OF_TRIAL, ROWS_OF_FALL = 20, (1 / 6, 2000), 2, 200
"""What a run takes: trials, steps of one over those of the settling, and at least; rows of one, and of the fall."""
OF_INCREMENT = (1 / 2, 500)
"""The same of one that goes to and fro."""
FEWER, MORE = 0.4, 2.5
"""Times as many in single cases."""
STEPS_OF_BRANCH, FEWEST_OF_BRANCH, MOST_OF_BRANCH, ROWS_OF_BRANCH = 150_000, 3_000, 1_000_000, 200
"""Of a gauge that is led on behind the collapse."""


class Control(NamedTuple):
    """Behind its collapse a load is led by a gauge, by its name, until it reads so much (m)."""

    gauge: str
    until: float


@dataclass(frozen=True)
class Growing(PacedPlan):
    """A load whose factor grows along a path until nothing balances it.

    pattern     what the factor multiplies, in a word of the scene
    loops_over  the gauge over which the loops of a load that goes to and fro are seen
    travel      m, after which what has not come to rest has fallen; None: as the settings say
    """

    path: FactorPath
    pattern: str = "weight"
    control: Control | None = None
    loops_over: str | None = None
    travel: float | None = None

    @property
    def trials(self) -> int:
        """About how many: of a load that goes to and fro, increments."""
        if not self.path.reversals:
            return TRIALS
        return round(self.path.length / (GROWING.to_and_fro(self.path.accuracy) * self.path.span))

    def expected(self, model: Model, rows: int, axis: int | None) -> Expected:
        """About: a trial has few rows, and looks in between."""
        share, fewest = OF_INCREMENT if self.path.reversals else OF_TRIAL
        trying = self.trials * max(round(share * self.settle), fewest)
        fewest, behind, most = (FEWEST_OF_BRANCH, STEPS_OF_BRANCH, MOST_OF_BRANCH) if self.control else (0, 0, 0)
        steps, looks = self.settle + trying + behind, trying / GROWING.look + behind / FALLING.longest
        after = 0 if self.path.reversals else ROWS_OF_FALL if self.control is None else ROWS_OF_BRANCH
        return Expected(
            steps,
            ROWS_OF_TRIAL * self.trials + after,
            looks + self.settle / LONGEST_CHUNK,
            looks,
            least=(self.settle + FEWER * trying + fewest) / steps,
            most=(self.settle + MORE * trying + most) / steps,
        )

    @property
    def varies(self) -> int:
        """A tilt is two loads."""
        return len(self.path.load_factors(0.0))

    def loading(self, model: Model, rows: int, gauges: tuple[Gauge, ...] = ()) -> "GrowingLoading":
        """One trial after the other; what falls is put back to where it rested."""
        return GrowingLoading(model, self, rows, gauges)


class GrowingLoading(Loading):
    """The chunks of a load that grows, phase by phase (phases.py).

    trials  what the phases go by     turned  whether a block has turned too far in the last chunk
    """

    def __init__(
        self,
        model: Model,
        plan: Growing,
        rows: int,
        gauges: tuple[Gauge, ...] = (),
        settings: GrowingSettings = GROWING,
    ) -> None:
        """Gauges  stand still at a rest; the one that the plan names is led on behind the collapse"""
        self.plan, branch = plan, None
        settling = plan.settling().loading(model, max(1, rows // 10))
        layers = 0 if plan.layers is None else len(plan.layers)
        load = FactorLoad(model, plan.path, float(plan.dead_load[-1]), layers)
        if plan.control is not None:
            gauge = next(gauge for gauge in gauges if gauge.name == plan.control.gauge)
            branch = Branch(model, plan.path, gauge, plan.control.until)
        tally = Tally(plan.settle // 4)
        self.trials = Trials(model, load, settling, branch, tally, gauges, settings, plan.travel)
        self.phase: Phase = SettlingPhase(self.trials)
        self.turned = False

    def next(self) -> Chunk | None:
        """The next chunk; None when the fall was followed, or the load has come to its end."""
        chunk = self.phase.chunk()
        if chunk is None:
            self.phase = self.phase.following()
            chunk = self.phase.chunk()
        return chunk

    def feel(self, step: int, before: list[np.ndarray]) -> None:
        """Look at the specimen after each chunk; `before`: velocities one step before this one."""
        self.phase = self.phase.turned() if self.turned else self.phase.look(before)
        self.turned = False

    def turned_too_far(self) -> bool:
        """A block has turned further than small displacement allows: whether this is no more than the end of a trial,
        or of the fall that is followed."""
        self.turned = self.phase.bears_turns
        return self.turned

    def moved_too_far(self) -> bool:
        """The end of the fall that is followed, or of the branch behind it."""
        ends = self.phase.bears_distance
        if ends:
            self.phase = self.phase.moved()
        return ends

    def load_factors(self) -> np.ndarray:
        """(L + H,) of the loads that come on in layers, and of those that grow, now."""
        growing = self.plan.path.load_factors(self.trials.load.factor)
        return np.concatenate([self.trials.settling.load_factors()[: -len(growing)], growing])

    def columns(self) -> dict[str, float]:
        """The factor, and how far it is from equilibrium on a branch."""
        factor, branch = self.trials.load.factor, self.trials.branch
        return {FACTOR: factor} | ({} if branch is None else {OFF_BALANCE: branch.account.off})

    def progress(self) -> tuple[int, int]:
        """How far the factor is known, in thousandths; where a gauge is to be led on, that is the first half."""
        if self.phase.name == EndPhase.name:
            return 1000, 1000
        enclosed, branch = self.trials.enclosing.progress(), self.trials.branch
        return enclosed if branch is None else branch.progress(enclosed), 1000

    def effort(self) -> Effort:
        """Of a load that goes to and fro, its path; else the trials, or the way of the gauge behind them."""
        enclosing, branch = self.trials.enclosing, self.trials.branch
        if self.plan.path.reversals:
            now, whole = self.progress()
            return Effort(now, FEWER * (whole - now), MORE * (whole - now))
        if branch is None:
            return Effort(enclosing.trials, *enclosing.trials_left())
        now, whole = self.progress()
        return Effort(now, FEWER * (whole - now), MORE * (whole - now)) if branch.led else Effort(now, whole, inf)

    def outcome(self, peak: float) -> CollapseOutcome:
        """The interval of the factor, the mechanism, and the branch behind it."""
        trials, enclosing, tally = self.trials, self.trials.enclosing, self.trials.tally
        return CollapseOutcome(
            pattern=self.plan.pattern,
            path=self.plan.path,
            loops_over=self.plan.loops_over,
            borne=enclosing.borne if abs(enclosing.borne) > enclosing.least else 0.0,
            falls=enclosing.fallen,
            trials=enclosing.trials,
            leg=enclosing.leg + 1,
            undecided=tally.undecided,
            falls_by_turning=tally.falls_by_turning,
            swayed=tally.swayed / trials.travels.size,
            freely=trials.freely,
            mechanism=trials.travels.relative(),
            travel=trials.catching.travel,
            caught=trials.catching.falls,
            later=trials.catching.later_within(self.plan.travel),
            branch=None if trials.branch is None else trials.branch.outcome(),
        )

    def state(self) -> State:
        """The trials, the phase, and what that has seen."""
        return {"trials": self.trials.state(), "phase": self.phase.name, "looks": self.phase.state()}

    def restore(self, state: State) -> None:
        """Go on from there."""
        self.trials.restore(state["trials"])
        self.phase = PHASES[state["phase"]](self.trials)
        self.phase.restore(state["looks"])

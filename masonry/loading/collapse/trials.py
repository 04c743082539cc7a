"""The trials of a load that grows: what its phases (phases.py) go by, and what they have found."""

import numpy as np

from masonry.configuration import energy, model_state
from masonry.configuration.chunk import Chunk
from masonry.configuration.configuration import configuration_of
from masonry.loading.collapse.branch import Branch
from masonry.loading.collapse.catching import Catching
from masonry.loading.collapse.enclosing import Enclosing
from masonry.loading.collapse.factor_path import FactorPath
from masonry.loading.collapse.growing_settings import GrowingSettings
from masonry.loading.collapse.pace import Pace
from masonry.loading.collapse.watching import FallWatch
from masonry.loading.loading import Loading
from masonry.loading.moves.moved import Arrays
from masonry.loading.moves.travels import Limits, Travels
from masonry.loading.varying_loads import SharedLoads
from masonry.model.gauges import Gauge
from masonry.model.model import Model
from masonry.monitors.settling import unbalanced
from masonry.rows.rest_criterion import RestCriterion
from masonry.runtime.state_file import Remembering, Remembers, attributes


class FactorLoad(Remembering):
    """The load that grows: its factor, and what that makes of the loads of the model.

    dead_load  share of the dead load, which stays     layers  how many of the loads, the first, have come on and stay
    """

    REMEMBERED = ("factor",)

    def __init__(self, model: Model, path: FactorPath, dead_load: float, layers: int) -> None:
        self.path, self.dead_load, self.loads, self.factor = path, dead_load, SharedLoads(model, layers), 0.0

    def pass_to(self, factor: float, steps: int, row: bool = False) -> Chunk:
        """Some steps in which the factor goes to another one."""
        dead_load = np.full(steps + 1, self.dead_load)
        varying = self.loads.pass_over(self.path.load_factors(self.factor), self.path.load_factors(factor), steps)
        self.factor = factor
        return Chunk(dead_load + varying, np.zeros(steps + 1), row)


class LastRest(Remembering):
    """Where the specimen rested last: copies of all that changes in a model, and the works of all forces then (J)."""

    REMEMBERED = ("copies", "works")

    def __init__(self, model: Model) -> None:
        self.model, self.works = model, energy.works(model)
        self.copies: Arrays = {}

    def keep(self) -> None:
        """It rests here."""
        self.copies, self.works = model_state.state(self.model), energy.works(self.model)

    def put_back(self) -> None:
        """Back to where it rested."""
        model_state.restore(self.model, self.copies)


class Tally(Remembering):
    """Counts of trials.

    steps    of the present one      slowest  the most that one took to come to rest
    swayed   m, the most that anything had moved at the last rest
    undecided, falls_by_turning  see CollapseOutcome
    """

    REMEMBERED = ("steps", "slowest", "swayed", "undecided", "falls_by_turning")

    def __init__(self, slowest: int) -> None:
        self.steps, self.slowest, self.swayed = 0, slowest, 0.0
        self.undecided, self.falls_by_turning = 0, False


class Trials(Remembering):
    """From a rest the factor is raised, and the specimen is watched until it rests again or falls.

    load, path      what is raised, and where to     settling  of the dead loads before
    rest, travels   where it rested last, and how far it has moved since
    enclosing       what was borne, what was not, what is tried     pace  how slowly, where the load goes to and fro
    watch           whether it falls     catching  what may end a fall
    branch          behind the collapse; None where no gauge is led
    freely          whether blocks turn as far as they like
    """

    def __init__(
        self,
        model: Model,
        load: FactorLoad,
        settling: Loading,
        branch: Branch | None,
        tally: Tally,
        gauges: tuple[Gauge, ...],
        settings: GrowingSettings,
        travel: float | None,
    ) -> None:
        """travel: m, after which what has not come to rest has fallen; None: as the settings say"""
        self.model, self.load, self.path, self.settling, self.settings = model, load, load.path, settling, settings
        limits = Limits(self.rest_level, settings.reading, settings.away, settings.usual)
        self.travels = Travels(model, limits, gauges)
        least = self.rest_level.force * load.loads.rest_over_each()
        self.enclosing, self.pace = Enclosing(self.path, least, settings), Pace(self.path.accuracy, settings)
        self.rest, self.watch, self.branch, self.tally = LastRest(model), FallWatch(model, settings), branch, tally
        self.catching = Catching(model, self.usual_travel if travel is None else travel)
        self.freely = configuration_of(model).any_size

    @property
    def rest_level(self) -> RestCriterion:
        """Below which the specimen rests, and the factor is borne."""
        return self.settings.rest.with_share(self.path.accuracy)

    @property
    def usual_travel(self) -> float:
        """m, after which what has not come to rest has fallen, where a scene does not say."""
        slack = max((element.slack for element in self.model.elements), default=0.0)
        return min(max(self.settings.far * self.travels.size, self.settings.slack * slack), self.travels.size)

    @property
    def window(self) -> int:
        """Looks by which patience is measured: a quarter of the slowest rest, or of a quarter of the settling."""
        return max(self.settings.window, self.tally.slowest // (4 * self.settings.look))

    @property
    def looks_of_rise(self) -> int:
        """Looks in which the factor rises to the one that is tried."""
        return round(self.pace.slower * self.window)

    def keep(self, fell: bool = False) -> None:
        """The specimen rests here: trials begin from here. fell: after a fall"""
        self.rest.keep()
        self.travels.rest(fell)
        self.catching.rest()

    def begin(self) -> None:
        """Set out for a higher factor."""
        self.enclosing.begin()
        self.travels.begin()
        self.watch.begin(self.window, self.travels.most)
        self.tally.steps = 0

    def look(self) -> None:
        """Take in how far all has moved."""
        self.tally.steps += self.settings.look
        self.travels.look()

    def bear(self) -> None:
        """The factor is borne: the next trial goes on from here."""
        if self.branch is not None:
            self.branch.learn(self.rest.copies, self.enclosing.target - self.enclosing.stands)
        self.enclosing.bear()
        if self.path.reversals:
            _, damped, work, *_ = energy.works(self.model) - self.rest.works
            self.pace.learn(work, -damped)
        self.tally.slowest = max(self.tally.slowest, self.tally.steps)
        self.tally.swayed = self.travels.sways()
        self.keep()

    def rests(self, before: list[np.ndarray], calm: int) -> tuple[bool, bool]:
        """Whether all rests, for the `calm`-th time on end; and whether the sum over all does, and a block or a gauge
        does not."""
        model, level = self.model, self.rest_level
        rests = unbalanced(model, before) <= level.force
        if rests:
            now = energy.observe(model)
            rests = abs(energy.kinetic(model, before)) <= level.energy * now.stored
        alone = rests and self.travels.moves_alone(before, calm)
        return rests and not alone, alone

    @property
    def leapt(self) -> bool:
        """Whether the rest to which the specimen has come is that of a fall, by how far it is from the last one, and as
        something bears that did not."""
        settings, travels = self.settings, self.travels
        far = max(settings.leaps * travels.size, settings.usual * travels.most)
        return travels.travelled > far and self.branch is None and self.catching.bears_anew()

    def catch(self) -> None:
        """The fall has come to rest: the next trial goes on from here."""
        enclosing, travels = self.enclosing, self.travels
        borne = enclosing.borne if abs(enclosing.borne) > enclosing.least else 0.0
        assert enclosing.fallen is not None
        self.catching.caught.append([borne, enclosing.fallen, travels.travelled, travels.first()])
        enclosing.catch()
        self.watch.drag()
        self.tally.swayed, self.tally.falls_by_turning = travels.sways(), False
        self.keep(fell=True)

    def push_on(self) -> None:
        """Load for a specimen that nothing resists, so that it falls where something may catch it."""
        if self.enclosing.stands <= self.enclosing.least:
            self.enclosing.target = max(self.enclosing.target, self.settings.first)

    def fail(self, turning: bool) -> None:
        """The factor is not borne; `turning`: as a block turned too far."""
        if self.enclosing.fail():
            self.tally.falls_by_turning = turning

    def can_lead(self) -> bool:
        """Whether a gauge can be led on behind the collapse that the specimen has just shown."""
        enclosing, branch = self.enclosing, self.branch
        return branch is not None and branch.begin(self.rest.copies, enclosing.stands, enclosing.falls)

    def put_back(self) -> None:
        """Back to where the specimen rested."""
        self.rest.put_back()
        self.watch.drag()
        self.load.factor = self.enclosing.borne

    def parts(self) -> dict[str, Remembers]:
        """All that the next chunk depends on."""
        names = ("settling", "load", "rest", "travels", "enclosing", "pace", "watch", "catching", "tally")
        return attributes(self, names) | ({} if self.branch is None else {"branch": self.branch})

"""A drive that is paced by its error: the plan, and how a run advances along it."""

from dataclasses import asdict, dataclass, replace

import numpy as np

from masonry.configuration.chunk import Chunk
from masonry.configuration.energy import Seen
from masonry.kinematics.motion import Guided
from masonry.loading.drive.path import DrivePath
from masonry.loading.drive.predictor import AT_FIRST, Predictor
from masonry.loading.drive.settings import SETTINGS, AdaptiveSettings
from masonry.loading.drive.utilisation import Dry, utilisation
from masonry.loading.loading import Expected, Loading, LoadingOutcome
from masonry.loading.plan import PacedPlan
from masonry.loading.schedule import smooth
from masonry.model.gauges import Gauge
from masonry.model.model import Model
from masonry.monitors.events import PARTED, Event, Events
from masonry.monitors.stability import LEAP, smallest_block
from masonry.runtime.state import State, attributes, load_attributes

REMEMBERED = (
    *("speed", "made", "used", "target", "steps", "increments", "most_stored", "stored", "broken", "most_force"),
    *("settled_force", "damped", "work", "elastic", "rest", "step", "held", "calm", "finished", "cruise"),
    *("place", "force", "farthest"),
)
"""Numbers of a paced drive that the next increment depends on."""
RESTART = 0.25
"""Speed after a turn over the speed at which the drive came to it."""
CURVED = 100
"""Increments of a leg between turns, at least, where all that moves is prescribed: cheap, and they show the corners."""
PRESCRIBED = 110
"""Increments of a path or a leg that a run takes where the drive prescribes all that moves, whatever the accuracy."""
TRAVEL, CRACKS = 9000, 220.0
"""Steps that a drive takes which goes one way, and over the accuracy besides. Measured, as what follows: walls and
couplets of the paper, with rigid blocks and others, at 0.1 to 5 %: from 0.4 times as many to 1.6 times in single
cases."""
LEG, WIDER = 3000, 200.0
"""Steps of each leg of a drive that turns back; and over the accuracy, for coming to places where it has not been, as
far on one side as the farthest place of all."""


@dataclass(frozen=True)
class Controlled(PacedPlan):
    """A drive paced by its error: displacement (m, signed) and accuracy (0.01 is 1 %).

    reversals  places (m, signed) that the drive visits one after the other, in place of going to its displacement
    """

    displacement: float
    accuracy: float
    reversals: tuple[float, ...] = ()

    hurries_while_elastic = True

    def settling_damping(self, damping: float | Guided | None) -> Guided:
        """That of the run, before the first increment is made."""
        return AT_FIRST

    def expected(self, model: Model, rows: int, axis: int | None) -> Expected:
        """About: each increment writes a row."""
        prescribed = prescribes_all(model, axis)
        steps = self.expected_steps(model, prescribed)
        settling = min(max(1, rows // SETTINGS.settling_rows), self.settle)
        of_increment = SETTINGS.few_steps if prescribed else SETTINGS.steps
        return Expected(self.settle + round(steps), settling + round(steps / of_increment))

    def expected_steps(self, model: Model, prescribed: bool) -> float:
        """Steps after the settling."""
        places = np.array(self.reversals or (self.displacement,))
        if prescribed:
            return PRESCRIBED * SETTINGS.few_steps * len(places)
        if self.reversals:
            reach = [np.maximum(side, 0.0).max() for side in (places, -places)]
            return float(LEG * len(places) + WIDER / self.accuracy * sum(reach) / max(reach))
        deformable = any(len(model.layout.members[kind]) for kind in ("affine", "tets"))
        return TRAVEL + CRACKS / (self.accuracy * (SETTINGS.deformable if deformable else 1.0))

    def loading(self, model: Model, rows: int, gauges: tuple[Gauge, ...] = ()) -> "AdaptiveLoading":
        """One increment after the other, each as large as the accuracy allows."""
        return AdaptiveLoading(model, self, rows)


def prescribes_all(model: Model, axis: int | None) -> bool:
    """Whether a drive along an axis leaves nothing to swing: blocks are free to shift across it at most, and no joint
    dilates."""
    if axis is None or any(joint.tan_dilation is not None for joint in model.groups.properties):
        return False
    across = [i for i in range(3) if i != axis]
    swinging = {kind: np.array(mass > 0.0) for kind, mass in model.masses.items()}
    for kind in ("rigid", "affine"):
        swinging[kind][:, across] = False
    return not any(free.any() for free in swinging.values())


@dataclass(frozen=True)
class AdaptiveOutcome(LoadingOutcome):
    """What was asked for, and what was reached after the first damage: lags over the work done, their mean over the
    path, and the share of the largest force that damping took where that force was reached; none if that was before
    the drive."""

    accuracy: float
    increments: int
    mean_lag: float
    largest_lag: float
    drag_at_peak: float

    def control(self) -> dict[str, float]:
        """All of it."""
        return asdict(self)


class AdaptiveLoading(Loading):
    """Smooth increments of the drive, as large as the accuracy allows.

    Between two increments the speed changes by a quintic. How fast it becomes follows from what the last increment
    brought: larger increments while elastic, smaller ones while cracking. A drive that turns back goes leg by leg, at
    rest at each turn; what else is measured against the way or the force of the test is measured against the largest so
    far then, as the force may pass through zero, and the drive through its start.
    """

    def __init__(self, model: Model, plan: Controlled, rows: int, settings: AdaptiveSettings = SETTINGS) -> None:
        self.settings = settings
        self.model, self.dt, self.plan, self.guide = model, model.dt, plan, Predictor(model)
        self.settling = plan.settling().loading(model, max(1, rows // self.settings.settling_rows))
        self.path = DrivePath(plan.reversals or (plan.displacement,))
        self.unit = min(plan.accuracy, self.settings.fine * (plan.accuracy / self.settings.fine) ** self.settings.blunt)
        if len(model.layout.members["affine"]) or len(model.layout.members["tets"]):
            self.unit *= self.settings.deformable
        self.leap = 0.5 * LEAP * smallest_block(model) / model.dt
        self.target, self.steps = self.at_once * settings.first, settings.steps
        self.speed = self.made = self.used = self.place = self.force = self.farthest = 0.0
        self.most_stored = self.stored = self.broken = self.most_force = self.damped = self.work = 0.0
        self.settled_force = 0.0
        self.increments = 0
        self.elastic, self.dry = True, Dry(model, settings)
        self.rest = np.zeros(len(model.group))
        self.step, self.cracks = 0, Events(model)
        self.held = self.calm = 0
        self.finished, self.cruise = False, 0.0
        self.looks: list[tuple[float, float, float, float]] = []

    @property
    def at_once(self) -> float:
        """Speed (m/s) that makes a leg in one increment."""
        return self.path.goal / (self.settings.steps * self.dt)

    @property
    def slowest(self) -> float:
        """Speed (m/s) below which the drive does not go."""
        return min(self.at_once / self.settings.finest, self.dry.shortest(self.path.moved) / (self.steps * self.dt))

    def next(self) -> Chunk | None:
        """The next increment; None when the displacement is made and the specimen at rest."""
        waiting = self.settling.next()
        if waiting is not None:
            return waiting
        if self.path.left <= 1e-12 * self.path.goal and not self.turn():
            return self.finish()
        if self.held:
            return self.hold()
        left, cruise = self.path.left, self.steps * self.dt
        if self.speed > 0.0 and left < (0.5 * (self.speed + self.target) + 0.5 * self.target) * cruise:
            return self.stop(left)
        self.cruise = self.target
        return self.made_of(self.speed + (self.target - self.speed) * smooth(np.arange(self.steps + 1) / self.steps))

    def stop(self, left: float) -> Chunk:
        """The last increment of a way: as many steps as bring the speed down to rest at its end."""
        steps = max(2, round(2.0 * left / (self.speed * self.dt)))
        speed = self.speed * (1.0 - smooth(np.arange(steps + 1) / steps))
        first, whole = speed[0] * self.dt, float(speed[:-1].sum()) * self.dt
        speed[1:] *= (left - first) / (whole - first)
        chunk = self.made_of(speed)
        self.path.moved = self.path.goal
        return replace(chunk, place=self.path.end)

    def made_of(self, speed: np.ndarray) -> Chunk:
        """Book an increment of these speeds (n + 1,) m/s along the way."""
        self.made = float(speed[:-1].sum()) * self.dt
        self.path.moved += self.made
        self.speed = float(speed[-1])
        self.increments += 1
        return Chunk(np.full(len(speed), self.plan.dead_load[-1]), self.path.sign * speed, True)

    def hold(self) -> Chunk:
        """Some steps in which the drive comes to rest, or stays there."""
        return self.made_of(self.speed * (1.0 - smooth(np.arange(self.steps + 1) / self.steps)))

    def turn(self) -> bool:
        """Set out for the next place, slowly; False where there is none."""
        if not self.path.turn():
            return False
        whole = self.path.goal / (self.steps * self.dt)
        fastest = min(whole / self.settings.coarsest, self.leap)
        self.target = float(np.clip(RESTART * self.cruise, whole * self.settings.first, fastest))
        return True

    def finish(self) -> Chunk | None:
        """The end of the run: the drive is held until the specimen rests, so that the last row is an equilibrium."""
        if not self.finished:
            self.finished, self.held, self.calm = True, 1, 0
        return self.hold() if self.held else None

    def feel(self, step: int, before: list[np.ndarray]) -> None:
        """Each increment is a row, and is looked at there."""
        self.step = step

    def look(self, force: float, support: float, seen: Seen, terms: dict[str, float]) -> None:
        """Choose the next speed by the forces of drive and support (N), what contacts show, and the ledger (J)."""
        stored = terms["elastic_blocks"] + terms["elastic_contacts"]
        broken = terms["fracture_mode_1"] + terms["fracture_mode_2"]
        if self.increments == 0:
            self.stored = self.most_stored = stored
            self.rest, self.force, self.settled_force = seen.sigma.copy(), force, abs(force)
            self.used = utilisation(self.model, seen, self.rest)
            self.guide.settle()
            if self.model.dry:
                self.dry.begin()
                self.elastic, self.target = False, self.slowest
            return
        self.most_stored = max(self.most_stored, stored, 1e-300)
        self.most_force = max(self.most_force, abs(force), 1e-300)
        self.work += abs(force) * self.made
        if self.held:
            self.wait(force, abs(terms["kinetic"]) <= self.settings.at_rest * max(stored, PARTED * self.most_stored))
        else:
            self.go_on(force, support, seen, terms)
        if self.plan.reversals and self.steps == self.settings.few_steps:
            self.target = min(self.target, self.path.goal / (CURVED * self.steps * self.dt))
        self.stored, self.broken, self.damped = stored, broken, self.dry.damping(terms, self.guide)

    def wait(self, force: float, at_rest: bool) -> None:
        """The drive is held: let it go where the specimen has come to rest. What moved meanwhile is not the drive's."""
        self.cracks.sudden(self.step)
        self.calm = self.calm + 1 if at_rest else 0
        self.held += 1
        if self.calm >= self.settings.looks or self.held > self.settings.longest_hold:
            self.held = 0
            self.target = min(self.target, 0.5 * self.path.left / (self.steps * self.dt))
            self.settle(force)
            self.cracks.calm(self.step)

    def go_on(self, force: float, support: float, seen: Seen, terms: dict[str, float]) -> None:
        """Choose the next speed, or hold the drive."""
        stored = terms["elastic_blocks"] + terms["elastic_contacts"]
        broken = terms["fracture_mode_1"] + terms["fracture_mode_2"]
        rise = abs(force - self.force)
        self.learn(force)
        used = utilisation(self.model, seen, self.rest)
        self.elastic = self.elastic and used < 1.0 and broken <= self.settings.intact * self.most_stored
        if self.elastic:
            factor = self.towards_damage(used)
        else:
            factor = self.through_damage(stored, broken, force, support, terms)
            if self.model.dry:
                factor = min(factor, self.dry.factor(rise / self.most_force, self.unit))
        if (
            self.elastic
            or self.guide.trust > self.settings.unexpected
            or abs(terms["kinetic"]) <= self.settings.at_rest * stored
        ):
            self.cracks.calm(self.step)
        else:
            self.cracks.sudden(self.step)
            self.held = int(self.speed * self.steps * self.dt < self.path.left)
            self.calm = 0
        self.steps = (
            self.settings.few_steps if abs(terms["kinetic"]) <= self.settings.still * stored else self.settings.steps
        )
        fastest = min(self.path.goal / (self.settings.coarsest * self.steps * self.dt), self.leap)
        self.target = float(np.clip(self.target * factor, self.slowest, fastest))

    def learn(self, force: float) -> None:
        """Let the guide see where the drive has come to, and its force (N). Where the drive turns back, the stiffness
        is that of the last increment: that of all the way may be anything, as both ends pass through zero."""
        place = self.path.place
        self.farthest = max(self.farthest, abs(place))
        stiffness = self.dry.stiffness(self.farthest, abs(force)) if self.model.dry else None
        if stiffness is None and self.plan.reversals:
            stiffness = max(abs((force - self.force) / (place - self.place)), self.most_force / self.farthest)
        self.place, self.force = place, force
        self.guide.learn(place, self.path.sign * self.speed, force, stiffness)

    def settle(self, force: float) -> None:
        """The specimen stands where it stands, and the drive exerts a force (N)."""
        self.place, self.force = self.path.place, force
        self.guide.settle(self.place)

    def towards_damage(self, used: float) -> float:
        """Factor of the speed while the contacts use a share `used` of their strength, which grows with the way. On the
        way back it falls before it grows: as fast, at most, as it fell."""
        if self.plan.reversals and used < self.used:
            self.used = used - (self.used - used)
        left = self.made * max(1.0 - used, 0.0) / max(used - self.used, 1e-9)
        self.used = used
        travel = max(self.settings.approach * left, self.unit * self.path.moved)
        most = self.settings.rise if self.increments > self.settings.learning else 1.0
        return float(np.clip(travel / (self.steps * self.dt * self.target), self.settings.fall, most))

    def through_damage(
        self, stored: float, broken: float, force: float, support: float, terms: dict[str, float]
    ) -> float:
        """Factor of the speed by what the last increment brought; forces of drive and support in N.

        The drive runs ahead of the specimen by about v / w, where w is the frequency of the expected motion, so the
        force of the drive does work too early: F v / w = 2 sqrt(K W) of kinetic energy K (expected) and stored W, as
        far as the drive has brought it.
        """
        change = abs(stored - self.stored) / self.most_stored
        fracture = (broken - self.broken) / self.most_stored
        lag = 2.0 * np.sqrt(self.guide.kinetic * min(abs(stored), self.work)) / max(self.work, 1e-300)
        least = max(PARTED * self.most_stored, self.work if self.model.dry else 0.0)
        sway = np.sqrt(abs(terms["kinetic"]) / max(abs(stored), least))
        curve = self.settings.curve * min(self.plan.accuracy / self.settings.fine, 1.0)
        unit = max(self.unit, curve) if self.steps == self.settings.few_steps else self.unit
        brought = max(change / self.settings.stored, fracture / self.settings.fracture, 1e-12) / unit
        ends = abs(force - support) / self.most_force
        taken, most_work = abs(self.dry.damping(terms, self.guide) - self.damped), self.most_force * self.made
        drag = taken / most_work
        freed = max(self.stored - stored - (broken - self.broken), 0.0)  # by a sudden crack, whose damping is no drag
        self.looks.append((float(lag), self.made, float(max(taken - freed, 0.0) / most_work), abs(force)))
        ratios = (
            lag / self.settings.lag,
            sway / self.settings.sway,
            ends / self.settings.ends,
            drag / self.settings.drag,
        )
        excess = max(np.sqrt(brought), *(ratio / self.unit for ratio in ratios))
        return float(np.clip(1.0 / excess, self.settings.slower, self.settings.faster))

    def load_factors(self) -> np.ndarray:
        """(L,) of the loads that come on in layers, now; no other load varies."""
        return self.settling.load_factors()

    def progress(self) -> tuple[int, int]:
        """How far the way is made, in millionths."""
        return int(1e6 * self.path.progress + 1e-3), 1_000_000

    @property
    def events(self) -> list[Event]:
        """The sudden cracks so far."""
        return self.cracks.found

    def outcome(self) -> "AdaptiveOutcome":
        """How far the drive ran ahead, and what damping took."""
        lag, travel, drag, force = np.array(self.looks or [(0.0, 1.0, 0.0, 0.0)]).T
        peak = int(np.argmax(force))
        return AdaptiveOutcome(
            accuracy=self.plan.accuracy,
            increments=self.increments,
            mean_lag=float(lag @ travel / max(travel.sum(), 1e-300)),
            largest_lag=float(lag.max()),
            drag_at_peak=float(drag[max(peak - 1, 0) : peak + 1].max()) if force[peak] > self.settled_force else 0.0,
        )

    def state(self) -> State:
        """All that the next speed depends on."""
        return {
            **attributes(self, REMEMBERED),
            "path": attributes(self.path, DrivePath.REMEMBERED),
            "looks": np.array(self.looks).reshape(-1, 4),
            "cracks": self.cracks.state(),
            "settling": self.settling.state(),
            "guide": self.guide.state(),
            "dry": attributes(self.dry, Dry.REMEMBERED),
        }

    def restore(self, state: State) -> None:
        """Go on from there."""
        load_attributes(self, REMEMBERED, state)
        load_attributes(self.path, DrivePath.REMEMBERED, state["path"])
        self.looks = [(lag, travel, drag, force) for lag, travel, drag, force in state["looks"].tolist()]
        self.cracks.restore(state["cracks"])
        self.settling.restore(state["settling"])
        self.guide.restore(state["guide"])
        load_attributes(self.dry, Dry.REMEMBERED, state["dry"])

"""A drive that is paced by its error: the plan, and how a run advances along it."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace
from math import cbrt, inf, sqrt

import numpy as np

from masonry.configuration.chunk import Chunk
from masonry.configuration.energy import Seen
from masonry.loading.drive.adaptive_settings import SETTINGS, AdaptiveSettings
from masonry.loading.drive.approach import Approach
from masonry.loading.drive.borne import BorneForce
from masonry.loading.drive.bounds import Bounds, DragLook
from masonry.loading.drive.increments import DriveRow, Increments
from masonry.loading.drive.path import DrivePath
from masonry.loading.drive.pause import DrivePause
from masonry.loading.drive.predictor import AT_FIRST, Predictor
from masonry.loading.drive.speed import DriveSpeed
from masonry.loading.drive.utilisation import Dry, utilisation
from masonry.loading.loading import Expected, Loading, LoadingOutcome
from masonry.loading.plan import PacedPlan
from masonry.loading.scheduled import LONGEST_CHUNK
from masonry.model.damping import Damping
from masonry.model.gauges import Gauge
from masonry.model.model import Model
from masonry.monitors.events import PARTED, Event
from masonry.rows.columns import EXCESS
from masonry.runtime.progress import Effort
from masonry.runtime.state_file import Remembers, attributes

RESTART = 0.25
"""Speed after a turn over the speed at which the drive came to it."""
CURVED = 100
"""Increments of a leg between turns, at least, where all that moves is prescribed: cheap, and they show the corners."""
PRESCRIBED = 110
"""Increments of a path or a leg that a run takes where the drive prescribes all that moves, whatever the accuracy."""
TRAVEL, CRACKS, REACH = 9000, 220.0, 5e-4
"""Steps that a drive takes along a path (m) of so much, and over the accuracy besides: with the root of shorter paths,
as increments grow with what is made of them, and the cube root of longer ones, as most has cracked by then. Measured on
all scenes that are shipped and those of the verification, from 0.02 to 30 mm, there and back or one way, rigid or not,
at 0.1 to 5 %."""
MANY_JOINTS, FEW_JOINTS = 300, 0.5
"""Joints (pairs of blocks) of which fewer have fewer cracks to wait for: steps go with the root of their number, as
measured on one wall with 32, 98, 200 and 390; and the least share of the steps, where there are few."""
STACK, CRUSHED = 5000, 52.0
"""Steps, and over the accuracy besides, of a stack that is pressed until it crushes: nothing snaps there, however long
the path is."""
FEWER, MORE, FEWER_PRESCRIBED, MORE_PRESCRIBED = 0.35, 1.8, 0.7, 1.4
"""Times as many in single cases."""
ACROSS = 0.999
"""Least cosine between a drive and the normal of a joint that lies across it."""
ROUNDING = 1e-12
"""Of the energy stored: what inertia takes over an increment is less where nothing resists the drive."""
SOONER, LATER = 0.35, 2.3
"""Of the steps that are left by the root of the path: those in nine of ten cases, as cracks come early or late."""


@dataclass(frozen=True)
class Controlled(PacedPlan):
    """A drive paced by its error: displacement (m, signed) and accuracy (0.01 is 1 %).

    reversals  places (m, signed) that the drive visits one after the other, in place of going to its displacement
    """

    displacement: float
    accuracy: float
    reversals: tuple[float, ...] = ()

    hurries_while_elastic = True

    def settling_damping(self, damping: Damping) -> Damping:
        """That of the run, before the first increment is made."""
        return AT_FIRST

    def expected(self, model: Model, rows: int, axis: int | None) -> Expected:
        """About: each increment writes a row."""
        prescribed = prescribes_all(model, axis)
        moving = self.expected_steps(model, axis, prescribed)
        steps, increments = self.settle + round(moving), moving / (SETTINGS.few_steps if prescribed else SETTINGS.steps)
        settling = min(max(1, rows // SETTINGS.settling_rows), self.settle)
        chunks = increments + max(settling, self.settle / LONGEST_CHUNK)
        fewer, more = (FEWER_PRESCRIBED, MORE_PRESCRIBED) if prescribed else (FEWER, MORE)
        least, most = ((self.settle + share * moving) / steps for share in (fewer, more))
        return Expected(steps, settling + round(increments), chunks, least=least, most=most)

    def expected_steps(self, model: Model, axis: int | None, prescribed: bool) -> float:
        """Steps after the settling, of a drive along an axis."""
        places = np.array(self.reversals or (self.displacement,))
        if prescribed:
            return PRESCRIBED * SETTINGS.few_steps * len(places)
        if is_pressed_stack(model, axis, float(places[0])):
            return (STACK + CRUSHED / self.accuracy) * len(places)
        deformable = any(len(model.layout.members[kind]) for kind in ("affine", "tets"))
        path = float(np.abs(np.diff(places, prepend=0.0)).sum()) / REACH
        cracks = CRACKS / (self.accuracy * (SETTINGS.deformable if deformable else 1.0))
        return (TRAVEL + cracks) * min(sqrt(path), cbrt(path)) * share_of_cracks(model)

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


def is_pressed_stack(model: Model, axis: int | None, towards: float) -> bool:
    """Whether a drive towards one end of an axis presses joints that all lie across it, and some of them may crush."""
    joints, layout = model.joints, model.layout
    if axis is None or all(joint.compressive_strength is None for joint in model.groups.properties):
        return False
    rigid, affine, _ = (None if dofs is None else np.unique(dofs[:, 0]) for dofs in model.drives)
    rows = {"rigid": rigid, "affine": affine}
    driven = [layout.members[kind][row] for kind, row in rows.items() if row is not None]
    if not driven or not (np.abs(joints.normal[:, axis]) > ACROSS).all():
        return False
    place = layout.centroid[np.concatenate(driven), axis].mean()
    return bool((joints.point[:, axis].mean() - place) * towards > 0.0)


def share_of_cracks(model: Model) -> float:
    """Of the steps that many joints with a strength in tension take; all of them where none has any."""
    strengths = [joint.tensile_strength for joint in model.groups.properties]
    if not any(strength is not None and np.any(strength) for strength in strengths):
        return 1.0
    joined = len(np.unique(np.column_stack([model.joints.block_a, model.joints.block_b]), axis=0))
    return float(np.clip(sqrt(joined / MANY_JOINTS), FEW_JOINTS, 1.0))


@dataclass(frozen=True)
class AdaptiveOutcome(LoadingOutcome):
    """Accuracy asked for, and that reached after the first damage: lags over the work done, their mean over the path;
    the share of the largest force that damping took where that was reached, with dry contacts inertia as well, none if
    that was before the drive; and by how much the force exceeded what was borne, at most, over the peak."""

    accuracy: float
    increments: int
    mean_lag: float
    largest_lag: float
    drag_at_peak: float
    largest_excess: float

    def control(self) -> dict[str, float]:
        """All of it."""
        return asdict(self)


class AdaptiveLoading(Loading):
    """Smooth increments of the drive, as large as the accuracy allows.

    Between two increments the speed changes by a quintic. How fast it becomes follows from what the last increment
    brought: larger increments while elastic, smaller ones while cracking. A drive that turns back goes leg by leg, at
    rest at each turn; what else is measured against the path or the force of the test is measured against the largest
    so far then, as the force may pass through zero, and the drive through its start.
    """

    def __init__(self, model: Model, plan: Controlled, rows: int, settings: AdaptiveSettings = SETTINGS) -> None:
        self.model, self.plan, self.settings = model, plan, settings
        self.settling = plan.settling().loading(model, max(1, rows // settings.settling_rows))
        self.path, self.speed = DrivePath(plan.reversals or (plan.displacement,)), DriveSpeed(model, settings)
        self.speed.target = self.at_once * settings.first
        self.guide, self.dry = Predictor(model), Dry(model, settings, plan.accuracy)
        self.approach, self.bounds = Approach(model), Bounds(model, plan.accuracy, settings)
        self.increments = Increments(BorneForce(model, plan.accuracy, self.path.sign))
        self.pause = DrivePause(model, settings)

    @property
    def at_once(self) -> float:
        """Speed (m/s) that makes a leg in one increment."""
        return self.path.goal / (self.settings.steps * self.model.dt)

    @property
    def slowest(self) -> float:
        """Speed (m/s) below which the drive does not go."""
        return min(self.at_once / self.settings.finest, self.dry.shortest(self.path.moved) / self.speed.duration)

    def next(self) -> Chunk | None:
        """The next increment; None when the path is made and the specimen at rest."""
        settling = self.settling.next()
        if settling is not None:
            return settling
        if len(self.speed.pending):
            return self.piece()
        if self.path.left <= 1e-12 * self.path.goal and not self.turn():
            return self.increment(self.speed.to_rest()) if self.pause.at_end() else None
        if self.pause.increments:
            return self.increment(self.speed.to_rest())
        if self.speed.must_stop(self.path.left):
            stop = self.increment(self.speed.to_stop(self.path.left), in_one=True)
            self.path.moved = self.path.goal
            return replace(stop, place=self.path.end)
        return self.increment(self.speed.to_target())

    def increment(self, speed: np.ndarray, in_one: bool = False) -> Chunk:
        """Book an increment of these speeds (n + 1,) m/s along the path, and make it, or its first piece."""
        self.increments.book(float(speed[:-1].sum()) * self.model.dt)
        self.path.moved += self.increments.made
        self.speed.now, self.speed.pending = float(speed[-1]), speed
        return self.piece(in_one)

    def piece(self, in_one: bool = False) -> Chunk:
        """Rest of an increment; as much at a time as is looked at, where the force may be the largest."""
        in_one = in_one or self.approach.elastic or self.speed.takes_few_steps or bool(self.plan.reversals)
        in_one = in_one or not self.increments.borne.may_be_highest
        speed = self.speed.piece(1 if in_one else self.settings.looks)
        whole = not len(self.speed.pending)
        return Chunk(np.full(len(speed), self.plan.dead_load[-1]), self.path.sign * speed, whole)

    def turn(self) -> bool:
        """Set out for the next place, slowly; False where there is none."""
        if not self.path.turn():
            return False
        whole = self.path.goal / self.speed.duration
        fastest = min(whole / self.settings.coarsest, self.speed.leap)
        self.speed.target = float(np.clip(RESTART * self.speed.cruise, whole * self.settings.first, fastest))
        return True

    def feel(self, step: int, before: list[np.ndarray]) -> None:
        """Each increment is a row, and is looked at there."""
        self.pause.step = step

    def counted(self, before: list[np.ndarray], path: np.ndarray, force: np.ndarray) -> np.ndarray:
        """So much as is borne, once the drive has set out."""
        if self.increments.count == 0:
            return force
        borne, speed = self.increments.borne, self.path.sign * self.speed.arrives_at
        borne.feel(before, speed, float(force[-1]), self.increments.most_force)
        return borne.count(path, force)

    def columns(self) -> dict[str, float]:
        """Part of the force that is not borne."""
        return {EXCESS: abs(self.increments.borne.excess)}

    def look(self, force: float, support: float, seen: Seen, terms: dict[str, float]) -> None:
        """Choose the next speed by the forces of drive and support (N), what contacts show, and the ledger (J)."""
        row = DriveRow.of(force, support, seen, terms, self.increments.borne.excess)
        if self.increments.count == 0:
            self.begin(row)
            return
        self.increments.see(row)
        if self.pause.increments:
            self.wait(row)
        else:
            self.go_on(row)
        if self.plan.reversals and self.speed.takes_few_steps:
            self.speed.target = min(self.speed.target, self.path.goal / (CURVED * self.speed.steps * self.model.dt))
        self.increments.close(row, self.dry.damping(row.damped, self.guide))

    def begin(self, row: DriveRow) -> None:
        """The dead loads have settled."""
        self.increments.begin(row)
        self.approach.begin(row.seen)
        self.guide.settle()
        if self.model.dry:
            self.dry.begin()
            self.approach.elastic, self.speed.target = False, self.slowest

    def wait(self, row: DriveRow) -> None:
        """The drive is held: let it go where the specimen has come to rest."""
        stored = max(row.stored, PARTED * self.increments.most_stored)
        if self.pause.look(abs(row.kinetic) <= self.settings.rest.energy * stored):
            self.speed.target = min(self.speed.target, 0.5 * self.path.left / self.speed.duration)
            self.increments.place, self.increments.force = self.path.place, row.force
            self.guide.settle(self.path.place)

    def go_on(self, row: DriveRow) -> None:
        """Choose the next speed, or hold the drive."""
        settings, approach, last = self.settings, self.approach, self.increments
        rise = abs(row.force - last.force)
        self.learn(row.force)
        used = utilisation(self.model, row.seen, approach.rest) if approach.elastic else 1.0
        approach.elastic = used < 1.0 and row.broken <= settings.intact * last.most_stored
        if approach.elastic:
            factor = self.towards_damage(used)
        else:
            damped = self.dry.damping(row.damped, self.guide)
            factor = self.bounds.factor(row, last, self.guide.kinetic, damped, self.speed.takes_few_steps)
            if self.model.dry:
                self.dry.see(row.force, self.guide.trust)
                factor = min(factor, self.dry.factor(rise / last.most_force, self.bounds.unit))
            taken = last.borne.taken()
            if taken * last.made > ROUNDING * row.stored:
                ratio = max(taken / last.most_force, 1e-12)
                factor = min(factor, max(settings.inertia * self.bounds.unit / ratio, settings.slower))
        follows = approach.elastic or self.guide.trust > settings.unexpected
        follows = follows or abs(row.kinetic) <= settings.rest.energy * row.stored
        self.pause.follow(follows, waits=self.speed.now * self.speed.steps * self.model.dt < self.path.left)
        still = abs(row.kinetic) <= settings.still * row.stored
        self.speed.steps = settings.few_steps if still else settings.steps
        self.speed.change(factor, self.slowest, self.path.goal)

    def learn(self, force: float) -> None:
        """Let the guide see where the drive has come to, and its force (N). Where the drive turns back, the stiffness
        is that of the last increment: that of all the path may be anything, as both ends pass through zero."""
        place, last = self.path.place, self.increments
        last.farthest = max(last.farthest, abs(place))
        stiffness = self.dry.stiffness(last.farthest, abs(force)) if self.model.dry else None
        if stiffness is None and self.plan.reversals:
            stiffness = max(abs((force - last.force) / (place - last.place)), last.most_force / last.farthest)
        last.place, last.force = place, force
        self.guide.learn(place, self.path.sign * self.speed.now, force, stiffness)

    def towards_damage(self, used: float) -> float:
        """Factor of the speed while the contacts use a share `used` of their strength."""
        settings, left = self.settings, self.approach.left(used, self.increments.made, bool(self.plan.reversals))
        travel = max(settings.approach * left, self.bounds.unit * self.path.moved)
        most = settings.rise if self.increments.count > settings.learning else 1.0
        return float(min(max(travel / (self.speed.duration * self.speed.target), settings.fall), most))

    def load_factors(self) -> np.ndarray:
        """(L,) of the loads that come on in layers, now; no other load varies."""
        return self.settling.load_factors()

    def progress(self) -> tuple[int, int]:
        """How far the path is made, in millionths."""
        return int(1e6 * self.path.progress + 1e-3), 1_000_000

    def effort(self) -> Effort:
        """The root of the path: see REACH. Before the first damage the drive hurries, and nobody knows how long."""
        done = sqrt(self.path.progress)
        return Effort(done, SOONER * (1.0 - done), inf if self.approach.elastic else LATER * (1.0 - done))

    @property
    def events(self) -> list[Event]:
        """The sudden cracks so far."""
        return self.pause.cracks.events

    def outcome(self, peak: float) -> AdaptiveOutcome:
        """How far the drive ran ahead, and what damping took."""
        lag, travel, drag, force = np.array(self.bounds.looks or [DragLook(0.0, 1.0, 0.0, 0.0)]).T
        towards = -1.0 if (*self.plan.reversals, self.plan.displacement)[0] < 0.0 else 1.0
        highest = int(np.argmax(towards * force))
        held_up = float(drag[max(highest - 1, 0) : highest + 1].max())
        if highest >= len(force) - len(self.dry.rows):  # else bonds bore the peak, before patches took their place
            held_up = max(held_up, self.dry.excess(peak))
        return AdaptiveOutcome(
            accuracy=self.plan.accuracy,
            increments=self.increments.count,
            mean_lag=float(lag @ travel / max(travel.sum(), 1e-300)),
            largest_lag=float(lag.max()),
            drag_at_peak=held_up if towards * (force[highest] - self.increments.settled_force) > 0.0 else 0.0,
            largest_excess=self.increments.borne.largest_excess / max(abs(peak), 1e-300),
        )

    def parts(self) -> Mapping[str, Remembers]:
        """All that the next speed depends on."""
        names = ("settling", "path", "speed", "guide", "dry", "approach", "bounds", "increments", "pause")
        return attributes(self, names)

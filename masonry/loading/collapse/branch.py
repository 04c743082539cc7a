"""The branch behind the collapse: the factor of a load is led so that a gauge moves on steadily, near to equilibrium.

The specimen falls as a mechanism m: s'' = g (factor - balance) for the gauge's travel s. The gain is
g = (c.m)(p.m) / (m.M m), with the gauge's weights c, the load p at a factor of 1 and the masses M; m is what fell. From
the last rest on a servo gives the factor such that s grows at a constant acceleration, s'' = a = aim * collapse
factor * g. So the factor exceeds equilibrium by the share `aim` of the collapse factor, and the branch takes the time
root(2 far / a) = root(2 / aim) root(far / (g * collapse factor)), the second root being the time of the fall itself:
half the error takes 1.4 times the steps.
"""

from math import exp, sqrt

import numpy as np

from masonry.configuration import energy
from masonry.loading.collapse.factor_path import FactorPath
from masonry.loading.collapse.outcome import BranchOutcome
from masonry.loading.collapse.settings import FALLING, FallingSettings
from masonry.loading.loading import Arrays
from masonry.loading.moves.drift import Drift
from masonry.loading.moves.moved import dofs, kept_dofs, moved_since, reach
from masonry.loading.varying_loads import works_of
from masonry.model.gauges import Gauge
from masonry.model.model import Model
from masonry.monitors.stability import smallest_block
from masonry.runtime.state import State, attributes, load_attributes

REMEMBERED = (
    *("ends", "due", "look", "sense", "start", "gain", "rate", "swing", "scale", "most_steps", "steps", "rows"),
    *("leaps", "leaping", "travel", "speed", "target", "pace", "balance", "factor", "earlier", "damping"),
    *("works", "work", "lost", "off", "worst", "near"),
)
UNTIL, ZERO, MOST, AWAY, TURNED, LATE = "until", "zero", "up_to", "runs away", "turned", "late"
"""How a branch ends: the gauge is where it was to be led to; the factor is 0; or the greatest that the scene allows;
the gauge runs away although nothing pushes; a block has turned further than small displacement allows; it takes too
long."""
STAYS, OTHER_DIRECTION, NOTHING, PASSED = "stays", "other way", "nothing", "passed"
"""Why there is none: the collapse hardly moves the gauge, or moves it the other way; nothing resists the load; at the
last rest the gauge reads more than that to which it is to be led."""


class Falling:
    """Leads a factor, look by look.

    led     whether there is a branch, from the moment on that `begin` finds one
    look    steps from one look to the next     factor  at its end     row_due  whether a row is due then
    ends    how the branch has ended, or why there is none; "" as long as it goes on
    off     fraction of the collapse factor that damping and inertia took since the row before: how far the factor of a
            row is from equilibrium
    """

    def __init__(
        self, model: Model, path: FactorPath, gauge: Gauge, until: float, settings: FallingSettings = FALLING
    ) -> None:
        """until: the reading (m) to which the gauge is led"""
        self.model, self.path, self.gauge, self.settings = model, path, gauge, settings
        self.until, self.ends, self.due = until, "", False
        self.size = max(float(np.ptp(model.layout.centroid, axis=0).max()), smallest_block(model))
        self.sense = self.start = self.gain = self.rate = self.swing = self.scale = 0.0
        self.look, self.most_steps, self.steps, self.rows, self.leaps = settings.longest, 0, 0, 0, 0
        self.travel = self.speed = self.target = self.pace = 0.0
        self.balance = self.factor = self.earlier = 0.0
        self.leaping, self.usual = False, model.damping
        self.damping = self.usual
        self.works = np.zeros(0)
        self.work = self.lost = self.off = self.worst = self.near = 0.0
        self.drift: Drift | None = None

    @property
    def led(self) -> bool:
        return self.drift is not None

    @property
    def row_due(self) -> bool:
        return self.due or bool(self.ends)

    @property
    def far(self) -> float:
        """m, from where the gauge stood at the last rest to where it is led."""
        return abs(self.until - self.start)

    @property
    def span(self) -> float:
        """m, the same, but no more than the specimen is large: what rows and the servo are measured by."""
        return min(self.far, self.size)

    @property
    def aim(self) -> float:
        """Share of the collapse factor that the motion may take."""
        return self.settings.aim * self.path.accuracy

    def learn(self, rested: Arrays, by: float) -> None:
        """The specimen has come from one rest to another as the factor grew by so much: the first such move gives its
        slowest swing (rad/s), by Rayleigh's quotient."""
        if self.swing == 0.0:
            moved = moved_since(self.model, rested)
            self.swing = sqrt(by * max(self.pushed(moved, 0.0), 0.0) / max(self.inertia(moved), 1e-300))

    def pushed(self, moved: Arrays, factor: float) -> float:
        """J, the work of the load for each unit of the factor."""
        slope = self.path.slope(factor)
        return float(slope @ works_of(self.model, moved)[-len(slope) :])

    def inertia(self, moved: Arrays) -> float:
        """Mass times the square of all moves (kg m2)."""
        return sum(float(np.sum(self.model.masses[kind] * one**2)) for kind, one in moved.items())

    def begin(self, rested: Arrays, stands: float, falls: float) -> bool:
        """Whether the gauge can be led on from a rest, at a factor that was borne; how it has fallen since, at one that
        was not, is the mechanism. The specimen has then to be put back."""
        mechanism = moved_since(self.model, rested)
        frame = rested["rigid.frame"] if self.gauge.turns(self.model) else None
        self.start = self.gauge.reading(kept_dofs(self.model, rested), frame)
        self.sense = float(np.sign(self.until - self.start))
        moves = self.sense * (self.gauge.read(self.model) - self.start)
        far = max(reach(one[:, :3]) for one in mechanism.values())
        self.gain = moves * self.pushed(mechanism, stands) / max(self.inertia(mechanism), 1e-300)
        if stands <= 0.0:
            self.ends = NOTHING
        elif self.start / self.until >= 1.0:
            self.ends = PASSED
        elif abs(moves) <= self.settings.moves * far:
            self.ends = STAYS
        elif self.gain <= 0.0:
            self.ends = OTHER_DIRECTION
        else:
            self.set_out(mechanism, stands, falls)
        return self.led

    def set_out(self, mechanism: Arrays, stands: float, falls: float) -> None:
        """How quick the servo is: beside the fall as quick as it may be, but slow beside the swings of the specimen."""
        settings, dt = self.settings, self.model.dt
        self.scale, self.balance, self.factor, self.earlier = falls, stands, stands, stands
        fall = sqrt(self.gain * falls / self.span)
        self.swing = max(self.swing, fall)
        rate = min(settings.quick * fall, settings.slow * self.swing)
        often = min(settings.sampled / rate, settings.braked / self.swing)
        self.look = int(np.clip(often / dt, settings.shortest, settings.longest))
        self.rate = min(rate, settings.sampled / (self.look * dt))
        self.most_steps = int(settings.patience * sqrt(2.0 * self.far / (self.aim * self.span)) / (fall * dt))
        self.drift = Drift(mechanism, exp(-settings.memory * self.rate * self.look * dt))

    def feel(self, before: list[np.ndarray]) -> None:
        """Look at the specimen after each chunk, and set the factor; `before`: velocities a step earlier."""
        assert self.drift is not None
        passed = self.look * self.model.dt
        self.steps += self.look
        self.drift.look(self.model)
        drifts = self.drift.brake(self.model, before, exp(-min(self.swing * passed, 1.0)))
        speed = drifts * self.sense * self.gauge.along(self.drift.moved)
        rises, self.speed = (speed - self.speed) / passed, speed
        self.travel = self.sense * (self.gauge.read(self.model) - self.start)
        self.account(before)
        self.steer(rises, passed)
        self.ends = self.ended()

    def goes_on(self, before: list[np.ndarray]) -> bool:
        """Whether there is another chunk after this one; the last one has a row, to show where the branch ends."""
        if self.ends:
            return False
        self.feel(before)
        return True

    def turned(self) -> None:
        """A block has turned further than small displacement allows."""
        self.ends = self.ends or TURNED

    def account(self, before: list[np.ndarray]) -> None:
        """Whether a row is due; and what damping and inertia took since the row before, for what the load did."""
        works, slope = works_of(self.model, dofs(self.model)), self.path.slope(self.factor)
        lost = energy.kinetic(self.model, before)
        lost -= sum(float(body.work[:, 1].sum()) for _, body in energy.present(self.model))
        if not len(self.works):
            self.works, self.lost = works, lost
        self.work += float(slope @ (works - self.works)[-len(slope) :])
        self.works = works
        row = int(self.travel / self.span * self.settings.rows)
        self.due = row > self.rows
        if self.due:
            self.off = (lost - self.lost) / max(abs(self.work) * self.scale, 1e-300)
            self.rows, self.lost, self.work = row, lost, 0.0
            self.worst = max(self.worst, abs(self.off))
            if self.worst <= self.path.accuracy:
                self.near = self.start + self.sense * self.travel

    def steer(self, rises: float, passed: float) -> None:
        """The factor at the end of the next look. `rises`: how much faster the gauge became (m/s2), by which the factor
        was more than equilibrium needs. Where the specimen leaps ahead, the path goes on from there."""
        settings, row = self.settings, self.span / self.settings.rows
        most = min(self.aim * self.scale * self.gain, 2.0 * self.span * (self.rate / settings.least) ** 2)
        faster = most * float(np.clip(settings.rough - abs(self.off) / self.aim, -1.0, 1.0))
        self.pace = max(self.pace + faster * passed, min(self.pace, sqrt(most * row)))
        self.target += self.pace * passed
        leaping = self.travel > self.target + row and self.speed > settings.runs * self.pace
        self.leaps += leaping and not self.leaping
        if leaping:
            self.target = self.travel - row
        self.leaping = leaping
        self.damping = self.model.damping = self.usual if leaping else 0.0
        lags = self.rate**2 * (self.target - self.travel)
        found = 0.5 * (self.factor + self.earlier) + (settings.integral * lags - rises) / self.gain
        self.balance += self.rate * passed * (found - self.balance)
        pushes = faster + 2.0 * self.rate * (self.pace - self.speed) + lags
        self.earlier = self.factor
        self.factor = float(np.clip(self.balance + pushes / self.gain, 0.0, self.path.most))

    def ended(self) -> str:
        """How the branch ends here, if it does."""
        if self.travel >= self.far:
            return UNTIL
        if self.factor <= 0.0 and not self.leaping and self.speed <= self.settings.runs * self.pace:
            return ZERO
        if self.balance <= 0.0 and self.speed > self.settings.runs * self.pace:
            return AWAY
        if self.factor >= self.path.most:
            return MOST
        return LATE if self.steps > self.most_steps else ""

    def progress(self, enclosed: int) -> int:
        """In thousandths: half for how far the collapse factor is enclosed, half for the fraction of the travel."""
        return 500 + int(499 * min(max(self.travel / self.far, 0.0), 1.0)) if self.led else enclosed // 2

    def outcome(self) -> BranchOutcome:
        """How it went."""
        return BranchOutcome(
            gauge=self.gauge.name,
            until_m=self.until,
            ends=self.ends,
            led=self.led,
            from_m=self.start,
            steps=self.steps,
            leaps=self.leaps,
            out_of_balance_max=self.worst,
            near_to_m=self.near,
        )

    def state(self) -> State:
        """All that the next chunk depends on."""
        return {**attributes(self, REMEMBERED), "drift": None if self.drift is None else self.drift.state()}

    def restore(self, state: State) -> None:
        """Go on from there."""
        load_attributes(self, REMEMBERED, state)
        if state["drift"] is not None:
            self.drift = Drift(**state["drift"])
            self.model.damping = self.damping

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

from masonry.loading.collapse.account import Account
from masonry.loading.collapse.factor_path import FactorPath
from masonry.loading.collapse.growing_settings import FALLING, FallingSettings
from masonry.loading.collapse.led_gauge import LedGauge
from masonry.loading.collapse.outcome import BranchOutcome
from masonry.loading.collapse.servo import Servo
from masonry.loading.moves.drift import Drift
from masonry.loading.moves.moved import Arrays, moved_since, reach
from masonry.loading.varying_loads import works_of
from masonry.model.gauges import Gauge
from masonry.model.model import Model
from masonry.runtime.state_file import Remembering, Remembers, State, attributes

UNTIL, ZERO, MOST, AWAY, TURNED, FAR, LATE = "until", "zero", "up_to", "runs away", "turned", "too far", "late"
"""How a branch ends: the gauge is where it was to be led to; the factor is 0; or the greatest that the scene allows;
the gauge runs away although nothing pushes; a block has turned further than small displacement allows; blocks have
crushed, slid or met further than can be told; it takes too long."""
STAYS, OTHER_DIRECTION, NOTHING, PASSED = "stays", "other way", "nothing", "passed"
"""Why there is none: the collapse hardly moves the gauge, or moves it the other way; nothing resists the load; at the
last rest the gauge reads more than that to which it is to be led."""


class Branch(Remembering):
    """Leads a factor, look by look.

    gauge     which is led     servo  which leads it     account  of what its motion takes     drift  of the specimen
    led       whether there is a branch, from the moment on that `begin` finds one
    swing     rad/s, the slowest swing of the specimen
    interval  steps from one look to the next     steps, most_steps  so far, and those after which it is given up
    ends      how the branch has ended, or why there is none; "" as long as it goes on
    damping   of the model, now; usual  elsewhere
    """

    REMEMBERED = ("swing", "interval", "steps", "most_steps", "ends", "damping")

    def __init__(
        self, model: Model, path: FactorPath, gauge: Gauge, until: float, settings: FallingSettings = FALLING
    ) -> None:
        """until: the reading (m) to which the gauge is led"""
        self.model, self.path, self.settings = model, path, settings
        self.gauge, self.account = LedGauge(model, gauge, until), Account(model)
        self.servo = Servo(settings.aim * path.accuracy, path.most, settings)
        self.swing, self.interval, self.steps, self.most_steps, self.ends = 0.0, settings.longest, 0, 0, ""
        self.usual = self.damping = model.damping
        self.drift: Drift | None = None

    @property
    def led(self) -> bool:
        return self.drift is not None

    @property
    def row_due(self) -> bool:
        """Whether a row is due after the next chunk."""
        return self.account.due or bool(self.ends)

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
        self.gauge.begin(rested)
        moves, self.ends = self.gauge.read(), ""
        far = max(reach(one[:, :3]) for one in mechanism.values())
        self.servo.gain = moves * self.pushed(mechanism, stands) / max(self.inertia(mechanism), 1e-300)
        if stands <= 0.0:
            self.ends = NOTHING
        elif self.gauge.start / self.gauge.until >= 1.0:
            self.ends = PASSED
        elif abs(moves) <= self.settings.moves * far:
            self.ends = STAYS
        elif self.servo.gain <= 0.0:
            self.ends = OTHER_DIRECTION
        else:
            self.set_out(mechanism, stands, falls)
        return self.led

    def set_out(self, mechanism: Arrays, stands: float, falls: float) -> None:
        """How quick the servo is: beside the fall as quick as it may be, but slow beside the swings of the specimen."""
        settings, servo, gauge, dt = self.settings, self.servo, self.gauge, self.model.dt
        servo.begin(stands, falls)
        fall = sqrt(servo.gain * falls / gauge.span)
        self.swing = max(self.swing, fall)
        rate = min(settings.quick * fall, settings.slow * self.swing)
        often = min(settings.sampled / rate, settings.braked / self.swing)
        self.interval = int(np.clip(often / dt, settings.shortest, settings.longest))
        servo.rate = min(rate, settings.sampled / (self.interval * dt))
        self.most_steps = int(settings.patience * sqrt(2.0 * gauge.far / (servo.aim * gauge.span)) / (fall * dt))
        self.drift = Drift(mechanism, exp(-settings.memory * servo.rate * self.interval * dt))

    def look(self, before: list[np.ndarray]) -> None:
        """Look at the specimen after each chunk, and set the factor; `before`: velocities a step earlier."""
        assert self.drift is not None
        servo, gauge, passed = self.servo, self.gauge, self.interval * self.model.dt
        self.steps += self.interval
        self.drift.look(self.model)
        drifts = self.drift.brake(self.model, before, exp(-min(self.swing * passed, 1.0)))
        speed = gauge.speed(drifts, self.drift.moved)
        rises, servo.speed = (speed - servo.speed) / passed, speed
        gauge.travel = gauge.read()
        slope, row = self.path.slope(servo.factor), int(gauge.travel / gauge.span * self.settings.rows)
        if self.account.look(before, slope, row, servo.scale) and self.account.worst <= self.path.accuracy:
            self.account.near = gauge.start + gauge.sense * gauge.travel
        servo.steer(gauge, rises, passed, abs(self.account.off))
        self.damping = self.model.damping = self.usual if servo.leaping else 0.0
        self.ends = self.end()

    def goes_on(self, before: list[np.ndarray]) -> bool:
        """Whether there is another chunk after this one; the last one has a row, to show where the branch ends."""
        if self.ends:
            return False
        self.look(before)
        return True

    def leave(self, ends: str) -> None:
        """A block has turned or moved further than the run can tell what follows."""
        self.ends = self.ends or ends

    def end(self) -> str:
        """How the branch ends here, if it does."""
        servo = self.servo
        if self.gauge.travel >= self.gauge.far:
            return UNTIL
        if servo.factor <= 0.0 and not servo.leaping and not servo.runs_away:
            return ZERO
        if servo.balance <= 0.0 and servo.runs_away:
            return AWAY
        if servo.factor >= self.path.most:
            return MOST
        return LATE if self.steps > self.most_steps else ""

    def progress(self, enclosed: int) -> int:
        """In thousandths: half for how far the collapse factor is enclosed, half for the fraction of the travel."""
        gauge = self.gauge
        return 500 + int(499 * min(max(gauge.travel / gauge.far, 0.0), 1.0)) if self.led else enclosed // 2

    def outcome(self) -> BranchOutcome:
        """How it went."""
        return BranchOutcome(
            gauge=self.gauge.name,
            until_m=self.gauge.until,
            ends=self.ends,
            led=self.led,
            from_m=self.gauge.start,
            steps=self.steps,
            leaps=self.servo.leaps,
            out_of_balance_max=self.account.worst,
            near_to_m=self.account.near,
        )

    def parts(self) -> dict[str, Remembers]:
        """Parts of the branch, but for the drift, which is made when it begins."""
        return attributes(self, ("gauge", "servo", "account"))

    def state(self) -> State:
        """All that the next chunk depends on."""
        return {**super().state(), "drift": None if self.drift is None else self.drift.state()}

    def restore(self, state: State) -> None:
        """Go on from there."""
        super().restore(state)
        if state["drift"] is not None:
            self.drift = Drift(**state["drift"])
            self.model.damping = self.damping

"""How a run advances, chunk by chunk: a drive that is paced by its error."""

import numpy as np

from masonry.events import Events
from masonry.fixed_pace import Chunk, FixedPace
from masonry.guide import Guide
from masonry.loads import Controlled, Program, smooth
from masonry.model import Model
from masonry.remember import State, attributes, put_back
from masonry.utilisation import utilisation
from masonry.watch import LEAP, smallest_block

SETTLING = 10
"""One in so many of the rows goes to the settling, which nobody looks at but for its end."""
STEPS = 80
"""Steps of an increment: about a period of the slowest swing of a wallette."""
FEW, STILL = 4, 1e-12
"""Steps of an increment where all that moves is prescribed, and kinetic over stored energy below which it is so."""
CURVE = 0.05
"""Accuracy of increments there at one of FINE or coarser: nothing lags, and only the curve is followed."""
COARSEST, FINEST = 30, 40_000
"""Increments in which the whole displacement is made, at least and at most."""
FIRST, LEARNING = 1e-4, 4
"""Share of the displacement that the first increment makes; increments before the speed may rise."""
INTACT = 1e-6
"""Nothing counts as damaged while fracture has taken less than this share of the stored energy."""
RISE, FALL = 2.0, 0.1
"""Most and least change of the speed from one increment to the next, while all is elastic."""
APPROACH = 0.4
"""Share of the way to the first damage, slip or opening that an increment may make, unless it is as short as the
accuracy anyway."""
FASTER, SLOWER = 1.3, 0.2
"""Most and least change of the speed from then on."""
STORED, FRACTURE, LAG, SWAY, ENDS, DRAG = 20.0, 5.0, 1.0, 7.0, 0.4, 0.5
"""What an increment may bring, in accuracies: change of the stored energy and energy spent on fracture, over the most
that was stored; energy by which the drive runs ahead, over the work of the drive; the root of kinetic over stored
energy; the difference between the forces of the two ends, and the force that damping takes on average (its work over
the way), over the largest force. Measured: benchmarks/test_controlled.py."""
UNEXPECTED = 0.5
"""Share of the kinetic energy that was not expected from which on the specimen moves by itself: a sudden crack."""
PARTED = 1e-3
"""Of the most that was stored: what a specimen that came apart is taken to store, as its pieces still move."""
FINE, BLUNT = 0.01, 0.4
"""Accuracies coarser than this one are taken for (accuracy / FINE) ** BLUNT of it: sudden cracks would be overrun."""

DEFORMABLE = 0.5
"""Of the accuracy: what is aimed at where units deform. In failure mode 1 the same bounds left 2.4 (affine) and 4.8 %
(tets) of error in the dissipated energy at an accuracy of 1 %, against 0.7 % with rigid units."""

REMEMBERED = (
    *("speed", "moved", "made", "used", "target", "steps", "increments"),
    *("most_stored", "stored", "broken", "most_force", "damped", "work", "elastic", "rest", "step"),
)
"""Numbers of a paced drive that the next increment depends on."""


class ControlledPace:
    """Smooth increments of the drive, as large as the accuracy allows.

    Between two increments the speed changes by a quintic. How fast it becomes follows from what the last increment
    brought: larger increments while elastic, smaller ones while cracking.
    """

    slower = SLOWER

    def __init__(self, model: Model, plan: Controlled, rows: int) -> None:
        self.model, self.dt, self.plan, self.guide = model, model.dt, plan, Guide(model)
        still = Program(plan.dead_load, np.zeros(len(plan.dead_load)), plan.settle, 0)
        self.settling = FixedPace(still, max(1, rows // SETTLING))
        self.goal = abs(plan.displacement)
        self.sign = -1.0 if plan.displacement < 0 else 1.0
        self.unit = min(plan.accuracy, FINE * (plan.accuracy / FINE) ** BLUNT)
        if len(model.layout.members["affine"]) or len(model.layout.members["tets"]):
            self.unit *= DEFORMABLE
        whole = self.goal / (STEPS * model.dt)
        self.leap = 0.5 * LEAP * smallest_block(model) / model.dt
        self.slowest, self.target, self.steps = whole / FINEST, whole * FIRST, STEPS
        self.speed = self.moved = self.made = self.used = 0.0
        self.most_stored = self.stored = self.broken = self.most_force = self.damped = self.work = 0.0
        self.increments = 0
        self.elastic = True
        self.rest = np.zeros(len(model.group))
        self.step, self.events = 0, Events(model)
        self.looks: list[tuple[float, float, float, float]] = []

    def next(self) -> Chunk | None:
        """The next increment; None when the displacement is made."""
        waiting = self.settling.next()
        if waiting is not None:
            return waiting
        left = self.goal - self.moved
        if left <= 1e-12 * self.goal:
            return None
        steps = self.steps
        rise = smooth(np.arange(1, steps + 1) / steps)
        speed = np.concatenate([[self.speed], self.speed + (self.target - self.speed) * rise])
        first, whole = speed[0] * self.dt, speed[:-1].sum() * self.dt
        if left < 1.5 * whole:
            speed[1:] *= (left - first) / (whole - first)
            whole = left
        self.made = whole
        self.moved += whole
        self.speed = float(speed[-1])
        self.increments += 1
        return Chunk(np.full(steps + 1, self.plan.dead_load[-1]), self.sign * speed, True)

    def feel(self, step: int, before: list[np.ndarray]) -> None:
        """Each increment is a row, and is looked at there."""
        self.step = step

    def look(self, force: float, support: float, seen: np.ndarray, terms: dict[str, float]) -> None:
        """Choose the next speed by the forces of drive and support (N), what contacts show, and the ledger (J)."""
        stored = terms["elastic_blocks"] + terms["elastic_contacts"]
        broken = terms["fracture_mode_1"] + terms["fracture_mode_2"]
        if self.increments == 0:
            self.stored = self.most_stored = stored
            self.rest = seen[:, 2].copy()
            self.used = utilisation(self.model, seen, self.rest)
            self.guide.settle()
            return
        self.most_stored = max(self.most_stored, stored, 1e-300)
        self.most_force = max(self.most_force, abs(force), 1e-300)
        self.work += abs(force) * self.made
        self.learn(force)
        if self.elastic or self.guide.trust > UNEXPECTED:
            self.events.calm(self.step)
        else:
            self.events.sudden(self.step)
        used = utilisation(self.model, seen, self.rest)
        self.elastic = self.elastic and used < 1.0 and broken <= INTACT * self.most_stored
        if self.elastic:
            factor = self.towards_damage(used)
        else:
            factor = self.through_damage(stored, broken, force, support, terms)
        self.stored, self.broken, self.damped = stored, broken, terms["damping"]
        self.steps = FEW if abs(terms["kinetic"]) <= STILL * stored else STEPS
        fastest = min(self.goal / (COARSEST * self.steps * self.dt), self.leap)
        self.target = float(np.clip(self.target * factor, self.slowest, fastest))

    def learn(self, force: float) -> None:
        """Let the guide see where the drive has come to, and its force (N)."""
        self.guide.learn(self.sign * self.moved, self.sign * self.speed, force)

    def towards_damage(self, used: float) -> float:
        """Factor of the speed while the contacts use a share `used` of their strength, which grows with the way."""
        left = self.made * max(1.0 - used, 0.0) / max(used - self.used, 1e-9)
        self.used = used
        way = max(APPROACH * left, self.unit * self.moved)
        most = RISE if self.increments > LEARNING else 1.0
        return float(np.clip(way / (self.steps * self.dt * self.target), FALL, most))

    def through_damage(
        self, stored: float, broken: float, force: float, support: float, terms: dict[str, float]
    ) -> float:
        """Factor of the speed by what the last increment brought; forces of drive and support in N.

        The drive runs ahead of the specimen by about v / w, where w is the frequency of the expected motion, so the
        force of the drive does work too early: F v / w = 2 sqrt(K W) of kinetic energy K (expected) and stored W.
        """
        change = abs(stored - self.stored) / self.most_stored
        fracture = (broken - self.broken) / self.most_stored
        lag = 2.0 * np.sqrt(self.guide.kinetic * abs(stored)) / max(self.work, 1e-300)
        sway = np.sqrt(abs(terms["kinetic"]) / max(abs(stored), PARTED * self.most_stored))
        curve = CURVE * min(self.plan.accuracy / FINE, 1.0)
        unit = max(self.unit, curve) if self.steps == FEW else self.unit
        brought = max(change / STORED, fracture / FRACTURE, 1e-12) / unit
        ends = abs(force - support) / self.most_force
        drag = abs(terms["damping"] - self.damped) / (self.most_force * self.made)
        self.looks.append((float(lag), self.made, float(drag), abs(force)))
        shares = (lag / LAG, sway / SWAY, ends / ENDS, drag / DRAG)
        excess = max(np.sqrt(brought), *(share / self.unit for share in shares))
        return float(np.clip(1.0 / excess, self.slower, FASTER))

    def progress(self) -> tuple[int, int]:
        """How far the displacement is made, in millionths."""
        return int(1e6 * min(self.moved / self.goal, 1.0) + 1e-3), 1_000_000

    def report(self) -> dict[str, float]:
        """What was asked and achieved after the first damage: lags over the work done, their mean over the way, and the
        share of the largest force that damping took where that force was reached."""
        lag, way, drag, force = np.array(self.looks or [(0.0, 1.0, 0.0, 0.0)]).T
        peak = int(np.argmax(force))
        return {
            "accuracy": self.plan.accuracy,
            "increments": self.increments,
            "mean_lag": float(lag @ way / max(way.sum(), 1e-300)),
            "largest_lag": float(lag.max()),
            "drag_at_peak": float(drag[max(peak - 1, 0) : peak + 2].max()),
        }

    def state(self) -> State:
        """All that the next speed depends on."""
        return {
            **attributes(self, REMEMBERED),
            "looks": np.array(self.looks).reshape(-1, 4),
            "events": self.events.state(),
            "settling": self.settling.state(),
            "guide": self.guide.state(),
        }

    def restore(self, state: State) -> None:
        """Go on from there."""
        put_back(self, REMEMBERED, state)
        self.looks = [(lag, way, drag, force) for lag, way, drag, force in state["looks"].tolist()]
        self.events.restore(state["events"])
        self.settling.restore(state["settling"])
        self.guide.restore(state["guide"])

"""The plan of a loading: a fixed program, a drive that is paced by its error, or a load that grows."""

from dataclasses import dataclass, field
from functools import cached_property
from itertools import pairwise
from math import ceil
from typing import NamedTuple

import numpy as np

from masonry.errors import SceneError


def smooth(x: np.ndarray) -> np.ndarray:
    """Quintic rise from 0 to 1 over [0, 1] with zero slope and curvature at both ends."""
    x = np.clip(x, 0.0, 1.0)
    return x**3 * (10.0 + x * (6.0 * x - 15.0))


MOST_STEPS = 100_000_000


@dataclass(frozen=True)
class Program:
    """What happens at each step 0..n: share of the dead load, velocity of the drive (m/s) after the step.

    settle  steps before the drive starts     ramp  steps over which the drive's velocity rises
    varying (H, n + 1) share of each load that varies, at each step; None without any
    marks   steps, rising, after which a row is due besides the regular ones
    layers  (L, settle + 1) share of each load that comes on in layers, until the end of the settling; None without any
    straight   of its largest share: how far a history may leave the straight line that the loading takes for it
    rest_from  step from which on the run may end as soon as all is at rest; None where it goes on to the last step
    """

    dead_load: np.ndarray
    speed: np.ndarray
    settle: int
    ramp: int
    varying: np.ndarray | None = None
    marks: np.ndarray = field(default_factory=lambda: np.zeros(0, dtype=np.int64))
    straight: float = 1e-3
    rest_from: int | None = None
    layers: np.ndarray | None = None

    @property
    def steps(self) -> int:
        return len(self.speed) - 1

    @property
    def load_factors(self) -> np.ndarray | None:
        """(L + H, n + 1) factor of each load that does not simply rise with the others, at each step."""
        if self.layers is None:
            return self.varying
        stay = np.pad(self.layers, ((0, 0), (0, self.steps - self.settle)), mode="edge")
        return stay if self.varying is None else np.concatenate([stay, self.varying])


@dataclass(frozen=True)
class Controlled:
    """A drive paced by its error (loading/drive/adaptive.py): displacement (m, signed) and accuracy (0.01 is 1 %).

    dead_load  (settle + 1,) share of the dead load at each step before the drive starts; its last value stays
    reversals  places (m, signed) that the drive visits one after the other, in place of going to its displacement
    layers     as of Program
    """

    dead_load: np.ndarray
    displacement: float
    accuracy: float
    reversals: tuple[float, ...] = ()
    layers: np.ndarray | None = None

    ramp = 0

    @property
    def settle(self) -> int:
        return len(self.dead_load) - 1


class Control(NamedTuple):
    """Behind its collapse a load is led by a gauge, by its name, until it reads so much (m)."""

    gauge: str
    until: float


class Leg(NamedTuple):
    """A part of the way of a load's factor, from one value to another."""

    start: float
    end: float

    @property
    def length(self) -> float:
        return abs(self.end - self.start)

    def at(self, passed: float) -> float:
        """The factor behind so much of the leg."""
        if passed >= self.length:
            return self.end
        return self.start + (passed if self.end > self.start else -passed)


@dataclass(frozen=True)
class Growing:
    """A load whose factor grows until nothing balances it (loading/collapse/growing.py), to an accuracy, up to `most`.

    dead_load  (settle + 1,) share of the dead load at each step before it grows; its last value stays
    reversals  factors to which the load goes one after the other, in place of growing up to `most`
    tilts      whether the factor is the tangent of the angle by which gravity turns: two loads, see `load_factors`
    layers     as of Program
    """

    dead_load: np.ndarray
    accuracy: float
    most: float
    tilts: bool = False
    layers: np.ndarray | None = None
    control: Control | None = None
    reversals: tuple[float, ...] = ()

    ramp = 0

    @property
    def settle(self) -> int:
        return len(self.dead_load) - 1

    @cached_property
    def legs(self) -> tuple[Leg, ...]:
        """The way of the factor."""
        return tuple(Leg(start, end) for start, end in pairwise((0.0, *(self.reversals or (self.most,)))))

    @property
    def path(self) -> float:
        """The length of all legs."""
        return sum(leg.length for leg in self.legs)

    @property
    def span(self) -> float:
        """From the least factor on the way to the greatest."""
        return float(np.ptp([0.0, *(leg.end for leg in self.legs)]))

    def load_factors(self, factor: float) -> np.ndarray:
        """(H,) factors of the loads that vary; of a tilt those of the weight less 1, and of it turned by 90 degrees."""
        if not self.tilts:
            return np.array([factor])
        whole = float(np.hypot(1.0, factor))
        return np.array([1.0 / whole - 1.0, factor / whole])

    def slope(self, factor: float) -> np.ndarray:
        """(H,) by how much the load factors change per unit of the factor."""
        whole = float(np.hypot(1.0, factor))
        return np.array([-factor, 1.0]) / whole**3 if self.tilts else np.ones(1)


Plan = Program | Controlled | Growing


def controlled(settle: int, displacement: float, accuracy: float, reversals: tuple[float, ...] = ()) -> Controlled:
    """Dead loads rise over the first half of `settle`; then the drive makes its way to an accuracy."""
    return Controlled(rise(settle, settle), displacement, accuracy, reversals)


def rise(settle: int, steps: int) -> np.ndarray:
    """Share of the dead loads at each step 0..n: they rise over the first half of `settle`, if there is one."""
    return smooth(np.arange(steps + 1) / (0.5 * settle)) if settle else np.zeros(steps + 1)


def require_few(steps: float, dt: float, where: str = "drive", advice: str = "") -> None:
    """SceneError where a program, that of a key of the scene, would take more steps than anybody waits for."""
    if steps > MOST_STEPS:
        raise SceneError(
            f"{where}: this would take {steps:.2g} steps of {dt:.3g} s; at most {MOST_STEPS:.0e} are allowed: "
            f"{advice or 'raise drive.rate, or give drive.steps'}"
        )


def program(dt: float, settle: int, displacement: float, steps: int | None, rate: float | None, ramp: float) -> Program:
    """Dead loads rise over the first half of `settle`; then the drive makes exactly `displacement` (m, signed).

    Either the number of steps or the rate (m/s) after the ramp is given; the ramp takes a share of the steps.
    """
    if displacement == 0.0:
        count = 0
    elif steps is not None:
        count = steps
    else:
        assert rate is not None
        count = max(1, ceil(min(abs(displacement) / (rate * dt * (1.0 - 0.5 * ramp)), 1e18)))
    if count and settle == 0:
        count = max(count, 2)  # the first step starts at rest and cannot move anything
    require_few(settle + count, dt)
    k = np.arange(settle + count + 1)
    shape: np.ndarray = np.where(
        k < settle, 0.0, smooth((k - settle + 0.5) / (ramp * count)) if ramp * count > 0 else 1.0
    )
    shape[[0, -1]] = 0.0  # the first step starts at rest; what is set after the last step moves nothing
    speed = shape * (displacement / (dt * shape.sum())) if count else np.zeros(len(k))
    return Program(rise(settle, settle + count), speed, settle, int(np.ceil(ramp * count)))

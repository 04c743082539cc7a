"""The machine's speed: a step of a wall of rigid blocks, ours beside the hand-written one, both at the same work."""

from typing import NamedTuple

import numpy as np

from verification.reference_step import models, specimens
from verification.reference_step.interleaved import against
from verification.reference_step.reference import ReferenceStep

STEPS, ROUNDS = 10, 100
UNITS = 16
"""Of the wall, along and up: few enough for a cache."""


class Speed(NamedTuple):
    """Nanoseconds that a step takes per contact point, all included; spread of ours; points; whether forces agree."""

    ours: float
    by_hand: float
    spread: float
    points: int
    agree: bool

    @property
    def ratio(self) -> float:
        """Of ours to the one by hand; below 1 is faster."""
        return self.ours / self.by_hand


def measure(rounds: int = ROUNDS) -> Speed:
    """Time both in turn; contacts with the exponential law that stay untouched, in a wall that moves slightly."""
    model = models.model_of(*specimens.wall(UNITS, UNITS))
    twin = ReferenceStep(model)
    velocity = np.random.default_rng(1).normal(scale=1e-6, size=(model.blocks.count, 6))
    models.set_velocity(model, velocity)
    twin.set_velocity(velocity)
    ours, by_hand = models.stepping(model, STEPS), twin.stepping(STEPS)
    ours()
    by_hand()
    alike = bool(np.allclose(models.forces(model), twin.force[:, :3], rtol=1e-6, atol=1e-9 * np.abs(twin.force).max()))
    times = against((ours, models.stepping(model, 0)), (by_hand, twin.stepping(0)), rounds)
    points = len(model.joints.area)
    each = 1e9 / STEPS / points
    return Speed(each * times.ours, each * times.by_hand, times.spread, points, alike)

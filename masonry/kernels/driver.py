"""The driver of all steps: it calls their parts in turn, by their addresses, and is compiled once."""

from collections.abc import Callable
from typing import Any

import numpy as np

from masonry.jit.compiled_parts import StepCalls
from masonry.jit.compiler import jit
from masonry.jit.records import call
from masonry.kinematics.shared import (
    DRIVE_FORCE,
    FACTOR,
    FACTOR_BEFORE,
    SHARED,
    SPARE,
    SPEED,
    SPEED_BEFORE,
)


@jit
def drive(first, steps, dead_load, speed, addresses, bounds, shared, drive_force):
    """Take up to `steps` steps from step number `first`; returns how many were taken: fewer where one cannot be.

    dead_load    (n + 1,) share of the dead load at step 0..n; above 1: 1 + share of what its bodies hold as its change
    speed        (n + 1,) velocity of the drive after step i, m/s
    addresses    (K, 2) of parts and their records
    bounds       (5,) of the calls that are made once, of those with which a step begins, of those that are made where
                 no travel is spare any more, and of the rest of the step
    shared       (SHARED,) of kinematics/shared.py
    drive_force  (steps,) out: force (N) that the drive exerts, after each step
    """
    for k in range(bounds[0], bounds[1]):
        call(addresses[k, 0], addresses[k, 1])
    shared[SPARE] = 0.0
    for i in range(steps):
        n = first + i
        shared[FACTOR], shared[FACTOR_BEFORE] = dead_load[n + 1], dead_load[n]
        shared[SPEED], shared[SPEED_BEFORE] = speed[n + 1], speed[n]
        shared[DRIVE_FORCE] = 0.0
        for k in range(bounds[1], bounds[2]):
            call(addresses[k, 0], addresses[k, 1])
        if shared[SPARE] <= 0.0:
            for k in range(bounds[2], bounds[3]):
                call(addresses[k, 0], addresses[k, 1])
            if shared[SPARE] < 0.0:
                return i
        for k in range(bounds[3], bounds[4]):
            call(addresses[k, 0], addresses[k, 1])
        drive_force[i] = shared[DRIVE_FORCE]
    return steps


class Stepper:
    """Takes the steps of a program, which is put together anew where one of the things that it is made of changed: that
    takes a millisecond or two. Where it is the numbers of the damping alone, as from one increment of a drive to the
    next, these go to the records of the program that is there."""

    def __init__(self) -> None:
        self.shared, self.program = np.zeros(SHARED), StepCalls()
        self.made_of: tuple[Any, ...] | None = None
        self.damping: Any = None

    def prepare(self, make: Callable[[np.ndarray], StepCalls], damping: Any, *made_of: Any) -> StepCalls:
        """The program that `make` makes of what parts share; compiled, or loaded from the cache."""
        before, damped = self.made_of, self.damping
        same = before is not None and all(former is other for former, other in zip(before, made_of, strict=True))
        if same and damping is damped:
            return self.program
        if same and isinstance(damping, tuple) and type(damping) is type(damped):
            for call in self.program.calls:
                call.replace(damped, damping)
        else:
            self.program = make(self.shared)
            self.addresses = self.program.addresses()
        self.made_of, self.damping = made_of, damping
        return self.program

    def take(self, first: int, steps: int, dead_load: np.ndarray, speed: np.ndarray, drive_force: np.ndarray) -> int:
        """As `drive`."""
        taken = drive(first, steps, dead_load, speed, self.addresses, self.program.bounds, self.shared, drive_force)
        return int(taken)

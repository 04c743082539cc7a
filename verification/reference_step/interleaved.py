"""Times things in turn, in one process, and compares their minima: what a noisy machine allows to be said.

What is compared are seconds of this process on its processors: while other programs have them it does not age. Work on
two threads is measured by `wall`.
"""

import time
from collections.abc import Callable
from typing import NamedTuple

import numpy as np


class Timing(NamedTuple):
    """Least time of processor (s) of some rounds, by how much the upper quartile lies above it (share), and the least
    time by the clock on the wall (s)."""

    least: float
    spread: float
    wall: float


def in_turn(*works: Callable[[], object], rounds: int = 60) -> list[Timing]:
    """Times of each work, rounds interleaved."""
    taken = np.empty((rounds, len(works), 2))
    for times in taken:
        for k, work in enumerate(works):
            begun = time.process_time(), time.perf_counter()
            work()
            times[k] = time.process_time() - begun[0], time.perf_counter() - begun[1]
    least, upper = taken.min(axis=0), np.quantile(taken[..., 0], 0.75, axis=0)
    return [
        Timing(float(busy), float(high / busy - 1.0), float(wall))
        for (busy, wall), high in zip(least, upper, strict=True)
    ]


class Against(NamedTuple):
    """Time (s) of our work and of that by hand, both less what a call costs that does none of it; spread of ours."""

    ours: float
    by_hand: float
    spread: float

    @property
    def ratio(self) -> float:
        return self.ours / self.by_hand


def against(ours: tuple[Callable, Callable], by_hand: tuple[Callable, Callable], rounds: int) -> Against:
    """Each side is (work, the same call without the work)."""
    times = in_turn(*ours, *by_hand, rounds=rounds)
    work, idle, work_by_hand, idle_by_hand = (t.least for t in times)
    return Against(work - idle, work_by_hand - idle_by_hand, times[0].spread)


def require(value: float, limit: float, what: str) -> None:
    """Fail with a sentence."""
    assert value <= limit, f"{what}: {value:.2f} times the reference, the gate is {limit:.2f}"

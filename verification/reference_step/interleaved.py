"""Times things in turn, in one process, and compares their minima: what a noisy machine allows to be said."""

import time
from collections.abc import Callable
from typing import NamedTuple

import numpy as np


class Timing(NamedTuple):
    """Least time (s) of some rounds, and by how much the upper quartile lies above it (share)."""

    least: float
    spread: float


def in_turn(*works: Callable[[], object], rounds: int = 60) -> list[Timing]:
    """Times of each work, rounds interleaved."""
    taken = np.empty((rounds, len(works)))
    for times in taken:
        for k, work in enumerate(works):
            begun = time.perf_counter()
            work()
            times[k] = time.perf_counter() - begun
    least = taken.min(axis=0)
    upper = np.quantile(taken, 0.75, axis=0)
    return [Timing(float(a), float(b / a - 1.0)) for a, b in zip(least, upper, strict=True)]


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

"""Times things in turn, in one process, and compares their minima: what a noisy machine allows to be said."""

import time
from collections.abc import Callable
from typing import NamedTuple

import numpy as np


class Times(NamedTuple):
    """Least time (s) of some rounds, and by how much the upper quartile lies above it (share)."""

    least: float
    spread: float


def in_turn(*works: Callable[[], object], rounds: int = 60) -> list[Times]:
    """Times of each work, rounds interleaved."""
    taken = np.empty((rounds, len(works)))
    for times in taken:
        for k, work in enumerate(works):
            begun = time.perf_counter()
            work()
            times[k] = time.perf_counter() - begun
    least = taken.min(axis=0)
    upper = np.quantile(taken, 0.75, axis=0)
    return [Times(float(a), float(b / a - 1.0)) for a, b in zip(least, upper, strict=True)]


def ratio(measured: Callable[[], object], reference: Callable[[], object], rounds: int = 60) -> float:
    """Least time of `measured` over least time of `reference`."""
    ours, theirs = in_turn(measured, reference, rounds=rounds)
    return ours.least / theirs.least


def require(value: float, limit: float, what: str) -> None:
    """Fail with a sentence."""
    assert value <= limit, f"{what}: {value:.2f} times the reference, the gate is {limit:.2f}"

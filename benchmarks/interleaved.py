"""Times two things in turn, in one process, and compares their minima: what a noisy machine allows to be said."""

import time
from collections.abc import Callable


def ratio(measured: Callable[[], object], reference: Callable[[], object], rounds: int = 60) -> float:
    """Least time of `measured` over least time of `reference`, rounds interleaved."""
    best = [float("inf"), float("inf")]
    for _ in range(rounds):
        for k, work in enumerate((measured, reference)):
            begun = time.perf_counter()
            work()
            best[k] = min(best[k], time.perf_counter() - begun)
    return best[0] / best[1]

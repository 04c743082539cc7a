"""What rows cost: the looks of observers and of the control, the frames, and all else of a run that is not a step, but
Python: the program of the steps too, where it is put together anew.

Measured within whole runs: what a row reads, the steps before it have driven from the processor's cache, and a row by
itself, over and over, takes half as long.
"""

import time
from typing import NamedTuple

import pytest

from masonry.kernels.driver import Stepper
from masonry.laboratory import laboratory
from masonry.scene import load
from masonry.timeloop import loop
from verification.reference_step.interleaved import require

ROUNDS = 5
LIMIT = {"wallette-mode-1": 0.42, "wall-tilted": 0.64}
"""Largest share of a run that may be no steps. A row or a look comes once in 50 to 80 steps, of 2,048 and of 364
contact points that take 12 ns each; without AVX-512 these take longer, and the share is less. Measured on a crowded
machine: 33 to 35 % and 52 to 57 %. They were 64 % and 60 % as long as each change of the
damping put the program together anew."""
AIM = 0.1


class Cost(NamedTuple):
    """Seconds of processor of a run in compiled steps and in all else; how many rows and steps it had."""

    stepping: float
    others: float
    rows: int
    steps: int

    @property
    def share(self) -> float:
        """Of what is no step."""
        return self.others / (self.stepping + self.others)


def cost(name: str, monkeypatch) -> Cost:
    """Of a packaged scene: of some runs that with the least share."""
    taken = {"stepping": 0.0, "whole": 0.0}

    def timed(key: str, work):
        def call(*arguments):
            begun = time.thread_time()
            try:
                return work(*arguments)
            finally:
                taken[key] += time.thread_time() - begun

        return call

    monkeypatch.setattr(Stepper, "take", timed("stepping", Stepper.take))
    monkeypatch.setattr(loop.Loop, "run", timed("whole", loop.Loop.run))
    costs = []
    for _ in range(ROUNDS + 1):  # the first one compiles
        taken.update(stepping=0.0, whole=0.0)
        result = laboratory.run(load(name))
        rows = result.history.rows["step"]
        costs.append(Cost(taken["stepping"], taken["whole"] - taken["stepping"], len(rows), int(rows[-1])))
    return min(costs[1:], key=lambda cost: cost.share)


@pytest.mark.parametrize("name", ["wallette-mode-1", "wall-tilted", "couplet", "block-rocking"])
def test_rows_are_a_small_part_of_a_run(name, figure, monkeypatch):
    least = cost(name, monkeypatch)
    limits = (100.0 * LIMIT[name], 100.0 * AIM) if name in LIMIT else ()
    figure(f"{name}: what is no step, of a run", 100.0 * least.share, "%", *limits)
    figure(f"{name}: what is no step, a row", 1e6 * least.others / least.rows, "us")
    figure(f"{name}: a step, all in all", 1e6 * (least.stepping + least.others) / least.steps, "us")
    require(least.share, LIMIT.get(name, 1.0), f"what is no step of {name}, over the whole run")

"""Errors of numbers from runs whose limits are known."""

import numpy as np

from masonry.sweeps.convergence.answers import Answer, Value
from masonry.sweeps.convergence.campaign import Refinement
from masonry.sweeps.convergence.numerical_errors import error_of_values

SWAY = Answer("sway", "sway")
ACTING = (("scatter", 1.0), ("time step", 2.0))
IDLE = (("points along x", 2.0), ("points along y", 2.0), ("points along z", 2.0), ("points along x", 4.0))


def runs_of(numbers):
    base, *others = numbers
    named = [*zip(ACTING, others, strict=True), *((trial, base) for trial in IDLE)]
    return [
        (Refinement("as it is", 1.0, {}), Value(base)),
        *((Refinement(name, factor, {}), Value(number)) for (name, factor), number in named),
    ]


def test_what_does_not_act_at_all_says_nothing_of_scatter():
    """A motion whose runs differ by noise: its time step acts, points along edges that it does not have do not. The
    bar holds a run of another step as often as it says."""
    draws = 1.0 + 1e-3 * np.random.default_rng(3).normal(size=(600, 4))
    errors = [error_of_values(SWAY, runs_of(numbers[:3]), {}) for numbers in draws]
    holds = [abs(error.limit - numbers[3]) <= error.half_width for error, numbers in zip(errors, draws, strict=True)]
    assert np.mean(holds) > 0.93


def test_runs_that_are_the_same_to_the_last_digit_have_no_bar():
    error = error_of_values(SWAY, runs_of((2.0, 2.0, 2.0)), {})
    assert (error.limit, error.half_width) == (2.0, 0.0)

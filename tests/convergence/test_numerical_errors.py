"""Errors of numbers from runs whose limits are known."""

import numpy as np
import pytest

from masonry.sweeps.convergence.refinement.answers import PLACE, ROWS_APART, Answer, Value
from masonry.sweeps.convergence.refinement.campaign import Refinement
from masonry.sweeps.convergence.refinement.numerical_errors import error_of, error_of_values
from masonry.sweeps.work import OK

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


@pytest.mark.parametrize("seed", range(8))
def test_the_place_of_a_flat_peak_is_read_off_between_rows(seed):
    """Of a parabola: runs whose rows lie alike read the same off, and none where the peak is."""
    draw = np.random.default_rng(seed)
    peak, apart, begin = 1e-3 * draw.uniform(0.8, 1.2), 1e-4, 1e-4 * draw.uniform(-1.0, 0.0)
    way = begin + apart * np.arange(1, 21)
    place = float(way[np.argmax(way * (2.0 * peak - way))])
    reading = apart / place
    trials = ("as it is", 1.0), ("scatter", 1.0), ("pace", 2.0), ("points along x", 2.0)
    runs = [
        (Refinement(name, factor, {}), {"status": OK, PLACE: place, ROWS_APART: reading}) for name, factor in trials
    ]
    error = error_of(Answer(PLACE, "displacement there"), runs)
    assert error.limit == pytest.approx(place)
    assert abs(error.limit - peak) <= error.half_width < 1.01 * apart
    assert (
        error_of(Answer("final_stress_pa", "end"), [(t, row | {"final_stress_pa": 2.0}) for t, row in runs]).half_width
        == 0.0
    )


def test_runs_that_are_the_same_to_the_last_digit_have_no_bar():
    error = error_of_values(SWAY, runs_of((2.0, 2.0, 2.0)), {})
    assert (error.limit, error.half_width) == (2.0, 0.0)

"""Values without end from values at some resolutions."""

import numpy as np
import pytest

from masonry.sweeps.convergence.refinement.extrapolation import Estimate, extrapolated, scatter_bar, together


def ladder(order, factors, limit=3.7, size=-0.4):
    """Values whose error falls with the given order, at factors of refinement."""
    return [(factor, limit + size * factor**-order) for factor in factors]


@pytest.mark.parametrize("order", [0.6, 1.0, 1.37, 2.0])
@pytest.mark.parametrize("factors", [(1.0, 2.0, 4.0), (1 / 1.5, 1.0, 1.5)])
def test_a_series_of_one_order_is_summed_exactly(order, factors):
    estimate = extrapolated(ladder(order, factors))
    assert estimate.order == pytest.approx(order)
    assert estimate.change == pytest.approx(0.4, rel=1e-9)


@pytest.mark.parametrize("order", [0.5, 0.8, 1.0, 1.5, 2.0, 3.0])
@pytest.mark.parametrize("factors", [(1.0, 2.0), (1.0, 1.5), (1.0, 4.0)])
def test_two_values_hold_the_limit_of_all_usual_orders(order, factors):
    estimate = extrapolated(ladder(order, factors))
    assert estimate.order is None
    assert abs(estimate.change - 0.4) <= estimate.half_width


@pytest.mark.parametrize("seed", range(20))
def test_two_orders_at_once_lie_within_the_bar_of_three_values(seed):
    first, second = np.random.default_rng(seed).uniform(0.2, 1.0, 2)
    values = [(k, 2.0 + first / k + second / k**2) for k in (1.0, 2.0, 4.0)]
    estimate = extrapolated(values)
    assert abs(estimate.change + first + second) <= estimate.half_width < 0.75 * (first + second)


@pytest.mark.parametrize("cubic", [1.715, 1.72, 1.73, 1.75])
def test_a_last_difference_that_is_small_by_chance_says_little(cubic):
    """An error of h^2 - c h^3, which is nearly the same at a half and at a quarter."""
    values = [(k, 2.0 + k**-2 - cubic * k**-3) for k in (1.0, 2.0, 4.0)]
    estimate = extrapolated(values)
    assert estimate.order > 4.0
    assert abs(values[0][1] + estimate.change - 2.0) <= estimate.half_width < 0.1


def test_three_values_at_unequal_ratios_go_on_from_the_two_finest():
    """What lies before them may be of another kind: here it is the same as the next."""
    values = [(1.0, 5.0), *ladder(1.0, (4.0, 8.0), 4.0, 4.0)]
    estimate = extrapolated(values)
    assert estimate.order is None
    assert abs(estimate.change + 1.0) <= estimate.half_width < 1.5


def test_values_that_swing_have_no_order_and_a_bar_of_their_range():
    estimate = extrapolated([(1.0, 1.0), (2.0, 1.3), (4.0, 1.1)])
    assert estimate.order is None
    low, high = 1.0 + estimate.change - estimate.half_width, 1.0 + estimate.change + estimate.half_width
    assert low <= 1.0 and high >= 1.3


def test_values_that_run_away_get_no_order():
    estimate = extrapolated([(1.0, 1.0), (2.0, 1.1), (4.0, 1.4)])
    assert estimate.order is None
    assert estimate.half_width >= 0.3


def test_what_is_no_more_than_scatter_changes_nothing():
    assert extrapolated([(1.0, 1.0), (2.0, 1.002)], scatter=0.001) == Estimate(0.0, pytest.approx(0.002))
    assert extrapolated([(1.0, 1.0), (2.0, 1.004)], scatter=0.001).change > 0.004


def test_a_bar_of_scatter_holds_what_it_should():
    """Differences of two runs with the same noise, as the one that is to be held."""
    draw = np.random.default_rng(4)
    holds = sum(abs(d[-1]) <= scatter_bar(d[:-1]) for d in draw.normal(size=(2000, 4)))
    assert 0.93 <= holds / 2000 <= 0.97
    assert scatter_bar([]) == 0.0


def test_errors_add_with_their_signs_and_bars_in_squares():
    whole = together([Estimate(0.3, 0.03, 1.0), Estimate(-0.1, 0.04, 2.0)], 0.0, 2.0, 0.12)
    assert whole.change == pytest.approx(0.2)
    assert whole.half_width == pytest.approx(0.13)
    assert whole.order is None
    assert together([Estimate(0.3, 0.03, 1.0)], 0.0, 2.0, 0.0).order == 1.0


def test_a_run_of_all_together_tells_what_they_do_to_each_other():
    parts = [Estimate(0.3, 0.03), Estimate(-0.1, 0.04)]
    apart, crossed = together(parts, None, 2.0, 0.0), together(parts, 0.02, 2.0, 0.0)
    assert crossed.change > 0.22 and crossed.half_width > 0.05
    assert apart.change == pytest.approx(0.2) and apart.half_width == pytest.approx(np.hypot(0.05, 0.1))

"""The lognormal fit of what falls: against made data whose answer is known, and what has no answer."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.optimize import minimize
from scipy.special import log_ndtr, ndtr
from scipy.stats import norm

from masonry.sweeps.fragility.lognormal_fit import lognormal_fit, why_no_fit

MEDIAN, DISPERSION = 0.4, 0.5


def made(rng, records, scales):
    """Runs of records whose own intensity to fall is lognormal: intensity, fallen, record of each."""
    capacity = MEDIAN * np.exp(DISPERSION * rng.normal(size=records))
    intensity = np.tile(scales, records)
    record = np.repeat(np.arange(records), len(scales))
    return intensity, intensity >= capacity[record], record


def test_many_runs_give_the_distribution_that_they_were_drawn_from():
    rng = np.random.default_rng(0)
    fit = lognormal_fit(*made(rng, 20_000, [0.1, 0.2, 0.4, 0.6, 0.9]))
    assert fit.median == pytest.approx(MEDIAN, rel=0.01)
    assert fit.dispersion == pytest.approx(DISPERSION, rel=0.02)
    assert fit.share(np.array([MEDIAN])) == pytest.approx([0.5], abs=0.01)


def test_the_top_of_the_likelihood_is_that_of_another_search():
    intensity, fallen, _ = made(np.random.default_rng(1), 30, [0.2, 0.3, 0.5, 0.8])
    fit = lognormal_fit(intensity, fallen)

    def loss(x):
        return -log_ndtr(np.where(fallen, 1.0, -1.0) * np.log(intensity / np.exp(x[0])) / np.exp(x[1])).sum()

    best = minimize(loss, [np.log(0.5), np.log(0.3)], method="Nelder-Mead", options={"xatol": 1e-9, "fatol": 1e-12})
    assert [fit.median, fit.dispersion] == pytest.approx(np.exp(best.x), rel=1e-6)
    assert fit.log_likelihood == pytest.approx(-best.fun, abs=1e-9)


def test_the_covariance_of_independent_runs_is_the_inverse_of_the_curvature():
    intensity, fallen, _ = made(np.random.default_rng(2), 4000, [0.2, 0.3, 0.5, 0.8])
    fit = lognormal_fit(intensity, fallen)

    def loss(log_median, dispersion):
        return -log_ndtr(np.where(fallen, 1.0, -1.0) * (np.log(intensity) - log_median) / dispersion).sum()

    at, h = (np.log(fit.median), fit.dispersion), 1e-4
    curvature = np.zeros((2, 2))
    for i in range(2):
        for j in range(2):
            a, b = np.eye(2)[i] * h, np.eye(2)[j] * h
            curvature[i, j] = sum(s * loss(*(at + x)) for s, x in ((1, a + b), (-1, a - b), (-1, b - a), (1, -a - b)))
    assert fit.covariance == pytest.approx(np.linalg.inv(curvature / (4.0 * h * h)), rel=0.1, abs=1e-6)


def test_bands_hold_the_truth_as_often_as_they_say_though_runs_of_a_record_go_together():
    """Of 300 repeats with 30 records at 5 scales, as near to 90 % as so few records allow."""
    rng, inside, alone = np.random.default_rng(3), [], []
    at = np.array([0.25, 0.4, 0.7])
    truth = ndtr(np.log(at / MEDIAN) / DISPERSION)
    for _ in range(300):
        intensity, fallen, record = made(rng, 30, [0.15, 0.3, 0.45, 0.6, 0.9])
        for runs, counts in ((record, inside), (None, alone)):
            low, high = lognormal_fit(intensity, fallen, runs).band(at, 0.9)
            counts.append((low <= truth) & (truth <= high))
    assert np.mean(inside, axis=0) == pytest.approx([0.9] * 3, abs=0.06)
    assert np.mean(alone, axis=0).mean() < np.mean(inside, axis=0).mean()  # as if all were independent: too narrow


def test_runs_of_a_record_add_up_their_scores_with_the_factor_of_few_records():
    """White's sandwich for 7 records of unlike numbers of runs, G/(G - 1): scores by differences of the likelihood."""
    rng = np.random.default_rng(8)
    record = np.repeat(np.arange(7), [2, 5, 3, 6, 4, 7, 3])
    intensity = rng.uniform(0.2, 0.8, len(record))
    fallen = intensity * np.exp(0.4 * rng.normal(size=7))[record] > 0.45
    fit = lognormal_fit(intensity, fallen, record)
    columns, signs = np.column_stack([np.ones(len(record)), np.log(intensity)]), np.where(fallen, 1.0, -1.0)

    def loss(line):
        return log_ndtr(signs * (columns @ line))

    h = 1e-5
    scores = np.column_stack([(loss(fit.line + h * e) - loss(fit.line - h * e)) / (2.0 * h) for e in np.eye(2)])
    sums = np.array([scores[record == one].sum(axis=0) for one in range(7)])
    at = columns @ fit.line
    weight = norm.pdf(at) ** 2 / (ndtr(at) * ndtr(-at))
    inverse = np.linalg.inv(columns.T @ (columns * weight[:, None]))
    assert fit.of_line == pytest.approx(7.0 / 6.0 * inverse @ sums.T @ sums @ inverse, rel=1e-5)


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 2**32), st.floats(1e-3, 1e3), st.integers(5, 40))
def test_another_unit_scales_the_median_and_the_order_of_runs_does_not_matter(seed, unit, records):
    rng = np.random.default_rng(seed)
    intensity, fallen, record = made(rng, records, [0.15, 0.3, 0.45, 0.6, 0.9])
    assume(not why_no_fit(intensity, fallen))
    fit = lognormal_fit(intensity, fallen, record)
    order = rng.permutation(len(intensity))
    other = lognormal_fit(unit * intensity[order], fallen[order], record[order])
    assert other.median == pytest.approx(unit * fit.median, rel=1e-6)
    assert other.dispersion == pytest.approx(fit.dispersion, rel=1e-6)
    assert other.covariance == pytest.approx(fit.covariance, rel=1e-5, abs=1e-9)
    low, high = fit.band(intensity, 0.9)
    assert ((low <= fit.share(intensity)) & (fit.share(intensity) <= high)).all()
    assert fit.median_band(0.9)[0] < fit.median < fit.median_band(0.9)[1]


@pytest.mark.parametrize(
    ("intensity", "fallen", "words"),
    [
        ([1, 2, 3], [0, 0, 0], "none of 3 runs fell"),
        ([1, 2, 3], [1, 1, 1], "all of 3 runs fell"),
        ([1, 2, 3, 4], [0, 0, 1, 1], "2 to 3"),
        ([1, 2, 2, 3], [0, 0, 1, 1], "at 2"),
        ([1, 2, 3, 4], [1, 1, 0, 0], "below all that stood"),
        ([1, 2, 3, 4], [1, 0, 1, 0], "no curve that grows"),
    ],
)
def test_what_has_no_most_likely_curve_is_said(intensity, fallen, words):
    with pytest.raises(ValueError, match=words):
        lognormal_fit(np.array(intensity), np.array(fallen, dtype=bool))

"""What is said of sizes, on made-up runs whose differences are known."""

import dataclasses

import numpy as np
import pytest

from masonry.laboratory.result import Result
from tests.results.sample import LENGTH, sample
from tests.verification.paper.test_crack_paths import parted
from verification.paper.sizes.claims import (
    capacity_claim,
    curves_claim,
    pattern_claim,
    place_claim,
)
from verification.paper.sizes.families import SECOND, SIZES, Results, curves_apart, straight

PEAK = 0.2e6


def plateau(stress: float) -> Result:
    """A run that carries the same stress all the way."""
    made = sample()
    made.history.rows = {"displacement": np.array([0.0, 3e-4]), "stress": np.array([stress, stress])}
    made.summary |= {"peak_stress_pa": stress, "displacement_at_peak_m": 0.0}
    return made


def of_sizes(*means: float) -> Results:
    """Three seeds of each size, 5 % apart round its mean."""
    return {n: [plateau(m * PEAK * f) for f in (0.95, 1.0, 1.05)] for n, m in zip(SIZES, means, strict=True)}


def test_seeds_that_differ_at_sizes_that_do_not_leave_the_mean_curves_alike():
    sizes, seeds = curves_apart(of_sizes(1.0, 1.0, 1.0))
    assert sizes == pytest.approx(0.0, abs=1e-12)
    assert seeds == pytest.approx(0.05 * 2 / 3)


def test_sizes_that_differ_are_apart_by_the_farthest_from_the_coarse_one():
    sizes, _ = curves_apart(of_sizes(1.0, 0.9, 1.1))
    assert sizes == pytest.approx(0.1)
    assert curves_claim({SECOND: of_sizes(1.0, 0.98, 1.0)}, SECOND, 0.05, "alike").holds
    assert not curves_claim({SECOND: of_sizes(1.0, 0.9, 1.0)}, SECOND, 0.05, "alike").holds


def test_a_peak_that_grows_with_the_size_is_a_dependency_and_scatter_alone_is_none():
    assert capacity_claim({SECOND: of_sizes(1.0, 1.0, 1.0)}, SECOND, quick=False).holds
    grown = capacity_claim({SECOND: of_sizes(1.0, 1.1, 1.2)}, SECOND, quick=False)
    assert not grown.holds and "18 % apart" in grown.measured


def cracked(x: float) -> Result:
    """A wall with one straight crack at x (m)."""
    made = parted()
    here = (np.abs(made.joints.point[:, 0] - x) < 1e-9) & (np.abs(made.joints.normal[:, 0]) > 0.5)
    one = np.where(here, 1.0, 0.0)
    frame = made.history.frames[-1]
    made.history.frames[-1] = dataclasses.replace(frame, damage_tension=one, damage_shear=0 * one, opening=1e-4 * one)
    return made


def test_straight_cracks_are_told_from_stepped_ones_and_those_at_mid_length_from_others():
    middle, beside, stepped = cracked(LENGTH), cracked(1.5 * LENGTH), parted()
    assert straight({218: [middle], 335: [beside], 540: [stepped]}) == (2, 1, 3)
    assert pattern_claim({SECOND: {218: [middle, beside]}}).holds
    assert not pattern_claim({SECOND: {218: [middle, stepped]}}).holds
    assert place_claim({SECOND: {218: [middle]}}).holds
    assert not place_claim({SECOND: {218: [middle, beside]}}).holds

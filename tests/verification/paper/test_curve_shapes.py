"""Numbers of a curve, on curves whose numbers are known."""

import numpy as np
import pytest

from masonry.laboratory.result import Result
from tests.results.sample import sample
from verification.paper.walls.curve_shape import (
    apart,
    energy_per_section,
    fall_to,
    left_after,
    steepest_fall,
    stress_at,
)

PEAK_AT, PEAK, END = 4e-5, 0.2e6, 4e-4


def curve(after: np.ndarray) -> Result:
    """Straight to the peak, then `after` (shares of the peak at equal displacements from the peak to the end)."""
    made = sample()
    u = np.concatenate([[0.0], np.linspace(PEAK_AT, END, len(after))])
    made.history.rows = {"displacement": u, "stress": PEAK * np.concatenate([[0.0], after])}
    made.summary |= {"peak_stress_pa": PEAK, "displacement_at_peak_m": PEAK_AT, "section_m2": 0.002}
    made.summary |= {"energy_j": {"fracture_mode_1": 0.02, "fracture_mode_2": 0.01, "friction": 0.03}}
    return made


def test_a_straight_fall_leaves_what_is_left_of_its_way():
    straight = curve(np.linspace(1.0, 0.0, 10))
    assert left_after(straight, 2.0) == pytest.approx(1.0 - PEAK_AT / (END - PEAK_AT))
    assert fall_to(straight, 0.5) == pytest.approx(0.5 * (END - PEAK_AT))
    assert steepest_fall(straight, 1e-5) == pytest.approx(1e-5 / (END - PEAK_AT))


def test_a_stress_that_stays_up_never_falls_to_half_and_a_drop_is_found_wherever_it_is():
    assert np.isnan(fall_to(curve(np.ones(10)), 0.5))
    drop = curve(np.concatenate([np.ones(30), 0.4 * np.ones(30)]))
    assert steepest_fall(drop, 2e-5) == pytest.approx(0.6)


def test_curves_are_apart_by_their_mean_difference_over_the_peak():
    whole, lower = curve(np.ones(10)), curve(0.9 * np.ones(10))
    assert apart(whole, whole) == 0.0
    assert apart(lower, whole, begin=PEAK_AT) == pytest.approx(0.1)
    assert stress_at(lower, 2 * END) == pytest.approx(0.9 * PEAK)


def test_energies_are_given_for_each_square_metre_of_the_section():
    made = sample()
    made.summary |= {
        "energy_j": {"fracture_mode_1": 0.02, "fracture_mode_2": 0.01, "friction": 0.03},
        "section_m2": 0.002,
    }
    assert energy_per_section(made) == pytest.approx(
        {"mode I": 10.0, "mode II": 5.0, "friction": 15.0, "fracture": 15.0}
    )

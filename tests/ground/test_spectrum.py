"""Response spectra against closed forms: steps, pulses, sines, and what scaling and refining must leave alone."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from masonry.ground.spectrum import periods_between, response_spectrum


@pytest.mark.parametrize("damping", [0.0, 0.05, 0.3])
def test_a_constant_acceleration_is_answered_by_that_of_a_step(damping):
    periods = np.array([0.05, 0.3, 1.0])
    spectrum = response_spectrum(np.linspace(0.0, 4.0, 401), np.full(401, 2.0), periods, damping)
    overshoot = np.exp(-damping * np.pi / np.sqrt(1.0 - damping**2))
    assert spectrum.pseudo_acceleration == pytest.approx(2.0 * (1.0 + overshoot), rel=1e-4)


def test_the_free_swing_after_a_pulse_counts():
    """A half sine of length d answered by undamped oscillators; after it (T > 2 d) the amplification is
    2 b/(1 - b^2) cos(pi/(2 b)) with b = T/(2 d): Clough and Penzien, Dynamics of Structures, section 5.3."""
    length = 0.4
    time = np.linspace(0.0, length, 4001)
    periods = np.array([1.0, 1.6, 4.0])
    spectrum = response_spectrum(time, np.sin(np.pi * time / length), periods, 0.0)
    beta = periods / (2.0 * length)
    closed_form = np.abs(2.0 * beta / (1.0 - beta**2) * np.cos(np.pi / (2.0 * beta)))
    assert spectrum.pseudo_acceleration == pytest.approx(closed_form, rel=1e-5)


def test_a_long_sine_at_resonance_is_amplified_by_1_over_twice_the_damping():
    time = np.arange(0.0, 60.0, 0.01)
    spectrum = response_spectrum(time, np.sin(2.0 * np.pi * time), np.array([1.0]), 0.05)
    assert spectrum.pseudo_acceleration[0] == pytest.approx(10.0, rel=5e-4)  # straight lines within a sine: 3e-4


def test_an_integration_of_other_make_finds_the_same():
    rng = np.random.default_rng(1)
    time = np.concatenate([[0.0], np.cumsum(rng.uniform(0.002, 0.03, 200))])
    acceleration = rng.normal(size=201)
    for period in (0.03, 0.2, 2.0):
        rate = 2.0 * np.pi / period
        swing = solve_ivp(
            lambda t, y, w=rate: (y[1], -0.1 * w * y[1] - w * w * y[0] - np.interp(t, time, acceleration, right=0.0)),
            (0.0, time[-1] + period),
            (0.0, 0.0),
            max_step=min(period / 60.0, 0.002),
            rtol=1e-8,
            atol=1e-12,
        )
        largest = np.abs(swing.y[0]).max()
        ours = response_spectrum(time, acceleration, np.array([period])).displacement[0]
        assert ours == pytest.approx(largest, rel=2e-3)


def test_limits_of_stiff_and_soft_oscillators():
    rng = np.random.default_rng(3)
    time = np.arange(401) * 0.025
    acceleration = rng.normal(size=401) * np.sin(np.pi * time / 10.0) ** 2
    stiff = response_spectrum(time, acceleration, np.array([4e-4])).pseudo_acceleration[0]
    assert stiff == pytest.approx(np.abs(acceleration).max(), rel=2e-2)
    velocity = np.concatenate([[0.0], np.cumsum(0.025 * (acceleration[1:] + acceleration[:-1]) / 2.0)])
    ground = np.concatenate([[0.0], np.cumsum(0.025 * (velocity[1:] + velocity[:-1]) / 2.0)])
    soft = response_spectrum(time, acceleration - velocity[-1] / 10.0, np.array([1e5])).displacement[0]
    level = ground - velocity[-1] / 10.0 * time**2 / 2.0
    assert soft == pytest.approx(np.abs(level).max(), rel=5e-2)


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 2**32), st.floats(0.01, 100.0), st.floats(0.0, 0.5), st.integers(2, 5))
def test_scaling_scales_and_samples_on_the_straight_lines_change_nothing(seed, factor, damping, parts):
    rng = np.random.default_rng(seed)
    time = np.concatenate([[0.0], np.cumsum(rng.uniform(0.01, 0.02, 60))])
    acceleration, periods = rng.normal(size=61), periods_between(0.03, 3.0, 7)
    spectrum = response_spectrum(time, acceleration, periods, damping).displacement
    scaled = response_spectrum(time, -factor * acceleration, periods, damping).displacement
    assert scaled == pytest.approx(factor * spectrum, rel=1e-9)
    fine = np.interp(np.arange(60 * parts + 1) / parts, np.arange(61), time)
    refined = response_spectrum(fine, np.interp(fine, time, acceleration), periods, damping).displacement
    assert refined == pytest.approx(spectrum, rel=2e-4)
    late = response_spectrum(time + 1000.0, acceleration, periods, damping).displacement
    assert late == pytest.approx(spectrum, rel=1e-6)


@pytest.mark.parametrize(
    ("time", "acceleration", "periods", "damping"),
    [
        ([0.0], [1.0], [1.0], 0.05),
        ([0.0, 1.0], [1.0], [1.0], 0.05),
        ([0.0, 0.0], [1.0, 2.0], [1.0], 0.05),
        ([0.0, 1.0], [1.0, np.nan], [1.0], 0.05),
        ([0.0, 1.0], [1.0, 2.0], [0.0], 0.05),
        ([0.0, 1.0], [1.0, 2.0], [1.0], 1.0),
    ],
)
def test_what_is_no_record_is_refused(time, acceleration, periods, damping):
    with pytest.raises(ValueError, match=r"must|damping"):
        response_spectrum(np.array(time), np.array(acceleration), np.array(periods), damping)

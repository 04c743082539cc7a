"""Records that are made by seed: of their spectrum, at rest at the end, the same for the same seed."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from masonry.ground.made import DIGIT, Recipe, make_record
from masonry.ground.resting import at_rest, residuals, rounded
from masonry.ground.target_spectrum import Eurocode8, FilteredNoise, TableSpectrum

SOIL = Eurocode8(1, "B", 2.0)
SHORT = Recipe(SOIL, 10.0, 0.01, 1.5, 4.0, longest=2.0)
NOISE = Recipe(FilteredNoise((15.0, 0.6), (1.5, 0.6)), 10.0, 0.01, 1.5, 4.0, peak=3.0)
OF_NOISE = [-817504, 1047383, -724350, -69815]
OF_SHORT = [-383647, 953051, -736235, -273389]


@pytest.mark.parametrize("seed", [0, 1])
def test_a_record_has_its_spectrum_and_ends_at_rest(seed):
    record = make_record(SHORT, seed)
    assert record.mismatch == np.abs(record.spectrum.pseudo_acceleration / record.target - 1.0).max() <= SHORT.tolerance
    assert record.target == pytest.approx(SOIL.at(record.spectrum.periods))
    velocity, displacement = residuals(record.time, record.acceleration)
    assert abs(velocity) < 1e-12 and abs(displacement) < 1e-11
    assert record.acceleration[0] == record.acceleration[-1] == 0.0
    assert np.rint(record.acceleration / DIGIT) * DIGIT == pytest.approx(record.acceleration, abs=1e-15)


def test_the_same_seed_is_the_same_record_and_another_seed_or_component_another():
    first = make_record(SHORT, 1).acceleration
    make_record.cache_clear()
    assert np.array_equal(make_record(SHORT, 1).acceleration, first)
    others = [make_record(SHORT, 2).acceleration, make_record(SHORT, 1, 1).acceleration]
    assert max(abs(np.corrcoef(first, other)[0, 1]) for other in others) < 0.2


def test_a_record_of_today_is_that_of_other_processors_and_days():
    places = [100, 300, 500, 700]
    for recipe, expected in ((NOISE, OF_NOISE), (SHORT, OF_SHORT)):
        samples = np.rint(make_record(recipe, 7).acceleration / DIGIT).astype(int)
        assert samples[places].tolist() == expected


def test_the_power_of_many_records_is_that_of_the_soil():
    """The mean power over 40 seeds in bands of an octave, within the scatter of such a mean."""
    recipe = replace(NOISE, duration=40.96, strong=39.0, rise=0.5, longest=4.0, shortest=0.25)
    spectra = []
    for seed in range(40):
        acceleration = make_record(recipe, seed).acceleration[:-1]
        spectra.append(np.abs(np.fft.rfft(acceleration / np.sqrt(np.mean(acceleration**2)))) ** 2)
    rates = 2.0 * np.pi * np.fft.rfftfreq(4096, 0.01)
    theirs, ours = recipe.spectrum.power(rates), np.mean(spectra, axis=0)
    bands = [(rates > low) & (rates <= 2.0 * low) for low in (3.0, 6.0, 12.0, 24.0)]
    shares = [[part[band].sum() / part[rates > 3.0].sum() for band in bands] for part in (ours, theirs)]
    assert shares[0] == pytest.approx(shares[1], rel=0.1)
    assert np.abs(make_record(NOISE, 1).acceleration).max() == pytest.approx(3.0, abs=DIGIT)


def test_the_spectra_of_eurocode_8_at_its_corners():
    """EN 1998-1, equations 3.2 to 3.5, by hand: soil B of type 1, and D of type 2 at 20 % of damping."""
    assert SOIL.at(np.array([0.0, 0.075, 0.15, 0.5, 1.0, 4.0])) == pytest.approx([2.4, 4.2, 6.0, 6.0, 3.0, 0.375])
    damped = Eurocode8(2, "D", 1.0, 0.2)
    assert damped.at(np.array([0.2, 0.6, 2.4])) == pytest.approx(1.8 * 2.5 * np.sqrt(0.4) * np.array([1, 0.5, 0.0625]))


EUROCODE_8 = {
    (1, "A"): (1.0, 0.15, 0.4, 2.0),
    (1, "B"): (1.2, 0.15, 0.5, 2.0),
    (1, "C"): (1.15, 0.2, 0.6, 2.0),
    (1, "D"): (1.35, 0.2, 0.8, 2.0),
    (1, "E"): (1.4, 0.15, 0.5, 2.0),
    (2, "A"): (1.0, 0.05, 0.25, 1.2),
    (2, "B"): (1.35, 0.05, 0.25, 1.2),
    (2, "C"): (1.5, 0.1, 0.25, 1.2),
    (2, "D"): (1.8, 0.1, 0.3, 1.2),
    (2, "E"): (1.6, 0.05, 0.25, 1.2),
}
"""EN 1998-1:2004, tables 3.2 and 3.3: by type and ground S, T_B, T_C and T_D (s)."""


@pytest.mark.parametrize(("kind", "soil"), EUROCODE_8)
def test_each_number_of_tables_3_2_and_3_3_holds_on_both_of_its_sides(kind, soil):
    """A hundredth before and behind each corner, where another branch of the spectrum is; 5 % of damping, 3 m/s2."""
    factor, first, second, third = EUROCODE_8[kind, soil]
    before, behind = 0.99, 1.01
    periods = [before * first, behind * first, before * second, behind * second, before * third, behind * third]
    branches = [(1.0 + 1.5 * before) / 2.5, 1.0, 1.0, 1.0 / behind]
    branches += [second / (before * third), second / (behind**2 * third)]
    spectrum = Eurocode8(kind, soil, 3.0).at(np.array([0.0, *periods]))
    assert spectrum == pytest.approx(3.0 * factor * np.array([1.0, *(2.5 * np.array(branches))]), rel=1e-12)


@pytest.mark.parametrize(
    ("damping", "eta"), [(0.05, 1.0), (0.02, (10 / 7) ** 0.5), (0.28, (10 / 33) ** 0.5), (0.29, 0.55)]
)
def test_damping_lowers_a_spectrum_to_no_less_than_55_per_cent(damping, eta):
    assert Eurocode8(1, "D", 1.0, damping).at(np.array([0.3])) == pytest.approx([1.35 * 2.5 * eta])


def test_a_table_is_straight_between_logarithms():
    table = TableSpectrum((0.1, 1.0), (10.0, 1.0))
    assert table.at(np.array([0.01, 0.1, 0.1**0.5, 1.0, 9.0])) == pytest.approx([10.0, 10.0, 10.0**0.5, 1.0, 1.0])


def test_soil_that_is_one_oscillator_has_the_power_of_kanai_and_tajimi():
    soil = FilteredNoise((10.0, 0.5))
    assert soil.power(np.array([0.0, 10.0, 1e5])) == pytest.approx([1.0, 2.0, 1e-8], rel=1e-6)
    assert FilteredNoise((10.0, 0.5), (1.0, 0.5)).power(np.array([1e-3]))[0] == pytest.approx(1e-12, rel=1e-5)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"duration": 10.003}, "whole number of steps"),
        ({"strong": 9.0}, "shorter together"),
        ({"longest": 6.0}, "half of the duration"),
        ({"shortest": 0.02}, "four steps"),
        ({"tolerance": 1e-3, "duration": 5.0, "strong": 2.0, "longest": 1.0, "shortest": 0.25}, "not reached"),
    ],
)
def test_what_cannot_be_made_is_refused(change, words):
    with pytest.raises(ValueError, match=words):
        make_record(replace(SHORT, **change), 1)


@settings(max_examples=50, deadline=None)
@given(st.integers(0, 2**32), st.integers(64, 2000), st.floats(0.001, 0.1), st.floats(1e-4, 1e3))
def test_rounding_leaves_no_velocity_and_no_displacement(seed, count, step, size):
    time = np.arange(count + 1) * step
    envelope = np.sin(np.pi * time / time[-1]) ** 2
    acceleration = at_rest(time, size * np.random.default_rng(seed).normal(size=count + 1) * envelope, envelope)
    samples = rounded(acceleration, 1e-6)
    whole = np.rint(samples / 1e-6).astype(np.int64)
    assert whole.sum() == 0 and (np.arange(count + 1) * whole).sum() == 0 and whole[0] == whole[-1] == 0
    assert np.abs(samples - acceleration).max() < 1e-6 * (2.0 + count)

"""The rows that count for a peak, and the rows of standard tests and measured curves, which need not begin at zero."""

import numpy as np
import pytest

from masonry.rows.measured_curve import ForcePath, cut, cycles, envelope, farthest_apart, numbers_of
from masonry.rows.peak import at_peak, before_a_collapse, before_a_fall, lowest_row, peak_row, reached
from masonry.rows.standard_test import compression, diagonal_compression


def rows(**columns):
    return {name: np.array(values, dtype=float) for name, values in columns.items()}


def path(place, force):
    return ForcePath(np.array(place, dtype=float), np.array(force, dtype=float))


@pytest.mark.parametrize(("peak", "least"), [(100.0, 99.9), (-100.0, -100.1), (0.0, 0.0)])
def test_what_is_within_a_thousandth_below_a_peak_counts_as_reaching_it(peak, least):
    assert reached(peak) == pytest.approx(least, rel=1e-12)


def test_rows_from_the_last_one_before_the_drive_moves_count():
    """While dead loads settle the stress is no strength, but at their end it is where the drive sets out."""
    curve = rows(displacement=[0, 0, 0, 2, 3, 5], stress=[9, -9, 4, 3, -1, -2])
    assert (peak_row(curve), lowest_row(curve)) == (2, 5)
    assert peak_row(rows(displacement=[0, 0, 0], stress=[1, 2, 3])) == 2, "nothing moves: all rows count"
    assert peak_row(rows(displacement=[0, 1, 2, 3], stress=[-9, -4.003, -4, -6])) == 1, "below zero all along"


def test_a_plateau_counts_from_where_it_is_reached_unless_the_drive_turns_back():
    flat = rows(displacement=[0, 1, 2, 3, 4], stress=[0, 7, 99.95, 100, 80])
    assert peak_row(flat) == 2
    assert peak_row(flat | rows(displacement=[0, 1, 2, 3, 2.5])) == 3


def test_a_value_at_the_peak_lies_between_rows_of_a_drive_that_goes_one_way():
    values = np.array([10.0, 20.0, 50.0, 70.0])
    one_way = rows(displacement=[0, 1, 3, 4], stress=[0, 2, 9, 5])
    assert at_peak(one_way, values, 2.5) == pytest.approx(42.5)
    assert at_peak(one_way | {"displacement": -one_way["displacement"]}, values, -2.5) == pytest.approx(42.5)
    assert at_peak(one_way | rows(displacement=[0, 3, 1, 4]), values, 2.5) == 50.0


def test_what_comes_once_it_falls_is_no_peak():
    curve = rows(load_factor=[0, 0.5, 0.75, 1.0, 1.0], stress=[1, 2, 3, 4, 5], step=[0, 10, 20, 30, 40])
    assert before_a_fall(curve, 1.0)["stress"].tolist() == [1, 2, 3]
    assert before_a_fall(curve, None) is curve and before_a_collapse(curve, None) is curve
    assert before_a_collapse(curve, 20)["stress"].tolist() == [1, 2, 3]


def test_numbers_of_a_measured_curve_count_from_where_it_sets_out():
    """From 2 m and 5 N: the secant at 0.7 of the rise of 20 N, first reached 1.4 m on; areas count with all forces."""
    numbers = numbers_of(path([2, 3, 4, 6], [5, 15, 25, 12]))
    assert (numbers.peak, numbers.at_peak) == (25.0, 4.0)
    assert numbers.stiffness == pytest.approx(14.0 / 1.4)
    assert numbers.energy == pytest.approx(10.0 + 20.0 + 37.0)
    assert numbers_of(path([2, 3, 4], [5, 4, 3])).stiffness is None


def test_an_envelope_is_what_lies_farther_out_than_where_the_path_set_out():
    """It sets out at 1 m, goes to -2 m first, and to 4 m then."""
    loop = path([1, -2, 0, 1, 4, -3], [0, -6, -1, 2, 8, -7])
    front, back = envelope(loop), envelope(loop, -1.0)
    assert (front.place.tolist(), front.force.tolist()) == ([1, 4], [0, 8])
    assert (back.place.tolist(), back.force.tolist()) == ([1, -2, -3], [0, -6, -7])
    numbers = numbers_of(loop)
    assert (numbers.lowest, numbers.at_lowest, numbers.peak) == (-7.0, -3.0, 8.0)
    assert cycles(loop) and not cycles(path([1, 2, 1.6, 3], [0, 1, 0.5, 2])) and cycles(path([1, 3, 1.9], [0, 1, 0]))


def test_two_curves_are_compared_as_far_as_both_reach():
    one, other = path([0, 2, 3], [0, 4, 1]), path([0, 1, 5], [0, 5, 9])
    assert farthest_apart(one, other) == pytest.approx(6.0), "at 3 m, where the first one ends"
    assert cut(one, 2.5).force.tolist() == [0, 4, 2.5]


def test_a_standard_test_counts_from_the_load_with_which_it_begins():
    """From 2 to 14 MPa: a third of the rise, 4 MPa, at a strain of 0.5e-3 beyond the first reading of 0.1 mm."""
    force, shorter = 1e4 * np.array([2.0, 4.0, 8.0, 14.0, 9.0]), 1e-4 * np.array([1.0, 1.4, 3.0, 9.0, 20.0])
    strength, modulus, strain = compression(force, shorter, area=0.01, length=0.25)
    at_third = (0.5 * (1.4e-4 + 3.0e-4) - 1e-4) / 0.25
    assert (strength, strain, modulus) == pytest.approx((14e6, at_third, 4e6 / at_third))
    sheared = diagonal_compression(force, 0.75 * shorter, 0.25 * shorter, area=0.01, length=0.25)
    assert sheared == pytest.approx((14e6 / 2**0.5, 4e6 / 2**0.5 / at_third, at_third))

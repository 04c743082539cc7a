"""Cycles of unlike way out and way back, accelerations, ledger columns and frames, by hand."""

from math import inf

import numpy as np
import pytest

from masonry.rows.accelerations import accelerations, regular
from masonry.rows.columns import dissipated_in, gauges_of, stored_in, unit_of
from masonry.rows.cycles import bounds, table
from masonry.rows.history import Frame
from masonry.rows.rest_criterion import DOUBTED, SETTLED, RestCriterion, still_moving

PLACE = np.array([0.0, 0.0, 2.0, 5.0, 1.0, -3.0, -1.0, 3.0, 4.0, 4.0])
STRESS = np.array([7.0, 1.0, 8.0, 20.0, 9.0, -14.0, -6.0, 10.0, 15.0, 15.0])


def curve(**more):
    work = np.array([0.0, 1.0, 3.0, 9.0, 10.0, 14.0, 15.0, 19.0, 23.0, 23.0])
    columns = {"displacement": PLACE, "stress": STRESS, "external_work": 2.0 * work, "fracture_mode_1": 0.5 * work}
    return columns | {"fracture_mode_2": 0.25 * work, "friction": 0.125 * work} | more


def test_a_cycle_ends_between_rows_where_the_drive_passes_its_start_the_way_it_left_it():
    """From -1 to 3 m: a quarter of the way between rows 6 and 7."""
    assert bounds(PLACE) == pytest.approx([1.0, 6.25, 9.0])
    assert bounds(-PLACE) == pytest.approx([1.0, 6.25, 9.0])


def test_a_cycle_has_what_the_drive_met_on_either_side_and_what_was_lost_on_its_way():
    widest = np.array([0.0, 0.0, 1.0, 4.0, 2.0, 1.0, 1.0, 3.0, 5.0, 5.0])
    first, second = table(curve(), widest)
    assert (first["highest_stress_pa"], first["lowest_stress_pa"]) == (20.0, -14.0)
    assert (first["farthest_m"], first["farthest_back_m"]) == (5.0, -3.0)
    assert first["stiffness_pa_per_m"] == pytest.approx(34.0 / 8.0)
    assert first["external_work_j"] == pytest.approx(2.0 * (16.0 - 1.0))
    assert first["dissipated_j"] == pytest.approx(0.875 * 15.0) and first["friction_j"] == pytest.approx(0.125 * 15.0)
    assert (first["widest_opening_m"], first["opening_left_m"]) == (4.0, pytest.approx(1.5))
    assert first["closed"] and not second["closed"], "the last one is not ended"
    assert second["external_work_j"] == pytest.approx(2.0 * 7.0) and second["opening_left_m"] == 5.0


def test_a_load_that_goes_to_and_fro_has_its_loops_over_a_gauge():
    rows = curve(load_factor=PLACE, top=1e-3 * (PLACE**2 + 3.0 * PLACE + 2.0))
    first, second = table(rows, np.zeros(10), "top")
    assert (first["highest_factor"], first["lowest_factor"]) == (5.0, -3.0)
    assert (first["farthest_m"], first["farthest_back_m"]) == pytest.approx((0.042, 0.0))
    assert first["stiffness_per_m"] == pytest.approx(8.0 / (0.042 - 0.002))
    assert first["left_m"] == pytest.approx(0.25e-3 * 20.0) and second["left_m"] == pytest.approx(0.030)


@pytest.mark.parametrize("begin", [0.0, 0.31])
def test_the_acceleration_of_a_quartic_is_its_own_and_waits_for_the_motion(begin):
    """u = t^4: the second difference is 12 t^2 T^2 + 2 T^4, and the term beside takes the 2 T^4 away."""
    time = 0.1 * np.arange(12.0)
    begun = int(np.ceil(begin / 0.1 - 1e-9))
    wanted = 12.0 * time**2
    wanted[: begun + 2], wanted[-2:] = wanted[begun + 2], wanted[-3]
    wanted[:begun] = 0.0
    assert accelerations(time, time**4, begin) == pytest.approx(wanted, rel=1e-9, abs=1e-12)


def test_rows_at_the_end_that_come_early_take_the_value_before_them():
    time = np.append(0.1 * np.arange(8.0), [0.73, 0.75])
    assert regular(time, 0.2) == slice(2, 8)
    read = accelerations(time, np.append(time[:8] ** 4, [9.0, -9.0]), 0.0)
    assert read[-4:] == pytest.approx([12.0 * 0.25] * 4), "that of the last row with two beside it"


@pytest.mark.parametrize(
    ("column", "unit"),
    [("load_factor", "1"), ("ground_y", "m/s2"), ("plastic_bars", "J"), ("rotor", "J"), ("stress", "Pa"), ("top", "m")],
)
def test_each_column_has_its_unit(column, unit):
    assert unit_of(column) == unit


def test_what_is_dissipated_and_stored_counts_bars_and_crushing_where_they_are():
    cracks = ("fracture_mode_1", "fracture_mode_2", "friction")
    assert dissipated_in(["kinetic", *cracks]) == cracks
    assert dissipated_in(["plastic_bars", "crushing", *cracks]) == (*cracks, "crushing", "plastic_bars")
    terms = {"elastic_blocks": 1.0, "elastic_contacts": 20.0, "elastic_bars": 300.0, "plastic_bars": 4000.0}
    assert stored_in(terms) == 321.0 and stored_in(dict(list(terms.items())[:2])) == 21.0
    assert gauges_of(["step", "top", "ground_x", "plastic_bars", "crushing", "input_energy", "dashpot"]) == ["top"]
    moving = terms | {"kinetic": 3.21, "external_work": -50.0}
    assert still_moving(moving) == pytest.approx(0.01)
    assert still_moving({**dict.fromkeys(terms, 0.0), "kinetic": 2.0, "external_work": -1e6}) == pytest.approx(2.0)


def test_one_block_may_swing_ten_times_as_far_as_all_together():
    one = RestCriterion(2e-3, 5e-6, looks=3).of_block
    assert (one.force, one.energy, one.looks) == pytest.approx((2e-2, 5e-4, 3))
    assert one.with_share(0.5) == pytest.approx((1e-2, 5e-4, 3)) and RestCriterion(inf, 1.0).holds(1e9, 1.0)
    assert DOUBTED.holds(1e-3, 1e-6) and not DOUBTED.holds(1.01e-3, 1e-6) and not SETTLED.holds(1e-4, 1.01e-8)


def test_a_joint_parts_by_opening_and_slip_and_not_by_overlap():
    one, opening, slip = np.ones(3), np.array([3.0, -3.0, 0.0]), np.array([4.0, 4.0, 2.0])
    frame = Frame(0, 0.0, 0.0, one, one, opening, slip, one, one, 0.2 * one, np.array([0.5, 0.0, 1.0]), one)
    assert frame.parted.tolist() == [5.0, 4.0, 2.0]
    assert frame.damage == pytest.approx([0.6, 0.2, 1.0])

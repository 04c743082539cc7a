"""Bonds: no gap, no overlap, flush ends, and no head joint above another."""

import numpy as np
import pytest

from geometry.blocks import GeometryError
from geometry.polyhedra.measures import volumes
from geometry.specimens.bond import COURSES, lay
from geometry.specimens.wallette import wallette

UNIT, JOINT, WIDTH, THICKNESS = (0.24, 0.113), 0.01, 0.115, 0.0115
WALL = {"courses": 5, "unit_length": UNIT[0], "unit_height": UNIT[1], "thickness": THICKNESS, "joint_thickness": JOINT}


def bond(name, units, courses=5):
    return lay(name, courses, units, UNIT, JOINT, THICKNESS, WIDTH)


def head_joints(laid, course):
    return np.sort(laid.low[laid.course == course, 0])[1:]


def test_running_bond_shifts_every_second_course_by_half_a_unit():
    laid = bond("running", 2, 4)
    assert np.bincount(laid.course).tolist() == [2, 3, 2, 3]
    assert laid.parts.tolist() == [4, 4, 2, 4, 2] * 2
    assert [head_joints(laid, c).tolist() for c in range(4)] == [[0.25], [0.125, 0.375]] * 2
    assert (laid.length, laid.height) == (0.5, 0.492)


def test_half_a_unit_more_ends_the_courses_of_a_running_bond_now_right_now_left():
    laid = bond("running", 2.5, 3)
    assert laid.parts.tolist() == [4, 4, 2, 2, 4, 4, 4, 4, 2]
    assert [head_joints(laid, c).tolist() for c in range(2)] == [[0.25, 0.5], [0.125, 0.375]]
    assert laid.length == 0.625 and all(laid.high[laid.course == c, 0].max() == 0.625 for c in range(3))


@pytest.mark.parametrize(("name", "units"), [("stack", 2.5), ("header", 2.5), ("running", 2.25), ("running", 0.5)])
def test_parts_of_a_unit_are_refused_elsewhere(name, units):
    with pytest.raises(GeometryError, match=f"number of units along x is {units}"):
        wallette(**WALL, units_per_course=units, bond=name, unit_width=WIDTH)


@pytest.mark.parametrize("units", [2, 3, 6])
@pytest.mark.parametrize("name", COURSES)
def test_the_courses_of_a_bond_are_filled_from_flush_end_to_flush_end(name, units):
    laid = bond(name, units)
    for c in range(5):
        mine = laid.course == c
        low, high = laid.low[mine], laid.high[mine]
        assert (low[0, 0], high[-1, 0]) == (0.0, laid.length)
        assert np.array_equal(high[:-1, 0], low[1:, 0]), "the next module begins where one ends"
        assert np.ptp(low[:, 2]) == 0.0 == np.ptp(high[:, 2])
    assert np.array_equal(np.unique(laid.high[:, 2])[:-1], np.unique(laid.low[:, 2])[1:])
    volume = np.prod(laid.high - laid.low, axis=1).sum()
    assert volume == pytest.approx(laid.length * THICKNESS * 5 * 0.123, rel=1e-14)


@pytest.mark.parametrize("units", [2, 3, 6])
@pytest.mark.parametrize("name", [name for name in COURSES if name != "stack"])
def test_no_head_joint_comes_nearer_than_a_quarter_to_one_of_the_next_course(name, units):
    laid = bond(name, units)
    whole = 0.25 if name != "header" else 0.125
    for c in range(4):
        apart = np.abs(head_joints(laid, c)[:, None] - head_joints(laid, c + 1))
        assert apart.min() >= whole / 4 - 1e-12


def test_stack_bond_has_all_head_joints_above_each_other():
    laid = bond("stack", 3)
    assert all(np.array_equal(head_joints(laid, c), head_joints(laid, 0)) for c in range(5))


def test_flemish_headers_stand_in_the_middle_of_stretchers():
    laid = bond("flemish", 4)
    middle, header, stretcher = (laid.low + laid.high)[:, 0] / 2, laid.parts == 2, laid.parts == 4
    for c in range(4):
        inner = header & (laid.course == c) & (laid.low[:, 0] > 0) & (laid.high[:, 0] < laid.length)
        below = middle[stretcher & (laid.course == c + 1)]
        assert all(np.abs(below - x).min() < 1e-12 for x in middle[inner])


def test_flemish_closers_stand_beside_the_corner_headers():
    laid = bond("flemish", 4)
    assert laid.parts[laid.course == 1].tolist() == [2, 1, 4, 2, 4, 2, 4, 1, 2]


def test_english_bond_lays_courses_of_headers_on_courses_of_stretchers():
    laid = bond("english", 4)
    assert [sorted(set(laid.parts[laid.course == c].tolist())) for c in range(3)] == [[4], [1, 2], [4]]
    assert laid.parts[laid.course == 1][[1, -2]].tolist() == [1, 1], "closers stand beside the corner headers"


@pytest.mark.parametrize("name", COURSES)
def test_a_wallette_in_any_bond_is_whole(name):
    wall = wallette(**WALL, units_per_course=3, divisions=(4, 2), bond=name, unit_width=WIDTH)
    laid = bond(name, 3)
    assert volumes(wall.blocks).sum() == pytest.approx(laid.length * laid.height * THICKNESS, rel=1e-13)
    assert np.bincount(wall.blocks.unit).tolist() == (2 * laid.parts).tolist()


def test_the_blocks_of_a_part_of_a_unit_are_as_large_as_those_of_a_whole_one():
    wall = wallette(**WALL, units_per_course=3, divisions=(4, 2), bond="flemish", unit_width=WIDTH)
    assert np.ptp(volumes(wall.blocks)) < 1e-12 * volumes(wall.blocks).mean()


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"bond": "dutch"}, "allowed: running, stack, header, english, flemish"),
        ({"bond": "english"}, "unit_width is needed, 0.115 m"),
        ({"bond": "flemish", "unit_width": 0.11}, "unit_width is 0.11 m.*nearest: 0.115 m"),
        ({"bond": "english", "unit_width": 0.115, "units_per_course": 1}, "at least 2 units"),
        ({"bond": "flemish", "unit_width": 0.115, "divisions": (6, 1)}, "a quarter of a unit.*nearest: 4 or 8"),
        ({"unit_width": -1.0}, "unit_width is -1 m"),
    ],
)
def test_a_bond_that_cannot_be_laid_says_what_would_work(change, message):
    with pytest.raises(GeometryError, match=message):
        wallette(**WALL | {"units_per_course": 3} | change)

"""A hollow square tower: its volume, its joints, and a bond without joints that go on from course to course."""

import numpy as np
import pytest

from geometry.blocks import GeometryError
from geometry.joints.find import find_joints
from geometry.polyhedra.measures import bounds
from geometry.structures.tower import tower
from tests.geometry.structures.drawing import area_across, require_sound


def test_the_walls_are_filled_and_lie_on_each_other_over_their_whole_section():
    built = tower(2.0, 0.5, 3, 0.5, 0.2, base=0.3)
    section = 4.0 * 1.5 * 0.5
    assert built.section == pytest.approx(section)
    require_sound(built, 3 * 0.2 * section + 0.3 * 4.0)
    assert area_across(find_joints(built.blocks), 2) == pytest.approx(3 * section)
    walls = [set(built.sets[name].tolist()) for name in ("front", "right", "back", "left")]
    assert sum(map(len, walls)) == len(built.sets["units"]) == 4 * (3 + 4 + 3)
    assert len(set.union(*walls)) == len(built.sets["units"])
    assert len(built.sets["top"]) == 12


def test_joints_of_one_course_lie_apart_from_those_of_the_next():
    built = tower(4.0, 0.5, 2, 0.5, 0.2)
    low, high = bounds(built.blocks)
    front = built.sets["front"]
    courses = front[low[front, 2] < 0.1], front[low[front, 2] > 0.1]
    ends = [np.sort(np.concatenate([low[stones, 0], high[stones, 0]])) for stones in courses]
    inner = [np.unique(np.round(each[1:-1], 9)) for each in ends]
    assert np.abs(inner[0][:, None] - inner[1]).min() > 0.2


def test_at_each_corner_the_walls_pass_each_other_from_course_to_course():
    built = tower(4.0, 0.5, 2, 0.5, 0.2)
    low, high = bounds(built.blocks)
    for x in (-2.0, 2.0):
        holders = []
        for level in (0.0, 0.2):
            at = np.isclose(low[:, 2], level) & np.where(x < 0.0, np.isclose(low[:, 0], x), np.isclose(high[:, 0], x))
            at &= np.isclose(low[:, 1], -2.0)
            (block,) = np.flatnonzero(at)
            holders.append(next(name for name in ("front", "right", "left") if block in built.sets[name]))
        assert holders[0] != holders[1]


@pytest.mark.parametrize(("change", "says"), [
    ({"width": 1.0}, "width is 1 m, it must be more than two walls of 0.5 m"),
    ({"courses": 0}, "number of courses"),
    ({"thickness": -1.0}, "thickness"),
])  # fmt: skip
def test_what_cannot_be_built_is_refused(change, says):
    with pytest.raises(GeometryError, match=says):
        tower(**{"width": 4.0, "thickness": 0.5, "courses": 2, "unit_length": 0.5, "unit_height": 0.2, **change})

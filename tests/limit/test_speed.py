"""Limit analysis of walls in space, pushed out of their plane: right, and in seconds."""

from time import perf_counter

import numpy as np
import pytest

from masonry.statics.solve import largest_factor, standing
from tests.limit.blocks import CONES, PLANE, dry, wall


def seconds_of_a_wall(courses: int, units: int) -> tuple[float, int]:
    """Until a wall 0.1 m thick is known to stand, and to fall over at thickness over height."""
    bodies, contacts = dry(wall(courses, halves_below=True, units=units), [0], 0.65, live=(0.3, 1.0, 0.0))
    begun = perf_counter()
    assert standing(bodies, contacts, CONES).factor == pytest.approx(1.0, abs=1e-7)
    found = largest_factor(bodies, contacts, CONES)
    seconds = perf_counter() - begun
    assert found.factor == pytest.approx(0.1 / (0.175 * courses), rel=1e-6)
    assert found.gap < 1e-6
    return seconds, len(np.unique(contacts.patch))


def test_600_joints_in_space_take_less_than_3_seconds():
    seconds, joints = seconds_of_a_wall(16, 13)
    assert joints > 600 and seconds < 3.0


@pytest.mark.slow
def test_5000_joints_in_space_take_less_than_a_minute():
    seconds, joints = seconds_of_a_wall(40, 44)
    assert joints > 5000 and seconds < 60.0


def test_a_plane_wall_of_600_joints_takes_less_than_3_seconds_and_is_the_same_in_space():
    bodies, contacts = dry(wall(16, halves_below=True, units=13), [0], 0.65)
    begun = perf_counter()
    flat = largest_factor(bodies, contacts, PLANE).factor
    assert perf_counter() - begun < 3.0
    assert largest_factor(bodies, contacts, CONES).factor == pytest.approx(flat, rel=1e-6)

"""The wall between rollers: where the bars stand, what they touch, and the section that makes a force a stress."""

import numpy as np
import pytest

from geometry.blocks import GeometryError
from geometry.cells.request import CellRequest
from geometry.joints.find import find_joints
from geometry.polyhedra.measures import bounds, volumes
from geometry.specimens.bending import bending

WALL = {
    "courses": 6,
    "units_per_course": 3,
    "unit_length": 0.23,
    "unit_height": 0.065,
    "thickness": 0.114,
    "joint_thickness": 0.01,
}
SPAN, HEIGHT = 0.72 - 0.05, 0.45


def strips(specimen):
    """Area and outward (from the wall) normal of what each roller touches of the wall."""
    joints, blocks = find_joints(specimen.blocks), specimen.blocks
    group = blocks.group == blocks.groups.index("rollers")
    touched = {}
    for roller in np.flatnonzero(group):
        a, b = (joints.block_a == roller), (joints.block_b == roller)
        assert not np.any(group[joints.block_b[a]]) and not np.any(group[joints.block_a[b]])
        normal = np.unique(np.concatenate([-joints.normal[a], joints.normal[b]]).round(12), axis=0)
        touched[int(roller)] = joints.area[a | b].sum(), normal.tolist()
    return touched


@pytest.mark.parametrize("filling", [(1, 1, 1), (4, 1, 2), CellRequest(per_unit=8, seed=2)])
def test_every_roller_touches_the_wall_in_a_strip_over_its_height(filling):
    specimen = bending(**WALL, divisions=filling)
    touched = strips(specimen)
    for name, y in (("support rollers", 1.0), ("load rollers", -1.0)):
        for roller in specimen.sets[name]:
            area, normal = touched[roller]
            assert area == pytest.approx(0.01 * HEIGHT, rel=1e-9)
            assert normal == [[0.0, y, 0.0]]


def test_rollers_stand_near_the_ends_and_at_the_third_points():
    specimen = bending(**WALL)
    low, high = bounds(specimen.blocks)
    middle = (low + high) / 2
    supports, loads = specimen.sets["support rollers"], specimen.sets["load rollers"]
    assert np.allclose(middle[supports, 0], [0.025, 0.695])
    assert np.allclose(middle[loads, 0], [0.025 + SPAN / 3, 0.025 + 2 * SPAN / 3])
    assert np.allclose(low[supports, 1], 0.114) and np.allclose(high[loads, 1], 0.0)
    assert np.allclose((high - low)[[*supports, *loads]], (0.01, 0.01, HEIGHT))


def test_the_section_turns_the_force_into_moment_over_section_modulus():
    assert bending(**WALL).section == pytest.approx(HEIGHT * 0.114**2 / SPAN, rel=1e-12)
    arm, force = 0.2, 1000.0
    moment, modulus = force / 2 * arm, HEIGHT * 0.114**2 / 6
    assert force / bending(**WALL, load_distance=arm).section == pytest.approx(moment / modulus, rel=1e-12)


@pytest.mark.parametrize("bond", ["running", "stack", "header", "english", "flemish"])
def test_any_bond_and_any_division_fills_the_wall(bond):
    wall = WALL | {"unit_width": 0.11, "support_distance": 0.03}
    specimen = bending(**wall, bond=bond, divisions=(4, 2, 1), bottom_plate=0.02)
    units = specimen.sets["units"]
    low, high = bounds(specimen.blocks)
    length = high[units, 0].max()
    assert volumes(specimen.blocks)[units].sum() == pytest.approx(length * HEIGHT * 0.114, rel=1e-12)
    plate = specimen.sets["bottom plate"][0]
    assert np.allclose([low[plate], high[plate]], [(0, 0, -0.02), (length, 0.114, 0)])
    assert np.all(low[specimen.sets["bottom course"], 2] < 0.075)
    assert np.all(low[specimen.sets["left end"], 0] == 0.0)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"support_distance": 0.001}, "stands out beyond the end.*nearest: 0.005 m"),
        ({"load_distance": 0.4}, "do not fit beside each other into a span of 0.67 m; a third of it is 0.2233 m"),
        ({"support_distance": 0.4}, "do not fit beside each other"),
        ({"roller_width": -0.01}, "roller_width is -0.01 m"),
        ({"divisions": (1, 1)}, "divisions has 2 numbers, allowed: 3"),
        ({"divisions": (3, 1, 1)}, "half a unit.*nearest: 2 or 4"),
    ],
)
def test_a_wall_that_cannot_be_bent_says_what_would_work(change, message):
    with pytest.raises(GeometryError, match=message):
        bending(**WALL | change)

"""Dry joints of large displacement: force, place and stress that patches bear are told at the joint, by statics."""

from math import cos, radians, sin, tan

import numpy as np
import pytest

from masonry.laboratory import laboratory
from tests.large.made import DENSITY, G, dry, leaning, slab
from tests.scenes import box

WIDE, DEEP, HIGH, COUNT, SLOPE = 0.1, 0.2, 0.1, 3, 5.0
WEIGHT = DENSITY * G * WIDE * DEEP * HIGH


def stack(slope: float, more: str = ""):
    """Boxes on each other on a plane that leans (deg), at rest."""
    lows = [(-0.5 * WIDE, -0.5 * DEEP, HIGH * k) for k in range(COUNT)]
    boxes = [slab(), *(box(f"b{k}", low, (WIDE, DEEP, HIGH), "units", k + 1) for k, low in enumerate(lows))]
    scene = dry(boxes, 2.0, leaning(slope), 0.01, more, settle=60000)
    return laboratory.run(scene.with_({"solver.damping": 0.8}))


@pytest.fixture(scope="module", params=["corners", "spread"])
def result(request):
    return stack(SLOPE, f'patch_points = "{request.param}"')


def test_each_joint_bears_what_stands_upon_it_where_its_weight_acts(result):
    table, slope = result.resultants, radians(SLOPE)
    last = table["moment"] == "end"
    assert table["unit_a"][last].tolist() == [0, 1, 2]
    upon = np.arange(COUNT, 0, -1)  # blocks
    assert table["normal_force"][last] == pytest.approx(-upon * WEIGHT * cos(slope), rel=1e-5)
    assert table["shear_force"][last] == pytest.approx(upon * WEIGHT * sin(slope), rel=5e-4), "the stack leans by 1e-5"
    assert table["place_x"][last] == pytest.approx(0.5 * HIGH * upon * tan(slope), rel=5e-4)
    assert table["place_y"][last] == pytest.approx(np.zeros(COUNT), abs=1e-8)
    assert table["eccentricity"][last] == pytest.approx(HIGH / WIDE * upon * tan(slope), rel=5e-4)


def test_stresses_of_the_contacts_add_up_to_that_and_none_pulls(result):
    frame, joints = result.history.frames[-1], result.joints
    lowest = joints.block_a == 0
    assert frame.normal_stress.max() <= 0.0
    thrust = joints.area[lowest] @ frame.normal_stress[lowest]
    assert thrust == pytest.approx(-COUNT * WEIGHT * cos(radians(SLOPE)), rel=1e-5)
    assert not np.any(frame.damage)


def test_the_stress_of_a_block_is_the_mean_of_what_acts_upon_and_below_it(result):
    """Of the lowest: two and three weights across its top and bottom."""
    stress = result.history.frames[-1].stress[1]
    assert stress[2] == pytest.approx(-2.5 * WEIGHT * cos(radians(SLOPE)) / (WIDE * DEEP), rel=1e-4)
    assert result.history.frames[-1].stress[0] == pytest.approx(np.zeros(6), abs=1e-9)


def test_a_joint_that_opens_presses_at_its_edge_alone():
    """Three blocks lean by 15 degrees: the weight acts at 0.8 of the way to the edge of the lowest joint."""
    result = stack(15.0)
    frame, joints, table = result.history.frames[-1], result.joints, result.resultants
    lowest = joints.block_a == 0
    assert np.all(frame.normal_stress[lowest & (joints.point[:, 0] < -0.4 * WIDE)] == 0.0)
    row = np.flatnonzero((table["moment"] == "end") & (table["unit_a"] == 0))[0]
    assert table["eccentricity"][row] == pytest.approx(3.0 * tan(radians(15.0)), rel=1e-3)


def test_two_joints_of_two_units_bear_what_acts_across_each():
    """A brick in the corner of a floor and a wall of one unit, without friction."""
    boxes = [
        box("slab", (-0.5, -0.1, 0.0), (1.0, 0.2, 0.1), "units", 0),
        box("wall", (0.3, -0.1, 0.1), (0.2, 0.2, 0.4), "units", 0),
        box("brick", (0.1, -0.1, 0.1), (0.2, 0.2, 0.2), "units", 1),
    ]
    supports = ('on = "slab"\nfix = "all"', 'on = "wall"\nfix = "all"')
    contact = {"contact.within_units": {"normal_stiffness": "10 GPa/m", "shear_stiffness": "5 GPa/m"}}
    contact["contact.within_units"]["tan_friction_angle"] = 0.6
    made = dry(boxes, 0.0, (5.0, 0.0, -8.0), 0.01, supports=supports, settle=60000)
    table = laboratory.run(made.with_({**contact, "solver.damping": 0.8})).resultants
    mass = DENSITY * 0.2**3
    rows = {float(table["normal_z"][k]): k for k in np.flatnonzero(table["moment"] == "end")}
    floor, wall = rows[1.0], rows[0.0]
    assert table["normal_force"][[floor, wall]] == pytest.approx([-8.0 * mass, -5.0 * mass], rel=1e-5)
    assert table["shear_force"][[floor, wall]] == pytest.approx([0.0, 0.0], abs=1e-4)
    assert [table["place_y"][floor], table["place_x"][floor]] == pytest.approx([0.0, 0.2], abs=1e-5)
    assert [table["place_y"][wall], table["place_z"][wall]] == pytest.approx([0.0, 0.2], abs=1e-5)


@pytest.mark.parametrize("kinematics", ["rigid", "affine", "tets"])
def test_a_force_is_found_where_it_acts_on_a_block_that_was_pushed_aside(kinematics):
    """A cube is pushed 40 mm aside below another one, without friction."""
    boxes = [slab(1.0), *(box(f"b{k}", (-0.1, -0.1, 0.2 * k), (0.2, 0.2, 0.2), "units", k + 1) for k in range(2))]
    push = '[drive]\non = "b0"\ndirection = "x"\ndisplacement = "40 mm"\nrate = "0.2 m/s"\nramp = 0.1\n'
    made = dry(boxes, 0.0, duration=0.25, settle=4000, more=push)
    elastic = {"young_modulus": "10 GPa", "poisson_ratio": 0.2, "density": f"{DENSITY} kg/m^3"}
    keys = {"kinematics": kinematics, "specimen.mesh_size": "200 mm", "material.units": elastic, "solver.damping": 0.5}
    result = laboratory.run(made.with_(keys))
    table, mass = result.resultants, DENSITY * 0.2**3
    row = np.flatnonzero((table["moment"] == "end") & (table["unit_a"] == 1))[0]
    assert table["normal_force"][row] == pytest.approx(-mass * G, rel=1e-3)
    assert table["shear_force"][row] < 1e-3 * mass * G
    assert table["place_x"][row] == pytest.approx(-0.04, abs=4e-4), "in the lower cube, which has moved"
    slip = result.history.frames[-1].slip[result.joints.block_a == 1]
    assert slip == pytest.approx(np.full(len(slip), 0.04), rel=2e-3)

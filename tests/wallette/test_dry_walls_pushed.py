"""Dry walls and stacks that are pushed along x: they slide at mu N, or rock about an edge, as statics has it."""

import numpy as np
import pytest

from masonry.laboratory import laboratory
from masonry.laboratory.result import Result
from tests.scenes import load

MU, SPECIFIC = 0.65, 1800 * 9.81
"""Friction; weight of a volume, N/m3."""
PUSHED = f"""
law = "friction"
kinematics = "rigid"
[material.units]
density = "1800 kg/m^3"
[contact.unit_unit]
normal_stiffness = "30 GPa/m"
shear_stiffness = "12 GPa/m"
tan_friction_angle = {MU}
[gravity]
z = "-9.81 m/s^2"
[settle]
steps = 20000
[[support]]
on = "BOTTOM"
fix = "all"
[drive]
on = "TOP"
direction = "x"
displacement = "1 mm"
[specimen]
contact_points = "vertex"
"""
WALL = """kind = "wallette"
courses = 4
units_per_course = 2
unit_length = "240 mm"
unit_height = "113 mm"
thickness = "115 mm"
"""
STACK = """kind = "prism"
units = 4
length = "LENGTH"
width = "80 mm"
height = "150 mm"
"""


def pushed(specimen: str, bottom: str, top: str, more: str = "", doubts: tuple[str, ...] = ()) -> Result:
    """The top of a specimen pushed by 1 mm; quasi-static, and nothing else about it is doubted."""
    result = laboratory.run(load(PUSHED.replace("BOTTOM", bottom).replace("TOP", top) + specimen + more))
    assert tuple(doubt.name for doubt in result.doubts) == doubts
    assert result.summary["kinetic_over_internal_max"] < 0.01
    return result


def agrees(result: Result, force: float) -> bool:
    """Peak within 1 %, and the end, at rest, to six digits."""
    end = result.history.rows["force"][-1]
    return bool(np.isclose(result.summary["peak_force_n"], force, rtol=0.01) and np.isclose(end, force, rtol=1e-6))


def test_the_top_course_of_a_dry_wall_slides_at_the_friction_of_its_weight():
    result = pushed(WALL, "bottom course", "top course")
    assert agrees(result, MU * SPECIFIC * 0.48 * 0.113 * 0.115)
    assert result.summary["damping_over_external"] >= 0.0


def test_a_load_on_the_wall_adds_its_own_friction():
    load_on_top = '[[traction]]\non = "top course.z+"\nstress = {z = "-0.05 MPa"}\n'
    result = pushed(WALL, "bottom course", "top course", load_on_top)
    assert agrees(result, MU * (SPECIFIC * 0.48 * 0.113 * 0.115 + 5e4 * 0.48 * 0.115))
    frame, joints = result.history.frames[-1], result.joints
    beds = (np.abs(joints.normal[:, 2]) > 0.5) & np.isclose(joints.point[:, 2], 3 * 0.113)
    assert frame.slip[beds].min() > 0.9e-3, "all of the upper bed slid, and by nearly all of the way"


def test_a_slender_stack_rocks_about_its_lowest_edge():
    """The force acts at the middle of the top unit, 2.5 units above the joint: F * 2.5 h = 3 W b / 2. With many points
    the joint would give way on a strip beside its edge, and bear 4 % less: that is told."""
    result = pushed(STACK.replace("LENGTH", "100 mm"), "bottom", "top", doubts=("few_points",))
    assert agrees(result, 3 * SPECIFIC * 0.1 * 0.08 * 0.15 * 0.5 * 0.1 / (2.5 * 0.15))
    assert result.summary["damping_over_external"] >= 0.0
    eccentricity = result.resultants["eccentricity"][result.resultants["moment"] == "end"]
    assert eccentricity[0] == pytest.approx(1.0, abs=1e-9), "all of the weight stands on the edge of the lowest joint"
    assert eccentricity[1] < 1.0 - 1e-3 and eccentricity[2] < 1.0 - 1e-3


def test_a_broad_stack_slides_below_its_top_unit():
    result = pushed(STACK.replace("LENGTH", "500 mm"), "bottom", "top")
    assert agrees(result, MU * SPECIFIC * 0.5 * 0.08 * 0.15)
    assert result.summary["damping_over_external"] >= 0.0

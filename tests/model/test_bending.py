"""A wall between four rollers: an elastic beam of rigid blocks in stack bond against beam theory; smooth contacts."""

from functools import cache

import numpy as np
import pytest

from masonry.laboratory import laboratory
from masonry.laboratory.result import Result
from tests.scenes import load

LENGTH, HEIGHT, THICKNESS, INSET, ROLLER = 0.9, 0.1, 0.12, 0.05, 0.01
SPAN, NORMAL, SHEAR, STRIP = LENGTH - 2 * INSET, 200e9, 80e9, 2000e9
ARM = SPAN / 3
BEAM = f"""
law = "elastic"
[specimen]
kind = "bending"
courses = 1
units_per_course = 9
unit_length = "100 mm"
unit_height = "{HEIGHT} m"
thickness = "{THICKNESS} m"
bond = "stack"
support_distance = "{INSET} m"
roller_width = "{ROLLER} m"
[material]
units = {{density = "1900 kg/m^3"}}
rollers = {{density = "7850 kg/m^3"}}
plates = {{density = "7850 kg/m^3"}}
[contact.unit_unit]
normal_stiffness = "{NORMAL} Pa/m"
shear_stiffness = "{SHEAR} Pa/m"
[contact.rollers_units]
law = "brittle"
normal_stiffness = "{STRIP} Pa/m"
shear_stiffness = "1 GPa/m"
tensile_strength = "0 Pa"
cohesion = "0 Pa"
friction_angle = "0 deg"
[[support]]
on = "support rollers"
fix = ["x", "y", "z", "rotation x", "rotation y"]
[[support]]
on = "load rollers"
fix = ["x", "z", "rotation x", "rotation y"]
[drive]
on = "load rollers"
direction = "y"
displacement = "10 um"
steps = 30000
"""
PRESSED = (
    BEAM.replace("[material]\n", 'bottom_plate = "20 mm"\n[material]\n').replace("courses = 1", "courses = 3")
    + """
[[support]]
on = "bottom plate"
fix = "all"
[[traction]]
on = "top course.z+"
stress = {z = "-0.25 MPa"}
[settle]
steps = 4000
[contact.plate]
normal_stiffness = "200 GPa/m"
shear_stiffness = "0 GPa/m"
"""
)


@cache
def run(text: str, **overrides) -> Result:
    return laboratory.run(load(text.replace("plates = ", "# plates = ") if text is BEAM else text, **overrides))


def of(result: Result, group: str) -> np.ndarray:
    """(C,) which contact points are of a group."""
    return result.joint_group == result.joint_groups.index(group)


def force(result: Result) -> float:
    """Force of both load rollers together at the end, N."""
    return float(result.history.rows["stress"][-1]) * result.specimen.section


def test_the_reported_stress_is_that_of_the_extreme_fibre_between_the_loads():
    result = run(BEAM)
    assert result.specimen.section == pytest.approx(HEIGHT * THICKNESS**2 / SPAN, rel=1e-12)
    x, y = result.joints.point[:, 0], result.joints.point[:, 1]
    between = of(result, "unit_unit") & (x > INSET + ARM) & (x < INSET + 2 * ARM)
    stress = result.history.frames[-1].normal_stress[between]
    linear = float(result.history.rows["stress"][-1]) * (2 * y[between] / THICKNESS - 1)
    assert len(stress) == 8, "two head joints of four points"
    assert np.allclose(stress, linear, rtol=0, atol=2e-4 * np.abs(linear).max())


def test_every_head_joint_carries_the_moment_and_the_shear_of_the_beam():
    result = run(BEAM)
    frame, joints, load_ = result.history.frames[-1], result.joints, force(result)
    for k in range(1, 9):
        here = of(result, "unit_unit") & np.isclose(joints.point[:, 0], 0.1 * k)
        moment = np.sum(frame.normal_stress * joints.area * (joints.point[:, 1] - THICKNESS / 2), where=here)
        outside = min(0.1 * k, LENGTH - 0.1 * k) - INSET
        shear = np.sum(frame.shear_stress * joints.area, where=here)
        assert moment == pytest.approx(load_ / 2 * min(outside, ARM), rel=1e-3)
        assert shear == pytest.approx(load_ / 2 if outside < ARM else 0.0, abs=1e-3 * load_)


def test_the_deflection_is_that_of_springs_in_bending_in_shear_and_under_the_rollers():
    """F delta = sum of M^2/(kn I) + V^2/(ks A) over the joints + R^2/(k A) over the strips."""
    result = run(BEAM)
    outside = np.minimum(np.arange(1, 9) * 0.1, LENGTH - np.arange(1, 9) * 0.1) - INSET
    bent = np.sum((np.minimum(outside, ARM) / 2) ** 2) / (NORMAL * HEIGHT * THICKNESS**3 / 12)
    sheared = np.sum(outside < ARM) / 4 / (SHEAR * HEIGHT * THICKNESS)
    pressed = 4 / 4 / (STRIP * ROLLER * HEIGHT)
    assert force(result) == pytest.approx(10e-6 / (bent + sheared + pressed), rel=1e-3)


def test_the_support_rollers_carry_what_the_load_rollers_bring():
    summary = run(BEAM).summary
    assert summary["reaction_mismatch_max"] < 1e-3
    assert summary["energy_imbalance"] < 1e-9


def test_rollers_only_press():
    """Driven the other way, the load rollers part from the wall and nothing happens to it."""
    result = run(BEAM, drive__direction="-y")
    assert np.all(result.history.frames[-1].normal_stress <= 0.0)
    assert abs(force(result)) < 1e-6 * force(run(BEAM))


def test_rollers_do_not_rub_and_turn_with_the_wall():
    result = run(BEAM)
    rolled = of(result, "rollers_units")
    frame = result.history.frames[-1]
    assert np.all(frame.shear_stress[rolled] == 0.0)
    assert np.allclose(frame.normal_stress[rolled], -force(result) / 2 / (ROLLER * HEIGHT), rtol=1e-2)


def test_a_pressure_on_the_top_reaches_every_bed_joint_and_the_smooth_plate_holds_no_bending():
    result = run(PRESSED, drive__displacement="1 um")
    frame, bed = result.history.frames[-1], np.abs(result.joints.normal[:, 2]) > 0.5
    assert np.allclose(frame.normal_stress[bed], -0.25e6, rtol=1e-3)
    assert np.count_nonzero(bed & of(result, "plate")) > 0
    assert force(result) == pytest.approx(3 * force(run(BEAM)) / 10, rel=1e-3), "three beams above each other"

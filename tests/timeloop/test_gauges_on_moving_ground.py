"""Gauges of a block that the ground shakes: displacements are relative to the ground, accelerations those of all."""

from functools import cache

import numpy as np
import pytest

from masonry.laboratory import laboratory
from masonry.laboratory.result import Result
from tests.scenes import load

G = 9.80665
SHAKEN = """
law = "friction"
displacements = "large"
kinematics = "rigid"
[specimen]
kind = "boxes"
section = "1 m^2"
[[specimen.box]]
name = "stone"
origin = ["0 m", "0 m", "0 m"]
size = ["1 m", "1 m", "0.2 m"]
[material.units]
density = "2000 kg/m^3"
[contact.floor_units]
normal_stiffness = "1 GPa/m"
shear_stiffness = "1 GPa/m"
tan_friction_angle = 0.2
[floor]
size = ["4 m", "4 m"]
[gravity]
z = "-9.80665 m/s^2"
[ground]
x = "0.5 g * sin(2 pi t / 1 s)"
duration = "1 s"
begin = "0.1 s"
[solver]
masses = "real"
damping = 0
duration = "1.3 s"
"""
GAUGES = "".join(
    f'[[gauge]]\nname = "{quantity} {at}"\nat = "{at}"\ndirection = "-x"\nquantity = "{quantity}"\n'
    for quantity in ("displacement", "velocity", "acceleration")
    for at in ("stone", "floor")
)


@cache
def shaken(friction: float = 0.2) -> Result:
    return laboratory.run(load(SHAKEN + GAUGES, contact__floor_units__tan_friction_angle=friction))


def since(result: Result) -> np.ndarray:
    """s, of each row since the settling."""
    rows, summary = result.history.rows, result.summary
    settle = result.scene_table["settle"]["steps"]
    return rows["time"] - settle * summary.time_step_s


def test_rows_come_200_times_a_second_and_show_the_ground():
    result = shaken()
    rows, time = result.history.rows, since(result)
    shaking = time >= 0.0
    apart = np.diff(time[shaking])[:-1]
    assert np.allclose(apart, apart[0], rtol=1e-9)
    assert 0.005 - result.summary.time_step_s < apart[0] <= 0.005
    assert time[shaking][0] == 0.0
    exact = np.where((time > 0.1) & (time < 1.1), 0.5 * G * np.sin(2.0 * np.pi * (time - 0.1)), 0.0)
    assert np.allclose(rows["ground_x"], exact, atol=1e-3 * 0.5 * G)


def test_the_floor_moves_as_the_ground_and_the_stone_slides_with_no_more_than_friction():
    """Newmark's block: it slips from when the ground accelerates by 0.2 g. Where it begins to, the low-pass swings."""
    rows, time = shaken().history.rows, since(shaken())
    off = np.abs(rows["acceleration floor"] + rows["ground_x"])
    corners = np.minimum(np.abs(time - 0.1), np.abs(time - 1.1)) < 0.01  # the low-pass rounds them
    assert off[~corners].max() < 1e-5 * G and off.max() < 5e-3 * 0.5 * G
    assert np.all(rows["displacement floor"] == 0.0)
    stone = rows["acceleration stone"]
    assert np.abs(stone).max() < 1.05 * 0.2 * G
    slides = (time > 0.18) & (time < 0.7)
    assert np.allclose(stone[slides], -0.2 * G, rtol=2e-3)


def test_displacement_and_velocity_are_relative_to_the_ground_and_those_of_a_block_that_slides():
    rows, time = shaken().history.rows, since(shaken())
    k = int(np.argmin(np.abs(time - 0.6)))
    begins = 0.1 + np.arcsin(0.4) / (2.0 * np.pi)
    t, w = time[k] - 0.1, 2.0 * np.pi

    def speed(at):
        return 0.5 * G / w * (np.cos(w * (begins - 0.1)) - np.cos(w * at)) - 0.2 * G * (at - (begins - 0.1))

    assert rows["velocity stone"][k] == pytest.approx(speed(t), rel=2e-3)
    path = np.linspace(begins - 0.1, t, 10001)
    assert rows["displacement stone"][k] == pytest.approx(np.trapezoid(speed(path), path), rel=3e-3)


def test_a_stone_without_friction_stays_where_it_is():
    rows = shaken(friction=0.0).history.rows
    assert np.abs(rows["acceleration stone"]).max() < 1e-3 * 0.5 * G
    assert np.abs(rows["displacement stone"]).max() > 0.3


def test_the_summary_tells_what_the_ground_did_and_what_it_did():
    """All that comes in while the stone slides goes into friction and motion; it presses with its weight, 3.923 kN."""
    result = shaken()
    told, rows = result.summary.shaking, result.history.rows
    assert told.ground["x"].peak_acceleration_m_s2 == pytest.approx(0.5 * G)
    assert told.ground["x"].peak_velocity_m_s == pytest.approx(0.5 * G / np.pi, rel=1e-4)
    assert told.gauges["displacement stone"].peak == pytest.approx(rows["displacement stone"].max())
    assert told.gauges["displacement stone"].residual == pytest.approx(rows["displacement stone"][-1])
    assert told.gauges["acceleration floor"].peak == pytest.approx(-0.5 * G, rel=1e-3)
    first = int(np.searchsorted(rows["time"], told.settled_s))
    gained = sum(rows[name] - rows[name][first] for name in ("friction", "kinetic", "elastic_contacts", "dashpot"))
    assert np.allclose(rows["input_energy"][first:], gained[first:], atol=1e-3 * rows["input_energy"].max())
    assert told.input_energy_j == rows["input_energy"][-1]
    weight = 400.0 * G
    assert told.largest_force.force_n == pytest.approx(weight * np.hypot(1.0, 0.2), rel=2e-3)
    assert told.largest_force.between == "blocks 0 and 1 (units and floor)"
    assert told.uplift.opening_m < 1e-6
    assert 200.0 <= told.rows_a_second < 210.0


def test_words_of_a_shaken_run_speak_of_the_ground_and_of_no_peak_stress():
    words = repr(shaken())
    assert "along x for 1 s: at most 0.5 g, 1.561 m/s and 780.4 mm; 780.4 mm away at its end" in words
    assert "by the forces of inertia, in motion relative to the ground" in words
    assert "the specimen still moved at the end" in words
    assert not any(word in words for word in ("peak stress", "cycles", "hysteresis"))

"""Gauges of velocity and acceleration against motions with a closed form."""

from functools import cache

import numpy as np
import pytest

from masonry import scene
from masonry.errors import SceneError
from masonry.laboratory import laboratory
from masonry.laboratory.result import Result, load_result
from masonry.rows.accelerations import accelerations
from tests.scenes import load

FLYING = """
law = "friction"
displacements = "large"
kinematics = "rigid"
[specimen]
kind = "boxes"
section = "1 m^2"
[[specimen.box]]
name = "stone"
origin = ["1000 m", "-2 m", "0 m"]
size = ["0.2 m", "0.3 m", "0.4 m"]
[material.units]
density = "2000 kg/m^3"
young_modulus = "1 GPa"
poisson_ratio = 0.2
[contact.default]
normal_stiffness = "1 GPa/m"
shear_stiffness = "1 GPa/m"
tan_friction_angle = 0.5
[gravity]
z = "-9.81 m/s^2"
[settle]
steps = 0
[[motion]]
on = "stone"
velocity = ["1 m/s", "0 m/s", "2 m/s"]
spin = ["0 rad/s", "3 rad/s", "0 rad/s"]
[solver]
masses = "real"
damping = 0
time_step = "1e-4 s"
sampling = "200 Hz"
duration = "0.5 s"
"""
CORNER = '{x = "1000.2 m", y = "-1.7 m", z = "0.4 m"}'
GAUGES = "".join(
    f'[[gauge]]\nname = "{quantity} {axis}"\nat = {CORNER}\ndirection = "{axis}"\nquantity = "{quantity}"\n'
    for quantity in ("displacement", "velocity", "acceleration")
    for axis in "xz"
)


@cache
def flying(kinematics: str) -> Result:
    return laboratory.run(load(FLYING + GAUGES, kinematics=kinematics))


def corner(time: np.ndarray) -> dict[str, np.ndarray]:
    """Velocity and acceleration of a corner of a stone that spins about y at 3 rad/s."""
    turned = 3.0 * time
    x, z = 0.1 * np.cos(turned) + 0.2 * np.sin(turned), -0.1 * np.sin(turned) + 0.2 * np.cos(turned)
    return {
        "velocity x": 1.0 + 3.0 * z,
        "velocity z": 2.0 - 9.81 * time - 3.0 * x,
        "acceleration x": -9.0 * x,
        "acceleration z": -9.81 - 9.0 * z,
    }


def test_a_corner_of_a_stone_that_flies_and_spins_has_the_velocity_and_acceleration_of_rigid_motion():
    rows = flying("rigid").history.rows
    assert np.allclose(np.diff(rows["time"]), 0.005, rtol=1e-9)
    assert len(rows["time"]) == 101
    for name, exact in corner(rows["time"]).items():
        inner = slice(2, -2) if name.startswith("acceleration") else slice(1, None)
        assert np.abs(rows[name] - exact)[inner].max() < 2e-6 * 9.81, name
    assert rows["velocity z"][0] == pytest.approx(1.7 - 9.81 * 0.5e-4, abs=1e-9)  # half a step later


@pytest.mark.parametrize("kinematics", ["affine"])
def test_blocks_that_deform_fly_alike(kinematics):
    """A spin of 3 rad/s makes strains of 1e-6 by its centrifugal force, and these swing."""
    rows = flying(kinematics).history.rows
    for name, exact in corner(rows["time"]).items():
        inner = slice(2, -2) if name.startswith("acceleration") else slice(1, None)
        assert np.abs(rows[name] - exact)[inner].max() < 2e-3 * 9.81, name


def test_the_first_and_the_last_rows_have_the_value_next_to_them():
    a = flying("rigid").history.rows["acceleration x"]
    assert a[0] == a[1] == a[2]
    assert a[-1] == a[-2] == a[-3]


def test_columns_have_their_units_in_files_and_after_reading(tmp_path):
    flying("rigid").save_numbers(tmp_path)
    again = load_result(tmp_path)
    header = (tmp_path / "curve.csv").read_text().splitlines()[0]
    assert "velocity x [m/s]" in header
    assert "acceleration z [m/s2]" in header
    assert "displacement x [m]" in header
    assert again.history.units == flying("rigid").history.units
    assert again.curve.attrs["units"]["acceleration x"] == "m/s2"


def test_a_swing_reads_as_the_filter_of_the_accelerometer_says():
    time = 0.01 * np.arange(200)
    for cycles, share in ((0.1, 0.99833), (0.2, 0.97592), (0.4, 0.74549)):
        w = 2.0 * np.pi * cycles / 0.01
        a = accelerations(time, -np.cos(w * time) / w**2, 0.0)[2:-2]
        assert np.allclose(a, share * np.cos(w * time)[2:-2], atol=1e-5)


def test_vibration_far_above_the_rate_leaves_next_to_nothing():
    """Of a contact at 40.3 times the rate, of a displacement that alone would be 1 m/s2: 1e-4 of it."""
    time, w = 0.005 * np.arange(400), 2.0 * np.pi * 40.3 / 0.005
    assert np.abs(accelerations(time, np.cos(w * time) / w**2, 0.0)).max() < 3e-4


def test_what_settles_has_no_acceleration_and_the_last_row_may_come_early():
    time = np.concatenate([0.3 + 0.01 * np.arange(-20, 31), [0.604]])
    a = accelerations(time, time**3 / 6.0, 0.3)
    assert np.all(a[time < 0.2999] == 0.0)
    assert np.allclose(a[22:-3], time[22:-3], rtol=1e-9)
    assert a[-1] == a[-2]


@pytest.mark.parametrize("count", [0, 1, 2, 3, 4, 5])
def test_few_rows_have_what_they_can(count):
    a = accelerations(0.1 * np.arange(count), 0.5 * (0.1 * np.arange(count)) ** 2, 0.0)
    assert np.allclose(a, 1.0 if count > 2 else 0.0)


def test_scaled_masses_have_no_velocities():
    still = FLYING.replace("[settle]\nsteps = 0\n", "").split("[[motion]]")[0] + "[solver]\nrows = 10\n"
    with pytest.raises(SceneError, match=r"gauge.2.quantity: needs solver.masses = 'real'"):
        load(still + GAUGES)
    with pytest.raises(SceneError, match=r"solver.sampling: needs solver.masses = 'real'"):
        load(still.replace("rows = 10", 'sampling = "100 Hz"'))
    with pytest.raises(SceneError, match=r"curve.x: needs solver.masses = 'real'"):
        load(still + '[curve]\nx = "time"\n')


def test_rows_and_sampling_exclude_each_other():
    with pytest.raises(SceneError, match="solver.sampling: rows and sampling exclude each other"):
        load(FLYING.replace('sampling = "200 Hz"', 'sampling = "200 Hz"\nrows = 100'))


@pytest.mark.parametrize(("curve", "message"), [
    ('x = "time"\ny = "nothing"', "curve.y: 'nothing' is no gauge; allowed: stress, force, displacement x"),
    ('x = "velocity x"\ny = "velocity z"', "curve.y: a gauge is drawn over the time only"),
    ('y = 3', "curve.y: must be 'stress', 'force', a gauge's name or a list of them"),
])  # fmt: skip
def test_what_a_curve_draws_upwards_is_there(curve, message):
    with pytest.raises(SceneError, match=message):
        load(f"{FLYING}{GAUGES}[curve]\n{curve}\n")


def test_several_gauges_over_the_time_are_written_and_read_again():
    told = load(f'{FLYING}{GAUGES}[curve]\nx = "time"\ny = ["velocity x", "velocity z"]\n')
    assert told.curve is not None
    assert told.curve.gauges == ("velocity x", "velocity z")
    assert load(scene.to_toml(told)) == told

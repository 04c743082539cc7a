"""The linear law's energy must be enough at the compression that a run brings, not only at the scene's confinement."""

import math
import re

import numpy as np
import pytest

from masonry import laboratory, scene
from masonry.errors import SceneError, Stopped
from masonry.laws.interface import Interface
from masonry.laws.linear import Linear, largest_compression

ENERGY = 6.5
BARELY = {
    "law": "linear",
    "confinement": "0 Pa",
    "drive.steps": 4000,
    "drive.displacement": "0.1 mm",
    "contact.unit_unit.fracture_energy_mode_2": f"{ENERGY} N/m",
    "contact.unit_unit.fracture_energy_mode_2_slope": "0 N/m/MPa",
}
LIMIT = (math.sqrt(2 * 70e9 * ENERGY) - 0.87e6) / (1.01 - 0.73)
"""Pa; (c0 + sigma (tan0 - tan_res))^2 = 2 ks G_II."""


def pressed(sigma: float) -> scene.Scene:
    """The couplet under a traction (Pa) that the scene does not call its confinement."""
    return scene.load("couplet", {**BARELY, "traction.0.stress": {"z": f"{-sigma!r} Pa"}})


@pytest.mark.parametrize("slope", [0.0, 1e-6, 130e-6])
@pytest.mark.parametrize("energy", [5.5, 58.0])
def test_at_the_largest_compression_the_energy_is_just_the_elastic_triangle(slope, energy):
    joint = Interface(150e9, 70e9, 0.58e6, 0.87e6, 1.01, 0.0, 0.73)
    at = largest_compression(Linear(5.8, energy, slope), joint)
    loss = 0.87e6 + at * (1.01 - 0.73)
    assert at > 0.0
    assert energy + slope * at == pytest.approx(loss**2 / (2 * 70e9), rel=1e-12)


def test_without_a_loss_of_friction_no_compression_is_too_much():
    assert largest_compression(Linear(5.8, 58.0), Interface(150e9, 70e9, 0.58e6, 0.87e6, 0.7, 0.0, 0.7)) == math.inf


def test_a_contact_that_softens_beyond_the_limit_stops_the_run_and_is_named():
    with pytest.raises(Stopped, match=r"step \d+: contact 0 \(unit_unit\) of blocks 0 and 1 at .*snaps back") as stop:
        laboratory.run(pressed(1.01 * LIMIT))
    least = float(re.findall(r"above ([\d.]+) N/m", str(stop.value))[0])
    assert least == pytest.approx((0.87e6 + 1.01 * LIMIT * 0.28) ** 2 / (2 * 70e9), rel=1e-3)
    rows = stop.value.result.history.rows
    assert all(np.isfinite(values).all() for values in rows.values())


def test_what_it_then_asks_for_is_enough():
    enough = {"contact.unit_unit.fracture_energy_mode_2": f"{1.001 * (0.87e6 + 0.28 * 10e6) ** 2 / (2 * 70e9)!r} N/m"}
    knobs = {**BARELY, **enough, "traction.0.stress": {"z": "-10 MPa"}, "drive.displacement": "0.2 mm"}
    assert laboratory.run(scene.load("couplet", knobs)).summary["peak_stress_pa"] == pytest.approx(10.97e6, rel=2e-3)


def test_below_the_limit_the_energy_is_the_one_given():
    sigma = 0.9 * LIMIT
    summary = laboratory.run(pressed(sigma)).summary
    fracture = summary["energy_j"]["fracture_mode_2"] / summary["section_m2"]
    assert fracture == pytest.approx(ENERGY, rel=1e-3)


def test_the_same_compression_as_the_confinement_is_refused_at_input():
    with pytest.raises(SceneError, match="fracture_energy_mode_2 .*snap back"):
        laboratory.check(scene.load("couplet", {**BARELY, "confinement": f"{1.01 * LIMIT!r} Pa"}))


def test_compression_alone_is_no_snap_back():
    """The contact bears any compression as long as it does not soften in shear."""
    knobs = {**BARELY, "traction.0.stress": {"z": "-10 MPa"}, "drive.displacement": "0.1 um", "drive.steps": 500}
    assert laboratory.run(scene.load("couplet", knobs)).summary["peak_stress_pa"] == pytest.approx(7e3, rel=1e-6)

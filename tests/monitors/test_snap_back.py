"""The linear law's energy must be enough at the compression that a run brings, not only at the scene's confinement."""

import math
import re
import sys

import numpy as np
import pytest

from masonry import scene
from masonry.errors import SceneError, Stopped
from masonry.laboratory import laboratory
from masonry.laws.exponential import Exponential
from masonry.laws.linear import Linear
from masonry.laws.polynomial import Polynomial
from masonry.laws.snap_back import least_mode_2_energy
from masonry.laws.state import JointProperties

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


LAWS = {
    "linear": Linear(5.8, 58.0, 1e-6),
    "exponential": Exponential(5.8, 58.0, 1e-6),
    "polynomial": Polynomial(5.8, 58.0, 3.0, 2.5, 1e-6),
}


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("compression", [0.0, 2e6, 3e7])
@pytest.mark.parametrize("intact", [1.0, 0.3])
def test_with_the_least_energy_the_slope_over_plastic_slip_is_the_shear_stiffness(law, compression, intact):
    """Stress over total slip then falls straight down: 1/ks of elastic way back for each slip that is made."""
    parameters, joint = (
        LAWS[law],
        JointProperties(150e9, 70e9, 0.58e6, 0.87e6, 1.01, 0.1e6, 0.73, plastic_softening=1.0),
    )
    least = least_mode_2_energy(parameters, joint, compression, intact)
    just = parameters._replace(G_II=least, G_II_slope=0.0)
    peak, residual = 0.87e6 + 1.01 * compression, 0.1e6 + 0.73 * compression
    slip = 1e-6 * (peak - residual) / 70e9
    left = sys.modules[type(parameters).__module__].shear_intact(just, joint, intact, slip, peak, residual, compression)
    assert (intact - left) * (peak - residual) / slip == pytest.approx(70e9, rel=1e-5)


def test_over_the_total_slip_only_the_linear_law_snaps_back():
    joint = JointProperties(150e9, 70e9, 0.58e6, 0.87e6, 1.01, 0.0, 0.73)
    limits = {law: least_mode_2_energy(parameters, joint, 1e6) for law, parameters in LAWS.items()}
    assert limits == {"linear": pytest.approx((0.87e6 + 0.28e6) ** 2 / 140e9), "exponential": None, "polynomial": None}


def test_over_plastic_slip_the_exponential_law_is_refused_where_it_would_take_more_energy_than_it_has():
    least = 0.87e6 * (0.87e6 + 0.28 * 0.5e6) / 70e9
    knobs = {
        "contact.unit_unit.softening_variable": "plastic",
        "contact.unit_unit.fracture_energy_mode_2_slope": "0 N/m/MPa",
    }
    few, enough = ({**knobs, "contact.unit_unit.fracture_energy_mode_2": f"{f * least!r} N/m"} for f in (0.99, 1.01))
    with pytest.raises(SceneError, match="fracture_energy_mode_2 .*plastic slip.*snap back"):
        laboratory.check(scene.load("couplet", few))
    assert laboratory.check(scene.load("couplet", enough))["blocks"] == 2


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

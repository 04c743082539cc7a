"""The packaged couplet, from its scene to its curve, against the closed form tau(u)."""

import numpy as np
import pytest

from masonry import scene
from masonry.laboratory.laboratory import run
from tests.couplet.curve import couplet as curve_of
from verification.references import closed_forms
from verification.references.closed_forms import Joint

LAWS = ("linear", "polynomial", "exponential")
COMPRESSIONS = {"0.1 MPa": (0.1e6, 2.1), "0.5 MPa": (0.5e6, 2.1 + 0.8 * 4 / 9), "1.0 MPa": (1.0e6, 2.9)}
"""Confinement in Pa and the exponent beta of the polynomial law there: 2.1 at 0.1 MPa, 2.9 at 1.0 MPa."""

FINE = {"drive.steps": 40000}
"""Far finer than the shipped accuracy of 1 % asks for: the closed form is held to 0.1 %."""

YOUNG, POISSON, HEIGHT, LENGTH = 16.7e9, 0.2, 0.05, 0.2
GLUE_KN, GLUE_KS = 2e12, 1e12
GLUED = """
[contact.plate]
law = "elastic"
normal_stiffness = "2000 GPa/m"
shear_stiffness = "1000 GPa/m"

[material.plates]
density = "7850 kg/m^3"
"""


def curve(source, **overrides):
    """(rows while the drive moves, summary) of a run."""
    result = run(scene.load(source, overrides))
    loading = result.history.rows["displacement"] > 0.0
    return {name: values[loading] for name, values in result.history.rows.items()}, result.summary


def wanted_stress(law, confinement, rows, compliance=0.0):
    """(closed form at the rows, t_max) in Pa."""
    compression, beta = COMPRESSIONS[confinement]
    joint = Joint(beta=beta)
    return curve_of(law, joint, rows["displacement"], compression, compliance), float(joint.peak(compression))


def check(law, confinement, rows, summary):
    """The whole curve within 0.5 % of t_max, peak and residual within 0.1 %."""
    wanted, peak = wanted_stress(law, confinement, rows)
    assert np.max(np.abs(rows["stress"] - wanted)) < 5e-3 * peak
    assert summary["peak_stress_pa"] == pytest.approx(peak, rel=1e-3)
    assert rows["stress"][-1] == pytest.approx(wanted[-1], rel=1e-3, abs=1e-3 * 0.073e6)
    assert summary["energy_imbalance"] < 1e-9


@pytest.mark.parametrize("confinement", COMPRESSIONS)
@pytest.mark.parametrize("law", LAWS)
def test_rigid_couplet_follows_the_closed_form(law, confinement):
    rows, summary = curve("couplet", law=law, confinement=confinement, **FINE)
    check(law, confinement, rows, summary)
    compression, beta = COMPRESSIONS[confinement]
    wanted = closed_forms.dissipated_in_shear(law, Joint(beta=beta), rows["displacement"][-1], compression)
    energy = summary["energy_j"]
    dissipated = energy["fracture_mode_1"] + energy["fracture_mode_2"] + energy["friction"]
    assert dissipated == pytest.approx(float(wanted) * 0.2 * 0.05, rel=1e-3)
    assert energy["fracture_mode_1"] == 0.0


@pytest.mark.parametrize("kinematics", ["affine", "tets"])
@pytest.mark.parametrize(
    ("law", "confinement"), [("linear", "0.1 MPa"), ("polynomial", "0.5 MPa"), ("exponential", "1.0 MPa")]
)
def test_blocks_driven_as_a_whole_do_not_shear_and_give_the_same_curve(law, confinement, kinematics):
    """Every dof along the drive is prescribed, so that the blocks' own shear is zero."""
    steps = {"drive.steps": 10000, "settle.steps": 2000} if kinematics == "tets" else FINE
    check(law, confinement, *curve("couplet", law=law, confinement=confinement, kinematics=kinematics, **steps))


@pytest.fixture(scope="module")
def glued(tmp_path_factory):
    """The couplet between rigid plates that are driven and held, its units glued to them."""
    text = scene.packaged()["couplet"].read_text(encoding="utf-8")
    text = text.replace('mesh_size = "25 mm"', 'plates = "20 mm"\nmesh_size = "25 mm"')
    text = text.replace('on = "bottom"', 'on = "bottom plate"').replace('on = "top"', 'on = "top plate"')
    text = text.replace('on = "top.z+"', 'on = "top plate.z+"')
    text = text.replace('kinematics = "rigid" ', 'kinematics = {default = "affine", plates = "rigid"} ')
    head, tail = text.split("[material.units]")
    path = tmp_path_factory.mktemp("scenes") / "glued.toml"
    path.write_text(head + GLUED + "\n[material.units]" + tail, encoding="utf-8")
    return path


@pytest.mark.parametrize("confinement", COMPRESSIONS)
@pytest.mark.parametrize("law", LAWS)
def test_affine_units_glued_to_plates_follow_the_closed_form_in_series_with_their_own_shear(glued, law, confinement):
    """The drive's end also feels the damping of the ringing units (less with more steps), the support's far less."""
    rows, summary = curve(glued, law=law, confinement=confinement, **{"drive.steps": 320000})
    shear_modulus = YOUNG / (2.0 * (1.0 + POISSON))
    compliance = closed_forms.affine_couplet_compliance(HEIGHT, LENGTH, shear_modulus, GLUE_KN, GLUE_KS)
    wanted, peak = wanted_stress(law, confinement, rows, compliance)
    assert np.max(np.abs(rows["stress"] - wanted)) < 1e-3 * peak
    assert np.max(np.abs(rows["support_stress"] - wanted)) < 1e-3 * peak
    assert summary["peak_stress_pa"] == pytest.approx(peak, rel=1e-3)
    assert rows["stress"][-1] == pytest.approx(wanted[-1], rel=1e-3)
    stiff, _ = wanted_stress(law, confinement, rows)
    assert np.max(np.abs(rows["support_stress"] - stiff)) > 0.05 * peak


def test_a_finer_accuracy_follows_a_steep_curve_over_the_plastic_slip_more_closely():
    """The area above the residual, G_II (peak - residual) / c0; the curve is 0.6 times as steep as the springs."""
    joint = Joint()
    drop = joint.peak(0.5e6) - joint.residual(0.5e6)
    steep = {
        "law": "exponential",
        "contact.unit_unit.softening_variable": "plastic",
        "contact.unit_unit.fracture_energy_mode_2": "20 N/m",
        "contact.unit_unit.fracture_energy_mode_2_slope": "0 N/m/MPa",
    }
    off = {}
    for accuracy in ("1 %", "0.1 %"):
        _, summary = curve("couplet", **steep, **{"drive.accuracy": accuracy})
        booked = summary["energy_j"]["fracture_mode_2"] / summary["section_m2"]
        off[accuracy] = abs(booked / (20.0 * drop / joint.c0) - 1.0)
    assert off["0.1 %"] < 0.3 * off["1 %"] < 3e-4

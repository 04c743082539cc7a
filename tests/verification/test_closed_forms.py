"""The closed forms themselves: against quadrature of the envelopes, and against the table of known values."""

import numpy as np
import pytest
from scipy.integrate import quad

from tests.couplet.curve import couplet
from verification.references.closed_forms import (
    LAWS,
    Joint,
    affine_couplet_compliance,
    dissipated_in_shear,
    shear,
    shear_area,
    shear_work,
    tension,
    tension_work,
)

JOINT = Joint(c_res=0.1e6)
SOFTENING = LAWS[1:]


def integral(curve, corner: float, end: float) -> float:
    """Of a curve with a kink at `corner`."""
    parts = [quad(curve, *ends, limit=400, epsabs=0.0, epsrel=1e-12)[0] for ends in ((0.0, corner), (corner, end))]
    return sum(parts)


@pytest.mark.parametrize("law", LAWS)
def test_work_in_tension_is_the_integral_of_the_envelope(law):
    wanted = integral(lambda u: float(tension(law, JOINT, u)), JOINT.opening_at_peak, 15e-6)
    assert tension_work(law, JOINT, 15e-6) == pytest.approx(wanted, rel=1e-9)


@pytest.mark.parametrize("compression", [0.0, 0.1e6, 1.0e6])
@pytest.mark.parametrize("law", LAWS)
def test_work_in_shear_is_the_integral_of_the_envelope(law, compression):
    us0 = float(JOINT.peak(compression)) / JOINT.ks
    wanted = integral(lambda u: float(shear(law, JOINT, u, compression)), us0, 120e-6)
    assert shear_work(law, JOINT, 120e-6, compression) == pytest.approx(wanted, rel=1e-9)


def test_work_to_separation_tends_to_the_energies_of_the_catalogue():
    joint, r = Joint(alpha=4.0), 0.58e6**2 / (2 * 150e9 * 5.8)
    wanted = {"brittle": r, "linear": 1.0, "exponential": 1 + r, "polynomial": 2 / 3 + r}
    for law in LAWS:
        assert tension_work(law, joint, 10.0) == pytest.approx(5.8 * wanted[law], rel=1e-9)


def test_an_exponent_of_one_plus_two_over_one_less_r_makes_the_polynomial_total_exactly_the_energy():
    r = 0.58e6**2 / (2 * 150e9 * 5.8)
    assert tension_work("polynomial", Joint(alpha=1 + 2 / (1 - r)), 10.0) == pytest.approx(5.8, rel=1e-9)


@pytest.mark.parametrize("law", SOFTENING)
def test_dissipation_in_shear_is_the_area_above_the_residual_and_friction_on_the_plastic_slip(law):
    joint, compression = Joint(c_res=0.1e6, beta=4.0), 0.5e6
    slip, residual = 10.0, float(joint.residual(compression))
    wanted = shear_area(law, joint, compression) + residual * (slip - residual / joint.ks)
    assert dissipated_in_shear(law, joint, slip, compression) == pytest.approx(wanted, rel=1e-9)


@pytest.mark.parametrize(
    ("compression", "peak", "residual", "energy", "slip_at_peak", "stresses"),
    [
        (0.1e6, 0.971, 0.073, 0.071, 0.0139, (0.386, 0.165, 0.100, 0.075, 0.073)),
        (0.5e6, 1.375, 0.365, 0.123, 0.0196, (0.937, 0.647, 0.504, 0.399, 0.369)),
        (1.0e6, 1.880, 0.730, 0.188, 0.0269, (1.550, 1.246, 1.055, 0.859, 0.762)),
    ],
)
def test_the_couplet_of_table_1_follows_the_known_values(compression, peak, residual, energy, slip_at_peak, stresses):
    joint = Joint()
    assert joint.peak(compression) / 1e6 == pytest.approx(peak, abs=5e-4)
    assert joint.residual(compression) / 1e6 == pytest.approx(residual, abs=5e-4)
    assert joint.mode_2_energy(compression) / 1e3 == pytest.approx(energy, abs=5e-7)
    assert joint.peak(compression) / joint.ks * 1e3 == pytest.approx(slip_at_peak, abs=1e-4)
    stress = shear("exponential", joint, np.array([0.1, 0.2, 0.3, 0.5, 0.8]) * 1e-3, compression) / 1e6
    np.testing.assert_allclose(stress, stresses, atol=5.1e-4)


def test_factors_of_the_area_under_exponential_shear_are_those_of_the_catalogue():
    joint = Joint()
    for compression, factor in ((0.1e6, 1.032), (0.5e6, 1.161), (1.0e6, 1.322)):
        drop = joint.peak(compression) - joint.residual(compression)
        assert drop / joint.c0 == pytest.approx(factor, abs=5e-4)


@pytest.mark.parametrize("law", SOFTENING)
def test_a_compliance_in_series_moves_every_stress_to_a_larger_displacement(law):
    joint, compliance, slip = Joint(), 1e-11, np.linspace(1e-6, 0.5e-3, 50)
    stress = shear(law, joint, slip, 0.5e6)
    moved = couplet(law, joint, slip + compliance * stress, 0.5e6, compliance)
    np.testing.assert_allclose(moved, stress, rtol=2e-4)


def test_a_compliance_that_snaps_back_is_refused():
    with pytest.raises(ValueError, match="snaps back"):
        couplet("linear", Joint(), np.array([1e-3]), 0.1e6, compliance=1e-9)


def test_without_glue_only_the_shear_of_two_units_is_left():
    compliance = affine_couplet_compliance(0.05, 0.2, 7e9, np.inf, np.inf)
    assert compliance == pytest.approx(2 * 0.05 / 7e9)

"""Dilation, eqs (9) and (10): slip lifts the faces by tan(psi); held down, they press; sliding never makes energy."""

from math import atan, tan

import numpy as np
import pytest

from verification.fixtures.one_contact import along, contact, law, walk
from verification.references.closed_forms import LAWS, Joint, dissipated_in_shear, shear

UM = 1e-6
PSI = 0.1
KN, KS = 150e9, 70e9
PERFECT = {"residual_cohesion": 0.87e6, "tan_residual_friction": 1.01, "dilation_angle": PSI, "dilation_cutoff": 1.0}


@pytest.mark.parametrize("name", LAWS)
def test_held_down_the_compression_grows_by_kn_tan_psi_times_the_plastic_slip(name):
    found = walk(law(name, dilation_angle=PSI, dilation_cutoff=1.0), along([(0, 0, -2 * UM), (0.2e-3, 0, -2 * UM)]))
    wanted = -KN * (2 * UM + tan(PSI) * found.slip[:, 0])
    np.testing.assert_allclose(found.sigma, wanted, rtol=1e-11)
    assert found.slip[-1, 0] > 100 * UM


def test_held_down_the_shear_stress_stays_on_the_cone_of_the_compression_that_acts():
    """Perfect slip: ks (us - p) = c + tan(phi) (s + kn tan(psi) p), solved for the plastic slip p."""
    found = walk(law("linear", **PERFECT), along([(0, 0, -2 * UM), (0.2e-3, 0, -2 * UM)], 1 * UM))
    peak = 0.87e6 + 1.01 * 0.3e6
    plastic = np.maximum(KS * found.path[:, 0] - peak, 0.0) / (KS + 1.01 * KN * tan(PSI))
    np.testing.assert_allclose(found.tau, KS * (found.path[:, 0] - plastic), rtol=1e-11)
    np.testing.assert_allclose(found.sigma, -0.3e6 - KN * tan(PSI) * plastic, rtol=1e-11)


@pytest.mark.parametrize("cutoff", [30 * UM, 1.0])
@pytest.mark.parametrize("name", LAWS)
def test_under_constant_compression_the_faces_rise_by_tan_psi_times_the_plastic_slip_up_to_the_cutoff(name, cutoff):
    compression, joint, psi = 0.5e6, Joint(), tan(PSI)
    slip = along([(0.0, 0, 0), (float(joint.peak(compression)) / KS, 0, 0), (0.15e-3, 0, 0)], 0.02 * UM)[:, 0]
    plastic = slip - shear(name, joint, slip, compression) / KS
    rise = psi * np.minimum(plastic, cutoff)
    path = np.column_stack([slip, 0 * slip, rise - compression / KN])
    found = walk(law(name, dilation_angle=PSI, dilation_cutoff=cutoff), path)
    smooth = np.ones(len(slip), dtype=bool)
    if name == "brittle":  # the drop of one step lifts the faces at once
        smooth[np.argmax(plastic > 0)] = False
    np.testing.assert_allclose(found.sigma[smooth], -compression, rtol=5e-3)
    np.testing.assert_allclose(found.slip[:, 0], plastic, atol=0.05 * UM)


@pytest.mark.parametrize("cutoff", [30.05 * UM, 60 * UM])
def test_the_rise_ends_exactly_at_the_cutoff(cutoff):
    for name in LAWS:
        parameters, joint = law(name, dilation_angle=PSI, dilation_cutoff=cutoff)
        state = contact(joint)
        found = walk((parameters, joint), along([(0, 0, -2 * UM), (0.4e-3, 0, -2 * UM)], 0.7 * UM), state)
        assert found.slip[-1, 0] > 2 * cutoff
        assert state.dilation[0] == pytest.approx(tan(PSI) * cutoff, rel=1e-12)
        assert found.sigma[-1] == pytest.approx(-KN * (2 * UM + tan(PSI) * cutoff), rel=1e-12)


@pytest.mark.parametrize("name", LAWS)
def test_the_path_of_slip_counts_not_its_end(name):
    parameters, joint = law(name, dilation_angle=PSI, dilation_cutoff=1.0)
    state = contact(joint)
    found = walk(
        (parameters, joint), along([(0, 0, -2 * UM), *[(60 * UM, 0, -2 * UM), (-60 * UM, 0, -2 * UM)] * 2]), state
    )
    length = np.abs(np.diff(found.slip[:, 0])).sum()
    assert state.dilation[0] == pytest.approx(tan(PSI) * length, rel=1e-9)


def test_perfect_slip_dissipates_tau_less_sigma_tan_psi():
    """verification 2.2: (tau - sigma tan(psi)) x slip at constant sigma, here as the sum over a locked normal."""
    found = walk(law("linear", **PERFECT), along([(0, 0, -2 * UM), (0.2e-3, 0, -2 * UM)], 1 * UM))
    tau, sigma, plastic = found.tau, -found.sigma, found.slip[:, 0]
    rate = tau - sigma * tan(PSI)
    sliding = plastic > 0
    wanted = np.sum((0.5 * (rate[1:] + rate[:-1]) * np.diff(plastic))[sliding[:-1]])
    first = int(np.argmax(sliding))
    assert found.dissipated[-1] - found.dissipated[first] == pytest.approx(wanted, rel=1e-9)


@pytest.mark.parametrize("step", [0.1 * UM, 1 * UM, 30 * UM])
@pytest.mark.parametrize("compression", [0.0, 1.0, 0.1e6])
@pytest.mark.parametrize("name", LAWS)
def test_sliding_makes_no_energy_even_where_dilation_is_as_steep_as_friction(name, compression, step):
    steep = law(name, cohesion=0.1e6, dilation_angle=atan(0.73) * (1 - 1e-12), dilation_cutoff=1.0)
    z = -compression / KN
    corners = [(0, 0, z), (90 * UM, 0, z), (-90 * UM, 30 * UM, z), (50 * UM, 0, -compression / KN - 3 * UM)]
    found = walk(steep, along(corners, step))
    total = found.dissipated
    assert np.all(np.diff(total) >= -1e-12 * total[-1])


@pytest.mark.parametrize("name", [pytest.param(n, marks=pytest.mark.slow if n != "exponential" else ()) for n in LAWS])
def test_torn_faces_that_stand_open_do_not_dilate(name):
    parameters, joint = law(name, dilation_angle=PSI, dilation_cutoff=1.0, coupling="independent")
    state = contact(joint)
    walk((parameters, joint), along([(0, 0, 0), (0, 0, 60 * UM), (100 * UM, 0, 60 * UM)]), state)
    assert state.dilation[0] == 0.0


def test_without_a_dilation_angle_a_contact_has_no_memory_of_uplift():
    assert contact(law("linear")[1]).dilation is None
    assert law("linear")[1].tan_dilation is None


def test_a_dilation_that_ends_at_once_changes_nothing():
    path = along([(0, 0, -3 * UM), (0.3e-3, 0, -3 * UM)])
    for name in LAWS:
        plain = walk(law(name), path)
        ended = walk(law(name, dilation_angle=PSI, dilation_cutoff=1e-300), path)
        np.testing.assert_allclose(ended.stress, plain.stress, rtol=1e-12)
        wanted = float(dissipated_in_shear(name, Joint(), 0.3e-3, 0.45e6))
        assert ended.dissipated[-1] == pytest.approx(wanted, rel=5e-3)

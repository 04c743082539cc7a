"""Envelopes and dissipated energies of a single contact against the closed forms."""

import numpy as np
import pytest

from verification.fixtures.one_contact import along, law, walk
from verification.references import closed_forms
from verification.references.closed_forms import LAWS, Joint

COMPRESSIONS = (0.0, 0.1e6, 0.5e6, 1.0e6)
OPTIONS = [{}, {"coupling": "independent"}, {"unloading": "elastic"}]
LAWS_AND_OPTIONS = [
    pytest.param(
        name, options, marks=pytest.mark.slow if options and name != "exponential" else (), id=f"{name}-{options}"
    )
    for name in [*LAWS, "elastic"]
    for options in OPTIONS
]
"""Options are the mechanism's, which all laws share: by default one law has them, as every pair is compiled anew."""


def pulled(name, *corners, most=0.05e-6, **changes):
    """A contact opened through the corners (m)."""
    return walk(law(name, **changes), along([(0.0, 0.0, z) for z in (0.0, *corners)], most))


def sheared(name, compression, *corners, most=0.1e-6, **changes):
    """A contact under constant compression (Pa), slid along x through the corners (m)."""
    z = -compression / 150e9
    return walk(law(name, **changes), along([(x, 0.0, z) for x in (0.0, *corners)], most))


@pytest.mark.parametrize(("name", "options"), LAWS_AND_OPTIONS)
def test_opening_follows_the_envelope_to_round_off(name, options):
    trace = pulled(name, 60e-6, **options)
    wanted = closed_forms.tension(name, Joint(), trace.path[:, 2])
    np.testing.assert_allclose(trace.sigma, wanted, rtol=0, atol=1e-12 * 0.58e6 if name != "elastic" else 1e-5)
    assert not trace.tau.any()


@pytest.mark.parametrize("compression", COMPRESSIONS)
@pytest.mark.parametrize(("name", "options"), LAWS_AND_OPTIONS)
def test_slip_under_constant_compression_follows_the_envelope_to_round_off(name, compression, options):
    trace = sheared(name, compression, 1e-3, **options)
    wanted = closed_forms.shear(name, Joint(), trace.path[:, 0], compression)
    np.testing.assert_allclose(trace.stress[:, 0], wanted, rtol=0, atol=1e-12 * wanted.max())
    np.testing.assert_allclose(trace.sigma, -compression, rtol=1e-14, atol=1e-300)


@pytest.mark.parametrize("name", LAWS)
def test_a_residual_cohesion_and_other_exponents_follow_the_envelope_too(name):
    changes = {"residual_cohesion": 0.2e6, "exponent_shear": 2.1, "exponent_tension": 2.2}
    joint = Joint(c_res=0.2e6, beta=2.1, alpha=2.2)
    trace = sheared(name, 0.3e6, 0.8e-3, **changes)
    wanted = closed_forms.shear(name, joint, trace.path[:, 0], 0.3e6)
    np.testing.assert_allclose(trace.stress[:, 0], wanted, rtol=0, atol=1e-12 * wanted.max())
    trace = pulled(name, 60e-6, **changes)
    wanted = closed_forms.tension(name, joint, trace.path[:, 2])
    np.testing.assert_allclose(trace.sigma, wanted, rtol=0, atol=1e-12 * 0.58e6)


@pytest.mark.parametrize("direction", [(1.0, 0.0), (0.0, -1.0), (-0.6, 0.8)])
@pytest.mark.parametrize("name", LAWS)
def test_shear_does_not_know_the_direction_of_slip(name, direction):
    path = along([(0.0, 0.0, -1e-6), (0.3e-3 * direction[0], 0.3e-3 * direction[1], -1e-6)], 0.5e-6)
    trace = walk(law(name), path)
    wanted = closed_forms.shear(name, Joint(), np.hypot(*path[:, :2].T), 0.15e6)
    np.testing.assert_allclose(trace.stress[:, :2], np.outer(wanted, direction), rtol=0, atol=1e-11 * wanted.max())


def test_the_table_of_known_values_is_met():
    for compression, wanted in (
        (0.1e6, (0.386, 0.165, 0.100, 0.075, 0.073)),
        (0.5e6, (0.937, 0.647, 0.504, 0.399, 0.369)),
        (1.0e6, (1.550, 1.246, 1.055, 0.859, 0.762)),
    ):
        trace = sheared("exponential", compression, 0.1e-3, 0.2e-3, 0.3e-3, 0.5e-3, 0.8e-3)
        at = np.searchsorted(trace.path[:, 0], np.array([0.1, 0.2, 0.3, 0.5, 0.8]) * 1e-3)
        np.testing.assert_allclose(trace.tau[at] / 1e6, wanted, atol=5.1e-4)


@pytest.mark.parametrize("widest", [5e-6, 15e-6, 40e-6])
@pytest.mark.parametrize("name", LAWS)
def test_energy_of_opening_is_the_closed_area_at_any_step_on_the_secant(name, widest):
    trace = pulled(name, widest, most=3.3e-6)
    wanted = closed_forms.dissipated_in_tension(name, Joint(), widest)
    assert trace.dissipated_by_mode[-1, 0] == pytest.approx(wanted, rel=1e-12)
    assert not trace.dissipated_by_mode[:, 1:].any()


@pytest.mark.parametrize("name", LAWS[1:])
def test_energy_of_opening_is_the_closed_area_on_elastic_unloading(name):
    trace = pulled(name, Joint().opening_at_peak, 20e-6, 40e-6, unloading="elastic")
    wanted = closed_forms.dissipated_in_tension(name, Joint(), 40e-6, "elastic")
    assert trace.dissipated[-1] == pytest.approx(wanted, rel=2e-5)


@pytest.mark.parametrize("most", [0.1e-6, 0.001e-6])
def test_a_brittle_break_costs_its_triangle_and_no_more_than_half_a_step_of_the_drop_besides(most):
    joint = Joint()
    trace = pulled("brittle", joint.opening_at_peak, 5e-6, most=most, unloading="elastic")
    assert 0.0 <= trace.dissipated[-1] - 0.5 * joint.fT * joint.opening_at_peak <= 0.5 * joint.fT * most * (1 + 1e-9)
    compression, us0 = 0.5e6, float(joint.peak(0.5e6)) / joint.ks
    drop = float(joint.peak(compression) - joint.residual(compression))
    trace = sheared("brittle", compression, us0, 25e-6, most=most)
    wanted = float(closed_forms.dissipated_in_shear("brittle", joint, 25e-6, compression))
    assert 0.0 <= trace.dissipated[-1] - wanted <= 0.5 * drop * most * (1 + 1e-9)


@pytest.mark.parametrize("unloading", ["secant", "elastic"])
def test_energy_of_complete_separation_is_that_of_the_law(unloading):
    joint = Joint(alpha=2.5)
    changes = {"unloading": unloading, "exponent_tension": 2.5}
    at_peak = joint.opening_at_peak
    assert pulled("linear", at_peak, 20e-6, **changes).dissipated[-1] == pytest.approx(5.8, rel=1e-5)
    triangle = 0.5 * 0.58e6 * at_peak
    assert pulled("exponential", at_peak, 1e-3, most=0.1e-6, **changes).dissipated[-1] == pytest.approx(
        5.8 + triangle, rel=1e-4
    )
    far, w = 0.2, 2 * 5.8 / 0.58e6
    tail = (w / far) ** 1.5
    path = np.concatenate([[0.0, at_peak], at_peak + w * np.geomspace(1e-3, far / w, 40000)])
    trace = walk(law("polynomial", **changes), np.outer(path, [0, 0, 1.0]))
    assert trace.dissipated[-1] == pytest.approx(2 * 5.8 / 1.5 * (1 - tail) + triangle, rel=1e-4)


@pytest.mark.parametrize("compression", COMPRESSIONS)
@pytest.mark.parametrize("name", LAWS[1:])
def test_energy_of_slip_is_the_closed_area(name, compression):
    joint = Joint()
    us0 = float(joint.peak(compression)) / joint.ks
    trace = sheared(name, compression, us0, 1e-3)
    wanted = closed_forms.dissipated_in_shear(name, joint, 1e-3, compression)
    assert trace.dissipated[-1] == pytest.approx(wanted, rel=1e-5)
    friction = float(joint.residual(compression)) * (1e-3 - trace.tau[-1] / joint.ks)
    assert trace.dissipated_by_mode[-1, 2] == pytest.approx(friction, rel=1e-12, abs=1e-12)
    assert trace.dissipated_by_mode[-1, 0] == 0.0


@pytest.mark.parametrize("compression", COMPRESSIONS)
def test_linear_slip_spends_exactly_its_mode_2_energy(compression):
    trace = sheared("linear", compression, 1e-3, most=0.02e-6)
    assert trace.dissipated_by_mode[-1, 1] == pytest.approx(58.0 + 130e-6 * compression, rel=1e-4)


@pytest.mark.parametrize("name", LAWS[1:])
def test_energies_converge_to_the_closed_area_with_the_step(name):
    wanted = closed_forms.dissipated_in_shear(name, Joint(), 0.2e-3, 0.5e6)
    errors = [abs(sheared(name, 0.5e6, 0.2e-3, most=h).dissipated[-1] - wanted) for h in (0.8e-6, 0.05e-6)]
    assert errors[0] < 0.02 * wanted
    assert errors[1] < 0.1 * errors[0] or errors[1] < 1e-6 * wanted

"""Tension and shear together: what yields first, and what the loss of one does to the other."""

import numpy as np
import pytest

from verification.fixtures.one_contact import along, law, walk
from verification.references.closed_forms import LAWS, Joint, shear, tension

UM = 1e-6
KN, KS = 150e9, 70e9
JOINT = Joint()


@pytest.mark.parametrize("degrees", [0, 15, 30, 45, 60, 75, 90])
@pytest.mark.parametrize("name", LAWS)
def test_a_proportional_path_is_elastic_up_to_the_cutoff_or_the_cone_whichever_is_first(name, degrees):
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    cutoff = JOINT.fT / (KN * s) if s > 0 else np.inf
    cone = JOINT.c0 / (KS * c + KN * s * JOINT.tan0)
    limit, most = min(cutoff, cone), 0.005 * UM
    trace = walk(law(name), along([(0, 0, 0), (c * 20 * UM, 0, s * 20 * UM)], most))
    far = np.linalg.norm(trace.path, axis=1)
    elastic = far < limit * (1 - 1e-12)
    np.testing.assert_allclose(trace.sigma[elastic], KN * trace.path[elastic, 2], rtol=1e-13, atol=1e-9)
    np.testing.assert_allclose(trace.tau[elastic], KS * trace.path[elastic, 0], rtol=1e-13, atol=1e-9)
    assert not trace.dissipated[elastic].any()
    yielded = (trace.dissipated > 0) | (trace.intact_n < 1) | (trace.slip[:, 0] != 0)
    assert far[np.argmax(yielded)] == pytest.approx(limit, abs=1.01 * most)


@pytest.mark.parametrize("coupling", ["combined", "independent"])
@pytest.mark.parametrize("degrees", [15, 30, 45, 60, 75])
@pytest.mark.parametrize("name", LAWS)
def test_a_proportional_path_never_leaves_the_strength_that_damage_has_left(name, degrees, coupling):
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    trace = walk(law(name, coupling=coupling), along([(0, 0, 0), (c * 60 * UM, 0, s * 60 * UM)], 0.05 * UM))
    left_n, left_s = (trace.intact_n, trace.intact_s)
    both = left_n * left_s
    tensile = both if coupling == "combined" else left_n
    cohesive = both if coupling == "combined" else left_s
    peak = np.maximum(JOINT.c0 - trace.sigma * JOINT.tan0, 0.0)
    assert np.all(trace.sigma <= tensile * JOINT.fT * (1 + 1e-12))
    assert np.all(trace.tau <= cohesive * peak * (1 + 1e-12) + 1e-9)
    assert np.all(np.diff(trace.dissipated) >= 0.0)


def torn_then_sheared(name, coupling):
    corners = [(0, 0, 0), (0, 0, 8 * UM), (0, 0, -2 * UM), (0.3e-3, 0, -2 * UM)]
    trace = walk(law(name, coupling=coupling), along(corners, 0.05 * UM))
    return trace, trace.path[:, 0] > 0


def test_combined_loss_in_tension_lowers_the_cohesion_by_the_same_share():
    for name in LAWS:
        trace, sliding = torn_then_sheared(name, "combined")
        kept = float(tension(name, JOINT, 8 * UM)) / JOINT.fT
        assert trace.intact_n[-1] == pytest.approx(kept, rel=1e-12)
        slip, residual, peak = trace.path[sliding, 0], float(JOINT.residual(0.3e6)), float(JOINT.peak(0.3e6))
        first = (residual + kept * (peak - residual)) / KS
        envelope = shear(name, JOINT, np.maximum(slip - first, 0.0) + peak / KS, 0.3e6)
        wanted = np.minimum(KS * slip, residual + kept * (envelope - residual))
        np.testing.assert_allclose(trace.tau[sliding], wanted, rtol=1e-11)


def test_independent_loss_in_tension_leaves_the_shear_envelope_alone():
    for name in LAWS:
        trace, sliding = torn_then_sheared(name, "independent")
        wanted = shear(name, JOINT, trace.path[sliding, 0], 0.3e6)
        np.testing.assert_allclose(trace.tau[sliding], wanted, rtol=1e-11)


def sheared_then_torn(name, coupling, unloading):
    """Slid under compression, let go of its shear stress, and pulled open."""
    slid = 60 * UM
    rest = slid - float(shear(name, JOINT, slid, 0.3e6)) / KS
    corners = [(0, 0, -2 * UM), (slid, 0, -2 * UM), (rest, 0, -2 * UM), (rest, 0, 0), (rest, 0, 30 * UM)]
    trace = walk(law(name, coupling=coupling, unloading=unloading), along(corners, 0.02 * UM))
    residual = float(JOINT.residual(0.3e6))
    kept = (float(shear(name, JOINT, slid, 0.3e6)) - residual) / (float(JOINT.peak(0.3e6)) - residual)
    opening = np.flatnonzero(trace.path[:, 2] > 0)
    assert np.max(trace.tau[opening]) < 1.0
    return trace, opening, kept


@pytest.mark.parametrize("unloading", ["secant", "elastic"])
def test_combined_loss_in_shear_lowers_the_tensile_envelope_by_the_same_share(unloading):
    for name in LAWS:
        trace, opening, kept = sheared_then_torn(name, "combined", unloading)
        z = trace.path[opening, 2]
        wanted = kept * tension(name, JOINT, z)
        if unloading == "elastic":
            wanted = np.where(z <= JOINT.opening_at_peak, np.minimum(KN * z, kept * JOINT.fT), wanted)
        np.testing.assert_allclose(trace.sigma[opening], wanted, rtol=1e-10, atol=1e-10 * JOINT.fT)


@pytest.mark.parametrize("unloading", ["secant", "elastic"])
def test_independent_loss_in_shear_leaves_the_tensile_envelope_alone(unloading):
    for name in LAWS:
        trace, opening, _ = sheared_then_torn(name, "independent", unloading)
        np.testing.assert_allclose(
            trace.sigma[opening], tension(name, JOINT, trace.path[opening, 2]), rtol=1e-10, atol=1e-6
        )


def test_combined_damage_is_dt_plus_ds_less_their_product():
    for name in LAWS[1:]:
        trace, opening, kept = sheared_then_torn(name, "combined", "secant")
        dt, ds = 1 - float(tension(name, JOINT, 30 * UM)) / JOINT.fT, 1 - kept
        assert trace.sigma[opening[-1]] == pytest.approx((1 - (dt + ds - dt * ds)) * JOINT.fT, rel=1e-9, abs=1e-6)


def test_tension_ends_at_the_apex_of_the_cone():
    """c/tan(phi) < fT: a contact would pull where nothing holds a slip."""
    apex = 0.3e6 / 1.01
    for name in LAWS:
        weak = law(name, cohesion=0.3e6)
        trace = walk(weak, along([(0, 0, 0), (0, 0, 3 * UM), (10 * UM, 0, 3 * UM)], 0.1 * UM))
        assert weak[1].tensile_strength == pytest.approx(apex, rel=1e-15)
        assert trace.sigma.max() <= apex * (1 + 1e-12) and trace.intact_n[-1] < 1.0
        assert np.isfinite(trace.stress).all()


@pytest.mark.parametrize("coupling", ["combined", "independent"])
@pytest.mark.parametrize("strength", [0.0, 1.0])
@pytest.mark.parametrize("name", LAWS)
def test_next_to_no_tensile_strength_is_none_and_only_faces_that_come_apart_lose_their_cohesion(
    name, strength, coupling
):
    weak = law(name, tensile_strength=strength, coupling=coupling)
    closed = walk(weak, along([(0, 0, 0), (0, 0, 0.9e-9), (0, 0, 1e-22), (0, 0, -1 * UM)]))
    assert closed.intact_n[-1] == 1.0 and not closed.sigma[closed.path[:, 2] > 0].any()
    apart = walk(weak, along([(0, 0, 0), (0, 0, 1.1e-9), (0, 0, -1 * UM)]))
    assert apart.intact_n[-1] == 0.0


@pytest.mark.parametrize("name", LAWS)
def test_a_contact_with_empty_places_beside_it_answers_as_one_among_eight(name):
    path = along([(3 * UM, 1 * UM, 4.3 * UM), (71 * UM, 13 * UM, -2.1 * UM), (-37 * UM, 5 * UM, 11.7 * UM)], 0.13 * UM)
    among, beside = (walk(law(name), path, ninth=ninth) for ninth in (False, True))
    work = np.abs(among.stress).max() * np.abs(path).max()
    assert among.intact_n[-1] < 1.0 and among.intact_s[-1] < 1.0
    np.testing.assert_allclose(beside.stress, among.stress, rtol=0, atol=1e-10 * np.abs(among.stress).max())
    np.testing.assert_allclose(beside.dissipated_by_mode, among.dissipated_by_mode, rtol=0, atol=1e-10 * work)
    np.testing.assert_allclose(beside.stored, among.stored, rtol=0, atol=1e-10 * work)

"""Dilation, eqs (9) and (10): slip lifts the faces by tan(psi), open or closed; held down, they press; sliding never
makes energy."""

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
    trace = walk(law(name, dilation_angle=PSI, dilation_cutoff=1.0), along([(0, 0, -2 * UM), (0.2e-3, 0, -2 * UM)]))
    wanted = -KN * (2 * UM + tan(PSI) * trace.slip[:, 0])
    np.testing.assert_allclose(trace.sigma, wanted, rtol=1e-11)
    assert trace.slip[-1, 0] > 100 * UM


def test_held_down_the_shear_stress_stays_on_the_cone_of_the_compression_that_acts():
    """Perfect slip: ks (us - p) = c + tan(phi) (s + kn tan(psi) p), solved for the plastic slip p."""
    trace = walk(law("linear", **PERFECT), along([(0, 0, -2 * UM), (0.2e-3, 0, -2 * UM)], 1 * UM))
    peak = 0.87e6 + 1.01 * 0.3e6
    plastic = np.maximum(KS * trace.path[:, 0] - peak, 0.0) / (KS + 1.01 * KN * tan(PSI))
    np.testing.assert_allclose(trace.tau, KS * (trace.path[:, 0] - plastic), rtol=1e-11)
    np.testing.assert_allclose(trace.sigma, -0.3e6 - KN * tan(PSI) * plastic, rtol=1e-11)


@pytest.mark.parametrize("cutoff", [30 * UM, 1.0])
@pytest.mark.parametrize("name", LAWS)
def test_under_constant_compression_the_faces_rise_by_tan_psi_times_the_plastic_slip_up_to_the_cutoff(name, cutoff):
    compression, joint, psi = 0.5e6, Joint(), tan(PSI)
    slip = along([(0.0, 0, 0), (float(joint.peak(compression)) / KS, 0, 0), (0.15e-3, 0, 0)], 0.02 * UM)[:, 0]
    plastic = slip - shear(name, joint, slip, compression) / KS
    rise = psi * np.minimum(plastic, cutoff)
    path = np.column_stack([slip, 0 * slip, rise - compression / KN])
    trace = walk(law(name, dilation_angle=PSI, dilation_cutoff=cutoff), path)
    smooth = np.ones(len(slip), dtype=bool)
    if name == "brittle":  # the drop of one step lifts the faces at once
        smooth[np.argmax(plastic > 0)] = False
    np.testing.assert_allclose(trace.sigma[smooth], -compression, rtol=5e-3)
    np.testing.assert_allclose(trace.slip[:, 0], plastic, atol=0.05 * UM)


@pytest.mark.parametrize("cutoff", [30.05 * UM, 60 * UM])
def test_the_rise_ends_exactly_at_the_cutoff(cutoff):
    for name in LAWS:
        parameters, joint = law(name, dilation_angle=PSI, dilation_cutoff=cutoff)
        state = contact(joint)
        trace = walk((parameters, joint), along([(0, 0, -2 * UM), (0.4e-3, 0, -2 * UM)], 0.7 * UM), state)
        assert trace.slip[-1, 0] > 2 * cutoff
        assert state.dilation[0] == pytest.approx(tan(PSI) * cutoff, rel=1e-12)
        assert trace.sigma[-1] == pytest.approx(-KN * (2 * UM + tan(PSI) * cutoff), rel=1e-12)


@pytest.mark.parametrize("name", LAWS)
def test_the_path_of_slip_counts_not_its_end(name):
    parameters, joint = law(name, dilation_angle=PSI, dilation_cutoff=1.0)
    state = contact(joint)
    trace = walk(
        (parameters, joint), along([(0, 0, -2 * UM), *[(60 * UM, 0, -2 * UM), (-60 * UM, 0, -2 * UM)] * 2]), state
    )
    length = np.abs(np.diff(trace.slip[:, 0])).sum()
    assert state.dilation[0] == pytest.approx(tan(PSI) * length, rel=1e-9)


def test_perfect_slip_dissipates_tau_less_sigma_tan_psi():
    """verification 2.2: (tau - sigma tan(psi)) x slip at constant sigma, here as the sum over a locked normal."""
    trace = walk(law("linear", **PERFECT), along([(0, 0, -2 * UM), (0.2e-3, 0, -2 * UM)], 1 * UM))
    tau, sigma, plastic = trace.tau, -trace.sigma, trace.slip[:, 0]
    rate = tau - sigma * tan(PSI)
    sliding = plastic > 0
    wanted = np.sum((0.5 * (rate[1:] + rate[:-1]) * np.diff(plastic))[sliding[:-1]])
    first = int(np.argmax(sliding))
    assert trace.dissipated[-1] - trace.dissipated[first] == pytest.approx(wanted, rel=1e-9)


@pytest.mark.parametrize("step", [0.1 * UM, 1 * UM, 30 * UM])
@pytest.mark.parametrize("compression", [0.0, 1.0, 0.1e6])
@pytest.mark.parametrize("name", LAWS)
def test_sliding_makes_no_energy_even_where_dilation_is_as_steep_as_friction(name, compression, step):
    steep = law(name, cohesion=0.1e6, dilation_angle=atan(0.73) * (1 - 1e-12), dilation_cutoff=1.0)
    z = -compression / KN
    corners = [(0, 0, z), (90 * UM, 0, z), (-90 * UM, 30 * UM, z), (50 * UM, 0, -compression / KN - 3 * UM)]
    trace = walk(steep, along(corners, step))
    total = trace.dissipated
    assert np.all(np.diff(total) >= -1e-12 * total[-1])


def dry(tangent: float = 0.65, ratio: float = 1.0, cutoff: float = 1.0, **options) -> tuple:
    """Faces with friction alone that rise by a share `ratio` of it."""
    strengths = {"tensile_strength": 0.0, "cohesion": 0.0, "tan_friction": tangent, "tan_residual_friction": tangent}
    return law(
        "brittle", **strengths, dilation_angle=atan(ratio * tangent) * (1 - 1e-12), dilation_cutoff=cutoff, **options
    )


@pytest.mark.parametrize("ninth", [False, True])
@pytest.mark.parametrize("ratio", [1.0, 0.5])
def test_faces_that_slide_at_an_opening_meet_once_they_have_risen_by_it_and_press_from_then_on(ratio, ninth):
    """Beyond gap / tan(psi): tau = mu kn tan(psi) p with the plastic slip p, as if they had been closed there."""
    gap, tangent = 20 * UM, ratio * 0.65
    trace = walk(dry(ratio=ratio), along([(0, 0, gap), (60 * UM, 80 * UM, gap)], 0.05 * UM), ninth=ninth)
    beyond = np.maximum(np.hypot(*trace.path[:, :2].T) - gap / tangent, 0.0)
    plastic = KS * beyond / (KS + 0.65 * KN * tangent)
    np.testing.assert_allclose(trace.sigma, -KN * tangent * plastic, rtol=1e-9, atol=1e-3)
    np.testing.assert_allclose(trace.tau, 0.65 * KN * tangent * plastic, rtol=1e-9, atol=1e-3)
    assert trace.sigma[-1] < -1e5 and not trace.stress[beyond == 0.0].any()
    assert not trace.stored[beyond == 0.0].any(), "what floats is off its springs"


@pytest.mark.parametrize("cutoff", [1.0, 10 * UM])
def test_faces_that_are_let_down_meet_at_the_height_of_the_slope_they_stand_over(cutoff):
    """However they came there: what floats does not slip, so moving to and fro above a face does not raise it."""
    side, top = 30 * UM, 50 * UM
    wanders = [
        (0, 0, 0),
        (0, 0, top),
        *[(70 * UM, -20 * UM, top), (-70 * UM, 0, top)] * 5,
        (0, side, top),
        (0, side, 0),
    ]
    trace = walk(dry(cutoff=cutoff), along(wanders, 0.05 * UM))
    height = 0.65 * min(side, cutoff)
    falling = slice(-int(np.ceil(top / (0.05 * UM))), None)
    above = trace.path[falling, 2] > height + 1e-12
    assert not trace.stress[falling][above].any()
    assert np.all(trace.sigma[falling][~above][1:] < 0.0)
    assert above.sum() == pytest.approx((top - height) / (0.05 * UM), abs=1.5)


@pytest.mark.parametrize("ratio", [1.0, 0.5])
def test_faces_with_as_much_dilation_as_friction_spend_nothing_and_others_what_is_between(ratio):
    """(mu - tan(psi)) |sigma| for each slip, whatever opens and closes between; exact as the steps get shorter."""
    path = [(0, 0, 0), (20 * UM, 0, 20 * UM), (60 * UM, 0, 15 * UM), (60 * UM, 30 * UM, 3 * UM), (0, 30 * UM, 60 * UM)]
    gaps = []
    for step in (0.04 * UM, 0.01 * UM):
        trace = walk(dry(ratio=ratio), along([*path, (0, 10 * UM, 5 * UM), (0, 0, -1 * UM)], step))
        assert trace.stored.max() > 1.0 and np.all(trace.stored >= 0.0)
        assert np.all(np.diff(trace.dissipated) >= -1e-12 * trace.stored.max())
        gaps.append(np.abs(trace.gap).max() / trace.stored.max())
        spent = trace.dissipated[-1] / trace.stored.max()
        assert spent == pytest.approx(0.0, abs=1e-9) if ratio == 1.0 else spent > 0.1
    assert gaps[1] < 0.3 * gaps[0] and gaps[1] < 2e-3


@pytest.mark.parametrize("name", [pytest.param(n, marks=pytest.mark.slow if n != "exponential" else ()) for n in LAWS])
def test_torn_faces_that_something_still_ties_slip_and_rise_while_they_stand_open(name):
    """With independent coupling cohesion outlasts the tear."""
    parameters, joint = law(name, dilation_angle=PSI, dilation_cutoff=1.0, coupling="independent")
    state = contact(joint)
    walk((parameters, joint), along([(0, 0, 0), (0, 0, 60 * UM), (100 * UM, 0, 60 * UM)]), state)
    assert state.plastic_slip[0] > 80 * UM
    assert state.dilation[0] == pytest.approx(tan(PSI) * state.plastic_slip[0], rel=1e-6)


def test_torn_faces_whose_opening_stays_do_not_rise_on_it():
    parameters, joint = law("exponential", dilation_angle=PSI, dilation_cutoff=1.0, unloading="elastic")
    state = contact(joint)
    walk((parameters, joint), along([(0, 0, 0), (0, 0, 60 * UM), (100 * UM, 0, 60 * UM)]), state)
    assert state.dilation[0] < 1e-3 * tan(PSI) * 100 * UM


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

"""Slip that turns back, turns round, and slides under a changing compression."""

import numpy as np
import pytest

from verification.fixtures.one_contact import along, law, walk
from verification.references.closed_forms import LAWS, Joint, dissipated_in_shear, shear

UM = 1e-6
PERFECT = {"residual_cohesion": 0.87e6, "tan_residual_friction": 1.01}


def at(compression, *corners, most=0.1 * UM):
    """Path through the corners (slip x, slip y) in m under constant compression."""
    return along([(x, y, -compression / 150e9) for x, y in ((0.0, 0.0), *corners)], most)


@pytest.mark.parametrize("name", LAWS)
def test_reversed_slip_returns_along_ks_and_slides_at_the_strength_left(name):
    trace = walk(law(name), at(0.5e6, (80 * UM, 0), (-120 * UM, 0)))
    x, joint = trace.path[:, 0], Joint()
    turn = int(np.argmax(x >= 80 * UM - 1e-15))
    top = float(shear(name, joint, 80 * UM, 0.5e6))
    again = 80 * UM - 2.0 * top / joint.ks
    back = top - joint.ks * (80 * UM - x[turn:])
    wanted = np.where(x[turn:] >= again, back, -shear(name, joint, 80 * UM + again - x[turn:], 0.5e6))
    np.testing.assert_allclose(trace.stress[turn:, 0], wanted, rtol=0, atol=1e-10 * top)


@pytest.mark.parametrize("name", LAWS)
def test_the_energy_of_a_slip_cycle_is_the_area_of_its_loop(name):
    joint, top = Joint(), float(shear(name, Joint(), 80 * UM, 0.5e6))
    us0 = float(joint.peak(0.5e6)) / joint.ks
    trace = walk(law(name), at(0.5e6, (us0, 0), (80 * UM, 0), (-80 * UM, 0)))
    wanted = float(dissipated_in_shear(name, joint, 240 * UM - 2 * top / joint.ks, 0.5e6))
    assert trace.dissipated[-1] == pytest.approx(wanted, rel=1e-3 if name == "brittle" else 1e-5)


@pytest.mark.parametrize("variable", ["displacement", "plastic"])
@pytest.mark.parametrize("name", LAWS)
def test_slip_that_turns_by_90_degrees_stays_on_the_cone_and_parallel_to_its_stress(name, variable):
    trace = walk(law(name, softening_variable=variable), at(0.5e6, (60 * UM, 0), (60 * UM, 150 * UM)))
    slipped, stress = np.diff(trace.slip[:, :2], axis=0), trace.stress[1:, :2]
    moving = np.hypot(*slipped.T) > 1e-13
    assert moving.sum() > 1000
    cross = slipped[:, 0] * stress[:, 1] - slipped[:, 1] * stress[:, 0]
    size = np.hypot(*slipped.T) * np.hypot(*stress.T)
    assert np.max(np.abs(cross[moving]) / size[moving]) < 1e-8
    assert np.all(np.sum(slipped * stress, axis=1) >= 0.0)
    joint = Joint()
    strength = joint.residual(0.5e6) + trace.intact_s[1:] * (joint.peak(0.5e6) - joint.residual(0.5e6))
    np.testing.assert_allclose(trace.tau[1:][moving], strength[moving], rtol=1e-12)
    assert trace.stress[-1, 1] > 0.99 * trace.tau[-1]


def test_the_stress_turns_after_the_slip_as_perfect_plasticity_has_it():
    """t = T (cos a, sin a): a' = ks cos(a)/T along y, so a = 2 atan(tanh(ks y/(2 T)))."""
    strength = 0.87e6 + 1.01 * 0.5e6
    errors = []
    for most in (0.2 * UM, 0.1 * UM, 0.05 * UM):
        trace = walk(law("linear", **PERFECT), at(0.5e6, (60 * UM, 0), (60 * UM, 100 * UM), most=most))
        y = trace.path[:, 1]
        angle = 2 * np.arctan(np.tanh(70e9 * y / (2 * strength)))
        turning = y > 0
        assert trace.tau[turning] == pytest.approx(strength, rel=1e-12)
        found_angle = np.arctan2(trace.stress[turning, 1], trace.stress[turning, 0])
        errors.append(np.max(np.abs(found_angle - angle[turning])))
    assert errors[2] < 2e-3
    assert errors[1] / errors[2] == pytest.approx(2.0, rel=0.1)


@pytest.mark.parametrize("name", LAWS)
def test_perfect_slip_follows_the_cone_while_the_compression_changes(name):
    corners = [(0, 0, -1 * UM), (40 * UM, 0, -1 * UM), (90 * UM, 0, -9 * UM), (200 * UM, 0, -0.5 * UM)]
    trace = walk(law(name, **PERFECT), along(corners, 0.1 * UM))
    sliding = trace.path[:, 0] > 40 * UM
    wanted = 0.87e6 - trace.sigma * 1.01
    np.testing.assert_allclose(trace.tau[sliding], wanted[sliding], rtol=1e-12)


@pytest.mark.parametrize("name", LAWS)
def test_a_falling_compression_alone_lets_the_shear_stress_slide_down_the_cone(name):
    corners = [(0, 0, -6 * UM), (20 * UM, 0, -6 * UM), (20 * UM, 0, -0.5 * UM), (20 * UM, 0, -6 * UM)]
    trace = walk(law(name, **PERFECT), along(corners, 0.05 * UM))
    assert np.all(trace.tau <= (0.87e6 - trace.sigma * 1.01) * (1 + 1e-12))
    lowest = 0.87e6 + 0.5 * UM * 150e9 * 1.01
    assert trace.tau[-1] == pytest.approx(lowest, rel=1e-12)


@pytest.mark.parametrize("name", LAWS[1:])
def test_under_a_changing_compression_the_share_left_falls_by_what_is_slid_in_each_step(name):
    """Share after a step: on the curve of the compression that acts, from where it has the share before."""
    joint, corners = Joint(), [(0, 0, -1 * UM), (60 * UM, 0, -1 * UM), (140 * UM, 0, -9 * UM), (300 * UM, 0, -0.5 * UM)]
    trace = walk(law(name), along(corners, 0.1 * UM))
    s, total = -trace.sigma, trace.path[:, 0]
    peak, rest, energy = joint.peak(s), joint.residual(s), joint.mode_2_energy(s)
    width = {
        "linear": 2 * energy / (peak - rest) - (peak - rest) / joint.ks,
        "polynomial": 2 * energy / peak,
        "exponential": energy / joint.c0,
    }[name]
    curve = {
        "linear": lambda x: max(1 - x, 0),
        "polynomial": lambda x: (1 + x) ** -2.5,
        "exponential": lambda x: np.exp(-x),
    }
    back = {"linear": lambda y: 1 - y, "polynomial": lambda y: y**-0.4 - 1, "exponential": lambda y: -np.log(y)}
    for k in range(1, len(s)):
        trial, left = trace.tau[k - 1] + joint.ks * (total[k] - total[k - 1]), trace.intact_s[k - 1]
        slid = (trial - rest[k] - left * (peak[k] - rest[k])) / joint.ks
        if slid > 0 and left > 0:
            left = curve[name](back[name](left) + slid / width[k])
        assert trace.intact_s[k] == pytest.approx(left, rel=1e-9, abs=1e-12)
        assert trace.tau[k] == pytest.approx(min(trial, rest[k] + left * (peak[k] - rest[k])), rel=1e-9)


SLIP_AGAIN = [(0, 0, -1e6), (100 * UM, 0, -1e6), (70 * UM, 0, -1e6), (70 * UM, 0, -0.1e6), (120 * UM, 0, -0.1e6)]


@pytest.mark.parametrize("variable", ["displacement", "plastic"])
@pytest.mark.parametrize("name", LAWS)
def test_slip_again_under_less_compression_goes_on_from_the_strength_that_was_left(name, variable):
    """No step moves the stress by more than ks times its slip, however the compression has changed meanwhile."""
    path = np.array(SLIP_AGAIN) / (1.0, 1.0, 150e9)
    for most in (0.4 * UM, 0.2 * UM, 0.1 * UM):
        trace = walk(law(name, softening_variable=variable), along(path, most))
        again = slice(int(np.argmax(trace.path[:, 2] > -0.11e6 / 150e9)), None)
        jump = np.abs(np.diff(trace.stress[again, 0]))
        assert jump.max() <= 1.001 * 70e9 * most
        assert np.abs(np.diff(trace.slip[again, 0])).max() > 0.5 * most, "it slides again"


@pytest.mark.parametrize("name", LAWS)
def test_without_confinement_and_without_cohesion_nothing_holds_a_slip(name):
    trace = walk(law(name, cohesion=0.0), at(0.0, (50 * UM, 0)))
    assert not trace.tau.any()
    assert not trace.dissipated.any()


@pytest.mark.parametrize("name", LAWS)
def test_a_joint_without_cohesion_is_held_by_friction_alone(name):
    """eq. (17) with c0 = 0 has nothing to soften with: its friction angle stays."""
    trace = walk(law(name, cohesion=0.0), at(0.5e6, (0.6e-3, 0)))
    wanted = shear(name, Joint(c0=0.0), trace.path[:, 0], 0.5e6)
    np.testing.assert_allclose(trace.tau, wanted, rtol=0, atol=1e-12 * wanted.max())


@pytest.mark.parametrize("name", LAWS)
def test_a_cohesion_that_is_all_residual_softens_in_friction_only(name):
    trace = walk(law(name, residual_cohesion=0.87e6), at(0.5e6, (0.6e-3, 0)))
    wanted = shear(name, Joint(c_res=0.87e6), trace.path[:, 0], 0.5e6)
    np.testing.assert_allclose(trace.tau, wanted, rtol=0, atol=1e-12 * wanted.max())
    assert trace.tau[-1] >= 0.87e6 + 0.5e6 * 0.73


@pytest.mark.parametrize("name", LAWS)
def test_a_joint_without_tensile_strength_shears_like_any_other(name):
    trace = walk(law(name, tensile_strength=0.0), at(0.5e6, (0.6e-3, 0)))
    wanted = shear(name, Joint(), trace.path[:, 0], 0.5e6)
    np.testing.assert_allclose(trace.tau, wanted, rtol=0, atol=1e-12 * wanted.max())


@pytest.mark.parametrize("compression", [0.0, 0.5e6])
def test_softening_by_plastic_slip_follows_the_same_law_of_the_plastic_slip(compression):
    """tau = t_res + left(p) drop, us = p + tau/ks, at every step, however long."""
    joint = Joint()
    peak, residual, G_II = (float(f(compression)) for f in (joint.peak, joint.residual, joint.mode_2_energy))
    curves = {
        "linear": lambda p: np.maximum(0.0, 1 - p * (peak - residual) / (2 * G_II)),
        "polynomial": lambda p: (1 + p * peak / (2 * G_II)) ** -joint.beta,
        "exponential": lambda p: np.exp(-joint.c0 / G_II * p),
    }
    for name, left in curves.items():
        for most in (0.2 * UM, 4.0 * UM):
            trace = walk(law(name, softening_variable="plastic"), at(compression, (0.4e-3, 0), most=most))
            plastic = trace.slip[:, 0]
            wanted = residual + left(plastic) * (peak - residual)
            sliding = plastic > 0
            np.testing.assert_allclose(trace.tau[sliding], wanted[sliding], rtol=0, atol=1e-9 * peak)
            assert np.all(np.diff(trace.intact_s) <= 0.0)
            assert np.all(np.diff(trace.tau[sliding]) <= 1e-9 * peak)


@pytest.mark.parametrize("name", LAWS)
def test_the_energy_of_softening_by_plastic_slip_is_the_area_over_the_plastic_slip(name):
    """The curve over plastic slip has the area of the law; friction is t_res on all of it.

    G_II of the linear law is the whole triangle (physics: the elastic part included), whatever the variable; a brittle
    contact lets go of what its spring held above t_res.
    """
    joint, compression = Joint(beta=4.0), 0.5e6
    trace = walk(
        law(name, softening_variable="plastic", exponent_shear=4.0), at(compression, (4e-3, 0), most=0.05 * UM)
    )
    peak, residual, G_II = (float(f(compression)) for f in (joint.peak, joint.residual, joint.mode_2_energy))
    drop = peak - residual
    area = {
        "brittle": 0.5 * drop**2 / joint.ks,
        "linear": G_II,
        "polynomial": 2 * G_II * drop / peak / 3.0 * (1 - (1 + trace.slip[-1, 0] * peak / 2 / G_II) ** -3.0),
        "exponential": G_II * drop / joint.c0,
    }[name]
    assert trace.dissipated_by_mode[-1, 1] == pytest.approx(
        area, rel=1e-3, abs=2 * drop * 0.05 * UM if name == "brittle" else 0.0
    )
    assert trace.dissipated_by_mode[-1, 2] == pytest.approx(residual * trace.slip[-1, 0], rel=1e-9)

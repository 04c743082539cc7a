"""A motion of the ground is integrated exactly, whatever it is made of."""

import numpy as np
import pytest

from masonry.ground import ground_motion
from masonry.ground.ground_motion import from_acceleration, from_displacement, from_formula, from_samples, from_velocity

RANDOM = np.random.default_rng(3)
TIME = np.arange(300) * 0.01


def dense(motion, pieces=40):
    """Times that are close together, those of the samples among them."""
    share = np.arange(pieces) / pieces
    return np.append((motion.time[:-1, None] + np.diff(motion.time)[:, None] * share).ravel(), motion.duration)


def test_an_acceleration_that_is_straight_between_samples_is_integrated_exactly():
    motion = from_acceleration(np.array([0.0, 1.0, 3.0]), np.array([0.0, 6.0, 0.0]))
    # 6 t up to 1 s: v = 3 t^2, u = t^3; then 6 - 3 s: v = 3 + 6 s - 1.5 s^2, u = 1 + 3 s + 3 s^2 - s^3 / 2
    assert motion.velocity_at(np.array([0.5, 2.0])) == pytest.approx([0.75, 7.5], rel=1e-15)
    assert motion.displacement_at(np.array([0.5, 2.0])) == pytest.approx([0.125, 6.5], rel=1e-15)
    assert motion.residual_velocity == pytest.approx(9.0) and motion.residual_displacement == pytest.approx(15.0)
    assert motion.velocity_at(np.array([-1.0, 5.0])) == pytest.approx([0.0, 9.0])
    assert motion.displacement_at(np.array([-1.0, 5.0])) == pytest.approx([0.0, 33.0])
    assert motion.peak_acceleration == 6.0 and motion.scaled(2.0).peak_velocity == pytest.approx(18.0)


def test_the_largest_velocity_may_lie_between_two_samples():
    motion = from_acceleration(np.array([0.0, 1.0, 2.0]), np.array([1.0, -1.0, -1.0]))
    assert motion.peak_velocity == pytest.approx(1.0) and motion.velocity_at(np.array([0.5])) == pytest.approx([0.25])


def test_the_largest_velocity_lies_where_an_acceleration_of_unlike_ends_passes_through_zero():
    """From 2 to -1 m/s2 in a second: at 2/3 s, before it comes down to 0.5 and to -0.5 m/s."""
    motion = from_acceleration(np.array([0.0, 1.0, 2.0]), np.array([2.0, -1.0, -1.0]))
    assert motion.peak_velocity == pytest.approx(2.0 / 3.0, rel=1e-12)
    back = from_acceleration(np.array([0.0, 2.0, 5.0]), np.array([-1.0, 3.0, 1.0]))
    assert back.peak_velocity == pytest.approx(8.0) and back.velocity.min() == 0.0, "it is the end that is largest"


@pytest.mark.parametrize("count", [3, 4])
@pytest.mark.parametrize("end", [2.0, 0.6])
def test_the_accelerations_at_both_ends_of_few_samples_are_those_of_the_polynomial_through_them(count, end):
    """Of a velocity a parabola or a cubic from rest to rest; of a displacement one degree more, without a slope."""
    t = np.linspace(0.0, end, count)
    more = 0.0 if count == 3 else 0.7
    motion = from_velocity(t, t * (end - t) * (1.0 + more * t))
    assert motion.acceleration[[0, -1]] == pytest.approx([end, -end * (1.0 + more * end)], rel=1e-9)
    place = t**2 * (3.0 * end - 2.0 * t) if count == 3 else t**2 * (end - t) ** 2
    exact = [6.0 * end, -6.0 * end] if count == 3 else [2.0 * end**2, 2.0 * end**2]
    assert from_displacement(t, place).acceleration[[0, -1]] == pytest.approx(exact, rel=1e-9)


def test_a_linear_baseline_leaves_no_residual():
    motion = from_acceleration(TIME, RANDOM.normal(size=300))
    straightened = motion.with_linear_baseline()
    assert abs(straightened.residual_velocity) < 1e-13 and abs(straightened.residual_displacement) < 1e-13
    again = from_acceleration(TIME, straightened.acceleration)
    assert again.displacement == pytest.approx(straightened.displacement, abs=1e-13)


@pytest.mark.parametrize("count", [2, 3, 4, 300])
def test_a_displacement_becomes_a_spline_with_continuous_acceleration_at_rest_at_its_ends(count):
    time = np.linspace(0.0, 3.0, count)
    place = 0.1 * np.sin(2 * time) * time**2
    for motion in (from_displacement(time, place), slow := from_displacement(time, place, slowly=True)):
        assert motion.displacement_at(time) == pytest.approx(place, abs=1e-14)
        assert np.abs(motion.velocity[[0, -1]]).max() < 1e-12
        again = from_acceleration(motion.time, motion.acceleration)
        assert again.displacement_at(time) == pytest.approx(place, abs=1e-12)
    assert np.abs(slow.acceleration[[0, -1]]).max() < 1e-10


def test_a_smooth_displacement_shakes_with_its_own_acceleration():
    place = 0.1 * np.sin(2 * np.pi * TIME) * np.sin(np.pi * TIME / TIME[-1]) ** 4
    exact = np.gradient(np.gradient(place, TIME), TIME)
    assert from_displacement(TIME, place).peak_acceleration == pytest.approx(np.abs(exact).max(), rel=5e-3)


def test_a_velocity_becomes_parabolas_with_continuous_acceleration():
    speed = np.sin(7 * TIME) * np.sin(np.pi * TIME / TIME[-1]) ** 2
    motion = from_velocity(TIME, speed)
    assert motion.velocity_at(TIME) == pytest.approx(speed, abs=1e-14)
    assert np.abs(motion.acceleration[[0, -1]]).max() < 2e-3
    again = from_acceleration(motion.time, motion.acceleration)
    assert again.displacement_at(TIME) == pytest.approx(motion.displacement_at(TIME), abs=1e-13)


@pytest.mark.parametrize("count", [40, 41, 400])
@pytest.mark.parametrize("end", [1.0, 1.3])
def test_a_motion_that_begins_and_ends_with_an_acceleration_does_not_overshoot_it(count, end):
    """v = A sin(w t) + B sin(2 w t) from rest to rest, and its integral: accelerations begin and end at once."""
    t, w = np.linspace(0.0, end, count), 2.0 * np.pi / end
    speed = 0.3 * np.sin(w * t) + 0.1 * np.sin(2.0 * w * t)
    acceleration = lambda t: 0.3 * w * np.cos(w * t) + 0.2 * w * np.cos(2.0 * w * t)  # noqa: E731
    motion = from_velocity(t, speed)
    off = 40.0 / count**2 * 0.5 * w
    assert np.abs(motion.acceleration - acceleration(motion.time)).max() < 0.2 * off
    assert motion.peak_acceleration == pytest.approx(0.5 * w, abs=0.2 * off)
    place = 0.05 * (1.0 - np.cos(w * t)) + 0.02 * (1.0 - np.cos(2.0 * w * t))
    exact = 0.05 * w**2 * np.cos(w * t) + 0.08 * w**2 * np.cos(2.0 * w * t)
    assert from_displacement(t, place).peak_acceleration == pytest.approx(exact.max(), rel=1.0 * 40.0 / count**2)


@pytest.mark.parametrize("duration", [25.6, 51.2, 61.7, 163.84])
@pytest.mark.parametrize("quantity", ["acceleration", "velocity", "displacement"])
def test_a_formula_that_lasts_long_is_followed_whatever_its_period_fits(quantity, duration):
    """10 Hz, with periods that fit the first samples, or nearly: the sway is that of the integral."""
    w = 20.0 * np.pi
    cycles = round(duration / 0.1) * 0.1
    at = {
        "acceleration": lambda t: 3.0 * np.sin(w * t),
        "velocity": lambda t: 0.05 * np.sin(w * t),
        "displacement": lambda t: 1e-3 * (1.0 - np.cos(w * t)),
    }[quantity]
    motion = from_formula(quantity, at, cycles)
    peak = {"acceleration": 3.0, "velocity": 0.05 * w, "displacement": 1e-3 * w**2}[quantity]
    assert motion.peak_acceleration == pytest.approx(peak, rel=2e-4)
    sway = {"acceleration": 3.0 / w * cycles, "velocity": 0.1 / w, "displacement": 2e-3}[quantity]
    assert motion.peak_displacement == pytest.approx(sway, rel=1e-3)


def test_a_pulse_that_is_short_beside_its_duration_is_seen():
    motion = from_formula("acceleration", lambda t: np.clip(1.0 - np.abs(t - 41.2137) / 0.01, 0.0, 1.0), 100.0)
    assert motion.residual_velocity == pytest.approx(0.01, rel=1e-4)
    bell = lambda t: np.where(np.abs(t - 41.2137) < 0.15, 0.5 + 0.5 * np.cos((t - 41.2137) / 0.15 * np.pi), 0.0)  # noqa: E731
    motion = from_formula("velocity", bell, 100.0)
    assert motion.residual_displacement == pytest.approx(0.15, rel=1e-3)
    assert motion.peak_acceleration == pytest.approx(0.5 * np.pi / 0.15, rel=1e-2)


@pytest.mark.parametrize(
    ("quantity", "at", "says"),
    [
        ("acceleration", lambda t: np.sin(100.0 * t), "swings too often for 65536 straight pieces.*shorten the dur"),
        ("velocity", lambda t: np.where((t > 3.1) & (t < 7.3), 1.0, 0.0), "the velocity jumps, has corners, or swings"),
        ("displacement", lambda t: np.abs(np.abs(t - 5.0) - 2.5), "the displacement starts"),
        ("displacement", lambda t: np.maximum(0.0, 1.0 - np.abs(t - 5.0)), "the displacement jumps, has corners"),
        ("acceleration", lambda t: 1.0 / t, "the expression has no finite value at t = 0 s"),
        ("velocity", lambda t: 0.0 / (t - 5.0), "the expression has no finite value at t = 5 s"),
    ],
)
def test_a_formula_that_cannot_be_followed_is_refused(quantity, at, says, monkeypatch):
    monkeypatch.setattr(ground_motion, "MOST_OF_SPLINES", 2**19)
    monkeypatch.setattr(ground_motion, "MOST_PIECES", 2**16)
    with pytest.raises(ValueError, match=says):
        from_formula(quantity, at, 10.0 if quantity != "acceleration" else 20.0)


def test_a_velocity_that_begins_at_once_is_refused_unless_its_line_is_taken_off():
    speed = np.cos(7 * TIME)
    with pytest.raises(ValueError, match="begins with 1 m/s.*baseline = 'linear'"):
        from_velocity(TIME, speed)
    assert from_samples("velocity", TIME, speed, "linear").velocity[[0, -1]] == pytest.approx([0.0, 0.0])


def test_a_formula_is_followed_as_closely_as_it_is_straight():
    motion = from_formula("acceleration", lambda t: 5.0 * np.sin(2 * np.pi * t), 2.0)
    t = dense(motion)
    assert np.abs(motion.acceleration_at(t) - 5.0 * np.sin(2 * np.pi * t)).max() < 1e-4
    assert len(motion.time) < 3000
    corner = from_formula("acceleration", lambda t: np.where(t < 0.3, 1.0, 0.0), 1.0)
    assert corner.residual_velocity == pytest.approx(0.3, abs=1e-7)


def test_a_formula_of_the_displacement_starts_and_ends_at_rest():
    motion = from_formula("displacement", lambda t: 0.1 * np.sin(2 * np.pi * t) * np.sin(np.pi * t / 10) ** 4, 10.0)
    assert motion.peak_acceleration == pytest.approx(0.1 * (2 * np.pi) ** 2, rel=5e-2)
    with pytest.raises(ValueError, match="the displacement starts with 0.628 m/s"):
        from_formula("displacement", lambda t: 0.1 * np.sin(2 * np.pi * t), 10.0)


@pytest.mark.parametrize("dt", [0.0013, 0.01, 0.0009999, 0.004])
def test_means_over_steps_drive_a_leapfrog_with_the_exact_velocity_at_half_steps(dt):
    motion = from_acceleration(TIME, RANDOM.normal(size=300))
    mean, knots = motion.over_steps(-0.5, dt, 3000)
    half = -0.5 + dt * (np.arange(3001) + 0.5)
    assert np.cumsum(mean) * dt == pytest.approx(motion.velocity_at(half), abs=1e-12)
    assert np.interp(np.arange(3001), knots, mean[knots]) == pytest.approx(mean, abs=1e-12)

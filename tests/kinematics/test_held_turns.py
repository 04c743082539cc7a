"""A rigid brick whose turns are prescribed, held in part, driven, loaded and damped."""

import numpy as np
import pytest

from masonry.kinematics import turning
from masonry.kinematics.motion import Guided
from masonry.model.body_arrays import in_rows
from tests.kinematics import bricks

FREE = (True,) * 6
MOMENT = np.array([0.02, -0.05, 0.04])
START = bricks.turn(0, 0.4) @ bricks.turn(1, -0.9)


def loaded(dt: float, free: tuple, start: np.ndarray = START, moment: np.ndarray = MOMENT, **fields):
    """A turned brick under a dead moment; None among the optional fields stays."""
    load = in_rows(np.array([[0.0, 0.0, 0.0, *moment]]))
    return bricks.brick(dt, free=free, load=load, **fields)._replace(frame=start[None].copy())


def test_a_held_block_turns_as_it_is_driven():
    dt, speed = 1e-3, 3.0
    body = loaded(dt, (False,) * 6)
    body.v[0, 5] = speed
    bricks.fly(body, dt, 1, speed=speed, drive=np.array([[0, 5]]))
    body.work[...] = 0.0  # the load came at once
    bricks.fly(body, dt, 999, speed=speed, drive=np.array([[0, 5]]))
    assert body.frame[0] == pytest.approx(bricks.turn(2, 3.0) @ START, abs=1e-12)
    assert body.hold[0, 3:] == pytest.approx(-MOMENT, abs=1e-15)
    assert body.work[0] == pytest.approx(0.0, abs=1e-12)
    assert not body.momentum.any()


def test_a_block_on_an_axle_turns_by_its_moment_of_inertia_about_it():
    dt, steps = 1e-3, 400
    body = loaded(dt, (False,) * 5 + (True,))
    bricks.fly(body, dt, steps)
    inertia = (START @ np.diag(bricks.INERTIA) @ START.T)[2, 2]
    assert body.v[0, 3:] == pytest.approx([0.0, 0.0, MOMENT[2] * steps * dt / inertia], rel=1e-11)
    angle = MOMENT[2] / inertia * dt**2 * steps * (steps - 1) / 2
    assert body.frame[0] == pytest.approx(bricks.turn(2, angle) @ START, abs=1e-11)
    assert body.hold[0, 3:5] == pytest.approx(-MOMENT[:2], abs=1e-15)


def closing(body, dt: float, steps: int, damping=None, **drive) -> tuple[float, np.ndarray]:
    """Largest gap of the balance in some rows after the first, over the energy at the first; and all works."""
    gaps, reference = [], None
    for _ in range(10):
        bricks.fly(body, dt, steps, damping, **drive)
        before = turning.momenta(body)
        bricks.fly(body, dt, 1, damping, **drive)
        gap = bricks.kinetic_of_a_brick(body, before) + body.work[0, 3] - body.work[0, :3].sum()
        reference = gap if reference is None else reference
        gaps.append(abs(gap - reference))
    return max(gaps) / reference, body.work[0]


@pytest.mark.parametrize("free", [FREE, (True,) * 5 + (False,), (True, True, True, False, True, False)])
@pytest.mark.parametrize("damping", [None, 0.3])
def test_the_ledger_closes_and_the_rotor_loses_in_the_second_order(free, damping):
    losses = []
    for dt in (1e-3, 5e-4):
        body = loaded(dt, free)
        body.v[0] = np.where(free, [0.1, 0.2, 0.3, 0.5, 4.0, 1.5], 0.0)
        turning.spin(body)
        gap, works = closing(body, dt, round(0.05 / dt), damping)
        assert gap < 1e-13
        assert body.v[0, np.flatnonzero(np.logical_not(free))] == pytest.approx(0.0, abs=0.0)
        losses.append(works[3])
    if sum(free[3:]) > 1:
        assert losses[0] / losses[1] == pytest.approx(4.0, abs=0.6)
    else:
        assert losses == pytest.approx([0.0, 0.0], abs=1e-15)


def test_the_ledger_closes_where_one_turn_is_driven_and_others_are_free():
    body = loaded(1e-3, (True,) * 5 + (False,))
    body.v[0, 3:] = 0.5, 1.0, 2.0
    turning.spin(body)
    gap, works = closing(body, 1e-3, 50, 0.2, speed=2.0, drive=np.array([[0, 5]]))
    assert gap < 1e-13
    assert body.v[0, 5] == 2.0


@pytest.mark.parametrize("damping", [pytest.param(0.5, marks=pytest.mark.slow), Guided(0.02, 0.1)])
def test_damping_of_turns_is_the_same_from_wherever_one_looks(damping):
    dt, turned, guess = 1e-3, bricks.turn(0, 1.0) @ bricks.turn(2, 0.6), np.array([0.3, 0.2, -0.1])
    rates = []
    for by in (np.eye(3), turned):
        expected = in_rows(np.array([[0.0, 0.0, 0.0, *(by @ guess)]]))
        body = loaded(dt, FREE, by @ START, by @ MOMENT, guess=expected)
        body.v[0, 3:] = by @ [1.0, 4.0, -2.0]
        turning.spin(body)
        bricks.fly(body, dt, 500, damping, speed=0.7)
        rates.append((by.T @ body.frame[0], by.T @ body.v[0, 3:]))
    for here, there in zip(*rates, strict=True):
        assert here == pytest.approx(there, abs=1e-11)


def test_damping_takes_energy():
    body = bricks.brick(1e-3)
    body.v[0, 3:] = 1.0, 4.0, -2.0
    turning.spin(body)
    bricks.fly(body, 1e-3, 500, Guided(0.01, 0.0))
    assert body.work[0, 1] < -0.5 * 0.9 * bricks.INERTIA @ np.array([1.0, 16.0, 4.0])

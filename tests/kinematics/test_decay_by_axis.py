"""Damping of turns, axis by axis: each principal axis of a brick decays by its own moment of inertia."""

import numpy as np
import pytest

from masonry.kinematics import turning
from masonry.kinematics.motion import Guided
from masonry.model.body_arrays import in_rows
from tests.kinematics import bricks

H, STEPS, DT = 0.05, 40, 1e-3
START = bricks.turn(0, 0.4) @ bricks.turn(1, -0.9)


def turning_brick(axis: int, rate: float, start: np.ndarray = START, **fields):
    """A turned brick that turns about one of its principal axes, which stays where it is then."""
    body = bricks.brick(DT, **fields)._replace(frame=start[None].copy())
    body.v[0, 3:] = rate * start[:, axis]
    turning.spin(body)
    return body


@pytest.mark.parametrize("axis", [0, 1, 2])
@pytest.mark.parametrize("start", [np.eye(3), START], ids=["straight", "turned"])
def test_an_unexpected_turn_decays_about_each_axis_by_one_less_h_over_one_more(axis, start):
    body = turning_brick(axis, 0.3, start)
    energy = 0.5 * 0.3**2 * bricks.INERTIA[axis]
    bricks.fly(body, DT, STEPS, Guided(H, 0.0))
    left = ((1.0 - H) / (1.0 + H)) ** STEPS
    assert body.v[0, 3:] == pytest.approx(0.3 * left * start[:, axis], rel=1e-9, abs=1e-12)
    assert body.work[0, 1] == pytest.approx(-energy * (1.0 - left**2), rel=0.06), "but for half a step"


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_a_turn_that_is_expected_meets_no_damping(axis):
    expected = in_rows(np.array([[0.0, 0.0, 0.0, *(0.3 * START[:, axis])]]))
    body = turning_brick(axis, 0.3, guess=expected, load=in_rows(np.zeros((1, 6))))
    bricks.fly(body, DT, STEPS, Guided(H, 0.0), speed=1.0)
    assert body.v[0, 3:] == pytest.approx(0.3 * START[:, axis], rel=1e-9, abs=1e-12)
    assert body.work[0, 1] == pytest.approx(0.0, abs=1e-15)


@pytest.mark.parametrize("rate", [5.0, -5.0])
@pytest.mark.parametrize("axis", [0, 1, 2])
def test_local_damping_leaves_of_a_moment_what_its_share_says(axis, rate):
    """Along the turn it takes the share, against it, as the turn slows, it adds it."""
    moment, share = 0.02, 0.3
    for sign in (1.0, -1.0):
        load = in_rows(np.array([[0.0, 0.0, 0.0, *(sign * moment * START[:, axis])]]))
        body = turning_brick(axis, rate, load=load)
        bricks.fly(body, DT, STEPS, share)
        gained = STEPS * DT * moment * (sign - share * np.sign(rate)) / bricks.INERTIA[axis]
        assert body.v[0, 3:] == pytest.approx((rate + gained) * START[:, axis], rel=1e-9, abs=1e-10)


@pytest.mark.parametrize("rate", [5.0, -5.0])
@pytest.mark.parametrize("dof", [0, 1, 2])
def test_local_damping_leaves_of_a_force_what_its_share_says(dof, rate):
    push = in_rows(np.array([2.0 * np.eye(6)[dof]]))
    body = bricks.brick(DT, load=push)
    body.v[0, dof] = rate
    bricks.fly(body, DT, STEPS, 0.3)
    assert body.v[0, dof] == pytest.approx(rate + STEPS * DT * 2.0 * (1.0 - 0.3 * np.sign(rate)) / bricks.MASS)


@pytest.mark.parametrize("dof", [0, 1, 2])
def test_moves_decay_by_the_same_numbers(dof):
    body = bricks.brick(DT)
    body.v[0, dof] = 0.2
    bricks.fly(body, DT, STEPS, Guided(H, 0.0))
    assert body.v[0, dof] == pytest.approx(0.2 * ((1.0 - H) / (1.0 + H)) ** STEPS, rel=1e-12)

"""A rigid brick in free flight, and one that hits a plane with a corner: closed forms of Euler's equations."""

import numpy as np
import pytest

from masonry.kinematics import turning
from masonry.kinematics.dispatch import move, update_positions
from masonry.model.body_arrays import in_rows
from tests.kinematics import bricks

RATES = np.array([0.1, 10.0, 0.1])
PERIOD = 4.67394379
AFTER_2_S = np.array([0.73406383, -9.95913163, -0.76760219])


def rates_after(time: float, steps: int) -> np.ndarray:
    """Angular velocity along the brick's axes; turned at first, which must not matter."""
    dt = time / steps
    body = bricks.brick(dt)
    body.frame[0] = start = bricks.turn(0, 0.7) @ bricks.turn(2, -2.0)
    body.v[0, 3:] = start @ RATES
    turning.spin(body)
    bricks.fly(body, dt, steps)
    return body.frame[0].T @ body.v[0, 3:]


@pytest.mark.parametrize(("time", "rates", "order", "rest"), [(2.0, AFTER_2_S, 2, 2e-7), (PERIOD, RATES, 3, 1e-6)])
def test_rates_follow_eulers_equations_with_order_two(time, rates, order, rest):
    """Over a whole period in the brick's axes the errors of second order cancel, and those of third order are left."""
    coarse, middle, fine = (rates_after(time, round(time * n)) for n in (2000, 4000, 8000))
    errors = [np.abs(rate - rates).max() for rate in (coarse, middle, fine)]
    assert np.log2(errors[0] / errors[1]) == pytest.approx(order, abs=0.1)
    assert np.log2(errors[1] / errors[2]) == pytest.approx(order, abs=0.1)
    assert fine + (fine - middle) / (2**order - 1) == pytest.approx(rates, abs=rest)


def test_momentum_is_kept_to_the_bit_and_energy_drifts_by_2e_5_in_100_s():
    dt = 1e-3
    body = bricks.brick(dt)
    body.v[0, 3:] = RATES
    turning.spin(body)
    momentum, energy = body.momentum.copy(), 0.5 * body.v[0, 3:] @ body.momentum[0]
    assert np.linalg.norm(momentum) == pytest.approx(0.168923949, abs=1e-9)
    drift = []
    for _ in range(1000):
        bricks.fly(body, dt, 100)
        drift.append(0.5 * body.v[0, 3:] @ body.momentum[0] / energy - 1.0)
    assert np.array_equal(body.momentum, momentum)
    assert np.abs(drift).max() == pytest.approx(1.8e-5, rel=0.05)
    assert body.work[0, 3] == pytest.approx(-drift[-1] * energy, rel=1e-6)
    assert body.frame[0] @ body.frame[0].T == pytest.approx(np.eye(3), abs=2e-15)


def test_a_corner_hits_a_plane():
    """J = 2 v_n / (1/m + n [I^-1 (r x n) x r]), then the rates of the issue's brick; 1 m/s, no friction, no loss."""
    stiffness, dt, half = 1e10, 1e-7, np.array([0.24, 0.115, 0.06]) / 2
    start = bricks.turn(2, np.radians(30)) @ bricks.turn(1, np.radians(35)) @ bricks.turn(0, np.radians(20))
    signs = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    corner = min(signs * half, key=lambda arm: (start @ arm)[2])
    body = bricks.brick(dt, [corner])
    body.frame[0], body.v[0, 2] = start, -1.0
    u, force, floor = in_rows(np.zeros((1, 3))), in_rows(np.zeros((1, 3))), (start @ corner)[2] - corner[2]
    impulse, before = 0.0, turning.momenta(body)
    for _ in range(600):
        update_positions(None, body, dt, u)
        force[0, 2] = stiffness * max(floor - u[0, 2], 0.0)
        impulse += dt * force[0, 2]
        before = turning.momenta(body)
        move(None, body, dt, None, bricks.ALL_OF_IT, force, u)
    assert force[0, 2] == 0.0
    assert impulse == pytest.approx(2.189934, rel=1e-3)
    assert body.v[0, :3] == pytest.approx([0.0, 0.0, -0.33878798], abs=1e-3)
    assert body.v[0, 3:] == pytest.approx([-9.02687, -15.81370, 7.02372], rel=1e-3)
    kinetic = bricks.kinetic_of_a_brick(body, before)
    assert kinetic == pytest.approx(0.5 * bricks.MASS, rel=1e-4)
    assert kinetic + body.work[0, 3] - body.work[0, 0] == pytest.approx(0.5 * bricks.MASS, rel=1e-13)

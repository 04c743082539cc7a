"""Rigid bricks side by side, of which eight are computed at a time: each moves as it does alone."""

import numpy as np
import pytest

from masonry.kinematics import turning
from masonry.kinematics.dispatch import move, update_positions
from masonry.kinematics.motion import Guided
from masonry.kinematics.turning import Turning
from masonry.model.body_arrays import in_rows
from tests.kinematics import bricks

COUNT, DT, STEPS = 21, 1e-3, 300
HELD = {2: (3, 4, 5), 4: (5,), 9: (0, 1, 2, 3, 4, 5), 17: (3, 5), 19: (4,)}
"""Which movements of which bricks are held; in the first eight, in the next, and in the five that are left."""
FAST = 6, 12, 20
"""Bricks that turn by more than 0.1 rad in a step."""


def many(sides: tuple[int, ...]) -> Turning:
    """Bricks that fly, turned and loaded at random; those named in `sides` have one contact each."""
    rng = np.random.default_rng(7)
    alone = [bricks.brick(DT, [(0.1, 0.05, -0.03)] * (b in sides)) for b in range(COUNT)]
    body = alone[0]._replace(
        **{name: in_rows(np.zeros((COUNT, 6))) for name in ("q", "v", "contact", "hold", "patches")},
        dt_over_mass=in_rows(np.concatenate([one.dt_over_mass for one in alone])),
        frame=np.array([bricks.turn(0, x) @ bricks.turn(2, z) for x, z in rng.uniform(-3, 3, (COUNT, 2))]),
        momentum=np.zeros((COUNT, 3)),
        inertia=bricks.INERTIA * rng.uniform(0.5, 2.0, (COUNT, 1)),
        start=np.concatenate([[0], np.cumsum([b in sides for b in range(COUNT)])]).astype(np.uint32),
        code=2 * np.arange(len(sides), dtype=np.uint32),
        arm=np.concatenate([one.arm for one in alone]),
        work=np.zeros((COUNT, 4)),
        load=in_rows(rng.normal(scale=0.1, size=(COUNT, 6))),
        guess=in_rows(rng.normal(size=(COUNT, 6))),
        axes=np.array([bricks.turn(1, angle) for angle in rng.uniform(-1, 1, COUNT)]),
    )
    body.patches[...] = rng.normal(scale=0.05, size=(COUNT, 6))
    body.v[...] = rng.normal(size=(COUNT, 6))
    body.v[FAST, 3:] *= 200.0 / np.linalg.norm(body.v[FAST, 3:], axis=1, keepdims=True)
    for b, dofs in HELD.items():
        body.dt_over_mass[b, dofs] = 0.0
    turning.spin(body)
    return body


def one_of(body: Turning, b: int) -> Turning:
    """A copy of brick b, alone."""
    first, last = body.start[b : b + 2]
    rows = {name: in_rows(getattr(body, name)[b : b + 1]) for name in ("q", "v", "dt_over_mass", "contact", "hold")}
    rows |= {name: in_rows(getattr(body, name)[b : b + 1]) for name in ("patches", "load", "guess")}
    rows |= {name: getattr(body, name)[b : b + 1].copy() for name in ("frame", "momentum", "inertia", "work", "axes")}
    sides = {"code": body.code[first:last].copy(), "arm": body.arm[first:last].copy()}
    return body._replace(**rows, **sides, start=np.array([0, last - first], dtype=np.uint32))


def fly(body: Turning, force: np.ndarray, damping) -> np.ndarray:
    """Steps with contact forces that stay; returns the displacements of the contact points."""
    u = in_rows(np.zeros((max(len(body.code), 1), 3)))
    for _ in range(STEPS):
        update_positions(None, body, DT, u)
        move(None, body, DT, damping, (1.0, 1.0, 0.4, 0.3), force, u)
    return u


@pytest.mark.parametrize("damping", [None, pytest.param(0.3, marks=pytest.mark.slow), Guided(0.02, 0.1)])
@pytest.mark.parametrize("sides", [(), (1, 11, 18)])
def test_a_brick_among_others_moves_as_it_does_alone(sides, damping):
    body, force = many(sides), in_rows(np.random.default_rng(3).normal(scale=0.1, size=(len(HELD), 3)))
    alone = [one_of(body, b) for b in range(COUNT)]
    u = fly(body, force, damping)
    for b, one in enumerate(alone):
        assert one.frame[0] @ one.frame[0].T == pytest.approx(np.eye(3), abs=3e-15)
        own = fly(one, force, damping)
        for name in ("q", "v", "frame", "momentum", "contact", "hold", "work"):
            among, wanted = getattr(body, name)[b], getattr(one, name)[0]
            assert among == pytest.approx(wanted, rel=1e-10, abs=1e-10 * np.abs(wanted).max()), (b, name)
        if b in sides:
            assert u[sides.index(b)] == pytest.approx(own[0], rel=1e-10)


def test_bricks_that_nothing_pushes_keep_their_momentum_to_the_bit():
    body = many(())._replace(load=None, guess=None, patches=None)
    momentum, free = body.momentum.copy(), (body.dt_over_mass > 0).all(axis=1)
    fly(body, in_rows(np.zeros((1, 3))), None)
    assert np.array_equal(body.momentum[free], momentum[free])
    assert np.abs(body.q[free, 3:]).max() > 1.0

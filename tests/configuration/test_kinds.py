"""What the dofs of a kind mean is one thing, whatever asks for it: motion, forces, gauges and the bound on the step."""

import numpy as np
import pytest

from masonry.configuration.parts.parts import PART
from masonry.kinematics.motion import Guided
from masonry.model.damping import damping_in_steps, damping_words, local_damping
from masonry.model.kinds import KIND
from masonry.model.layout import KINDS

RNG = np.random.default_rng(5)
AXES = np.linalg.qr(RNG.normal(size=(3, 3)))[0]
ARM, FORCE, SPIN = RNG.normal(size=(3, 3))


def test_kinds_stand_in_the_order_of_the_layout():
    assert tuple(KIND) == KINDS and len(PART) == 2 * len(KINDS)


@pytest.mark.parametrize("name", ["rigid", "affine"])
def test_a_force_at_an_arm_has_the_power_and_the_moment_of_a_rigid_motion(name):
    kind = KIND[name]
    acts, rates = kind.moment(AXES, ARM, FORCE), kind.spin(AXES[None], SPIN)[0]
    assert acts @ rates == pytest.approx(FORCE @ np.cross(SPIN, ARM))
    assert kind.moments(AXES[None], acts[None])[0] == pytest.approx(np.cross(ARM, FORCE))


@pytest.mark.parametrize("name", ["rigid", "affine"])
def test_gauges_and_the_bound_see_the_motion_that_the_dofs_make(name):
    """Gauges weigh dofs as they are, the bound those over their lengths, along the axes of the block."""
    kind, length = KIND[name], np.array([[0.3, 0.5, 0.7]])
    rates, moves = kind.spin(AXES[None], SPIN)[0], np.cross(SPIN, ARM)
    for axis in range(3):
        first, weight = kind.gauge(AXES[None], ARM[None], axis)
        assert weight[0] @ rates[first - 3 : first] == pytest.approx(moves[axis])
    columns = kind.columns((ARM @ AXES)[None], AXES[None], length)[0]
    assert columns @ (rates * kind.lengths(length)[0]) == pytest.approx(moves)


@pytest.mark.parametrize(
    ("damping", "share", "words"),
    [
        (None, 0.0, "no damping"),
        (0.0, 0.0, "no damping"),
        (0.8, 0.8, "local damping 0.8"),
        (Guided(0.05, 0.1), 0.1, "viscous damping of the unexpected motion, local damping 0.1"),
    ],
)
def test_a_damping_says_what_it_is_and_by_how_much_dofs_answer_with_more_than_their_force(damping, share, words):
    assert local_damping(damping) == share and damping_words(damping) == words
    assert damping_in_steps(damping, 1e-3) == (damping or None)

"""Factors of safety on friction and cohesion, by hand."""

from dataclasses import replace

import numpy as np
import pytest

from masonry.errors import SceneError
from masonry.statics.problem import RigidBodies, RigidContacts
from masonry.statics.safety import factor_of_safety
from tests.limit.blocks import CONES, PLANE, dry, stack


def on_an_incline(slope: float, friction: float, cohesion: float = 0.0) -> tuple[RigidBodies, RigidContacts]:
    """A flat block on ground that is tilted by an angle (rad), by its loads."""
    bodies, contacts = dry(stack([(2.0, 0.2)]), [0], friction, dead=(np.sin(slope), 0.0, -np.cos(slope)))
    return bodies, replace(contacts, cohesion=cohesion * contacts.area)


@pytest.mark.parametrize("method", [PLANE, CONES], ids=["plane", "cones"])
@pytest.mark.parametrize("cohesion", [0.0, 0.02])
@pytest.mark.parametrize("degrees", [10.0, 25.0, 35.0])
def test_a_block_on_an_incline_has_the_factor_of_safety_of_the_formula(method, cohesion, degrees):
    """tan(phi)/tan(psi) + c A/(W sin(psi)), below 1 for what slides."""
    slope, friction, area = np.radians(degrees), 0.6, 2.0 * 0.3
    by_hand = friction / np.tan(slope) + cohesion * area / (2.0 * 0.2 * 0.3 * np.sin(slope))
    factor, at_it, _ = factor_of_safety(*on_an_incline(slope, friction, cohesion), method)
    assert factor == pytest.approx(by_hand, rel=1e-5)
    assert at_it.factor >= 1.0 - 1e-7, "the forces that are handed back balance all of the loads"


def test_a_block_on_an_incline_is_as_safe_without_dilation():
    factor, _, _ = factor_of_safety(*on_an_incline(np.radians(25.0), 0.6, 0.02), dilation=False)
    with_it, _, _ = factor_of_safety(*on_an_incline(np.radians(25.0), 0.6, 0.02))
    assert factor == pytest.approx(with_it, rel=2e-4)


def test_what_needs_no_friction_and_what_no_friction_holds_is_said():
    with pytest.raises(SceneError, match="stands without any friction"):
        factor_of_safety(*dry(stack([(1.0, 0.2)]), [0], 0.5))
    with pytest.raises(SceneError, match="no amount of friction and cohesion makes it stand"):
        factor_of_safety(*dry(stack([(0.2, 2.0)]), [0], 0.5, dead=(0.5, 0.0, -1.0)))

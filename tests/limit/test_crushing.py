"""Joints of limited compressive strength: the plastic stress block by hand, and a bound that strength only lifts."""

from dataclasses import replace

import numpy as np
import pytest

from geometry.blocks import Blocks
from geometry.joints.find import find_joints
from geometry.polyhedra.construct import extrude
from geometry.structures.arch import arch
from masonry.statics.crushing import crushing_of
from masonry.statics.problem import RigidContacts
from masonry.statics.solve import largest_factor
from tests.limit.blocks import CONES, PLANE, dry, stack


def crushed(blocks: Blocks, contacts: RigidContacts, strength: float) -> RigidContacts:
    joints = find_joints(blocks, "vertex", 2)
    return replace(contacts, crush=crushing_of(joints, strength, np.ones(len(joints.area), dtype=bool)))


@pytest.mark.parametrize("method", [PLANE, CONES], ids=["plane", "cones"])
@pytest.mark.parametrize("strength", [2.0, 5.0, 1e3])
def test_a_pier_turns_about_its_stress_block(method, strength):
    """W h/2 times the factor is N b/2 (1 - N/(fc A)) with N = W."""
    blocks = stack([(0.5, 1.0)])
    bodies, contacts = dry(blocks, [0], 5.0)
    weight, area = 0.5 * 1.0 * 0.3, 0.5 * 0.3
    by_hand = weight * 0.25 * (1 - weight / (strength * area)) / (0.5 * weight)
    assert largest_factor(bodies, crushed(blocks, contacts, strength), method).factor == pytest.approx(
        by_hand, rel=1e-6
    )


def test_bending_about_two_axes_bears_what_a_smaller_rectangle_bears():
    """Pushed alike along x and y, N = fc A (1 - 2 k h/(2 b))(1 - 2 k h/(2 d)) for a height h, base b x d."""
    blocks = stack([(0.5, 1.0)])
    bodies, contacts = dry(blocks, [0], 5.0, live=(1.0, 1.0, 0.0))
    weight, area, strength = 0.15, 0.15, 2.0
    factor = largest_factor(bodies, crushed(blocks, contacts, strength)).factor
    left = strength * area * (1 - factor / 0.5) * (1 - factor / 0.3)
    assert left == pytest.approx(weight, rel=1e-6)


def test_the_factor_of_an_arch_rises_with_strength_to_that_of_strong_stone():
    blocks = arch(1.0, np.radians(157.5), 7, 0.15, 0.3).blocks
    bodies, contacts = dry(blocks, [7, 8], 0.7)
    factors = [
        largest_factor(bodies, crushed(blocks, contacts, strength)).factor for strength in (3.0, 10.0, 100.0, 1e3)
    ]
    strong = largest_factor(bodies, contacts).factor
    assert factors == sorted(factors) and factors[0] < 0.5 * strong and 0.99 * strong < factors[-1] < strong


def test_a_triangle_pressed_in_its_middle_bears_its_whole_area_and_less_off_it():
    """Two prisms behind each other along y; the force at a share s of the way to a corner, or to the middle of an edge,
    bears fc A (1 - s)^2."""
    loop = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    blocks = extrude([loop, loop], np.array([-1.0, 0.0]), np.array([0.0, 1.0]), np.arange(2), ("units",))
    bodies, contacts = dry(blocks, [0], 0.5, dead=(0.0, 0.0, 0.0), live=(0.0, -1.0, 0.0))
    strength, area = 3.0, 0.5
    limited = crushed(blocks, contacts, strength)
    assert largest_factor(bodies, limited).factor * 0.5 == pytest.approx(strength * area, rel=1e-6)
    for share, end in ((0.2, (1.0, 0.0)), (0.6, (1.0, 0.0)), (0.5, (0.5, 0.0)), (0.3, (0.5, 0.5))):
        arm = share * (np.array([end[0], 0.0, end[1]]) - bodies.centre[1] * (1.0, 0.0, 1.0))
        live = bodies.live.copy()
        live[1, 3:] = np.cross(arm, live[1, :3])
        solution = largest_factor(replace(bodies, live=live), limited)
        assert solution.factor * 0.5 == pytest.approx(strength * area * (1 - share) ** 2, rel=1e-6)

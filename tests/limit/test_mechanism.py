"""Mechanism and forces of a limit analysis: a proof of the factor from both sides; problems turned and scaled."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from geometry.structures.arch import arch
from masonry.statics.problem import RigidBodies, RigidContacts, Solution
from masonry.statics.solve import largest_factor, standing
from tests.limit.blocks import CONES, PLANE, PYRAMIDS, dry, turned, wall

PROBLEMS = {
    "arch": lambda: dry(arch(1.0, np.radians(157.5), 7, 0.15, 0.3).blocks, [7, 8], 0.7),
    "wall": lambda: dry(wall(6, halves_below=True), [0], 0.65),
    "skew push": lambda: dry(wall(4, halves_below=True, units=3), [0], 0.4, live=(0.7, 0.5, 0.0)),
}
EVERY = pytest.mark.parametrize("problem", PROBLEMS.values(), ids=PROBLEMS.keys())


def jumps(bodies: RigidBodies, contacts: RigidContacts, velocity: np.ndarray) -> np.ndarray:
    """(C, 3) velocity of block b past block a at each contact point."""

    def at(block: np.ndarray) -> np.ndarray:
        arm = contacts.point - bodies.centre[block]
        return velocity[block, :3] + np.cross(velocity[block, 3:], arm)

    return at(contacts.block_b) - at(contacts.block_a)


def resultants(bodies: RigidBodies, contacts: RigidContacts, solution: Solution) -> np.ndarray:
    """(B, 6) all forces and moments on each block, loads included."""
    force = solution.normal[:, None] * contacts.normal + solution.shear
    total = bodies.dead + solution.factor * bodies.live
    for block, sign in ((contacts.block_a, -1.0), (contacts.block_b, 1.0)):
        moment = np.cross(contacts.point - bodies.centre[block], force)
        np.add.at(total, block, sign * np.concatenate([force, moment], axis=1))
    return total


@EVERY
@pytest.mark.parametrize("method", [PLANE, CONES, PYRAMIDS], ids=["plane", "cones", "pyramids"])
def test_the_forces_balance_every_block_within_what_the_contacts_bear(problem, method):
    bodies, contacts = problem()
    solution = largest_factor(bodies, contacts, method)
    weight = np.abs(bodies.dead).max()
    assert np.abs(resultants(bodies, contacts, solution)[bodies.free]).max() < 1e-7 * weight
    assert solution.normal.min() > -1e-7 * weight
    assert (np.linalg.norm(solution.shear, axis=1) <= contacts.friction * solution.normal + 1e-6 * weight).all()
    assert np.abs(np.einsum("ci,ci->c", solution.shear, contacts.normal)).max() < 1e-12 * weight


@EVERY
@pytest.mark.parametrize("method", [PLANE, CONES], ids=["plane", "cones"])
def test_the_mechanism_proves_the_factor_from_above(problem, method):
    """Nothing goes into anything, what slides rises by the friction angle, held blocks stand still, and the factor is
    the work against the dead load over that of the live load."""
    bodies, contacts = problem()
    solution = largest_factor(bodies, contacts, method)
    assert not solution.velocity[~bodies.free].any()
    jump = jumps(bodies, contacts, solution.velocity)
    opening = np.einsum("ci,ci->c", jump, contacts.normal)
    slip = np.linalg.norm(jump - opening[:, None] * contacts.normal, axis=1)
    assert (opening >= contacts.friction * slip - 1e-6 * np.abs(jump).max()).all()
    assert (bodies.live * solution.velocity).sum() == pytest.approx(1.0, rel=1e-6)
    assert -(bodies.dead * solution.velocity).sum() == pytest.approx(solution.factor, rel=1e-6)
    assert solution.gap < 1e-6


@EVERY
def test_a_turned_problem_has_the_same_factor(problem):
    bodies, contacts = problem()
    straight = largest_factor(bodies, contacts).factor
    for seed in range(2):
        way = Rotation.random(random_state=seed).as_matrix()
        assert largest_factor(*turned(bodies, contacts, way)).factor == pytest.approx(straight, rel=1e-6)


@EVERY
def test_lengths_and_weights_in_other_units_change_nothing(problem):
    bodies, contacts = problem()
    straight = largest_factor(bodies, contacts).factor
    for length, force in ((1e-3, 1.0), (1.0, 1e6), (1e3, 1e-4)):
        units = np.repeat([force, force * length], 3)
        same = replace(bodies, centre=bodies.centre * length, dead=bodies.dead * units, live=bodies.live * units)
        points = replace(contacts, point=contacts.point * length, area=contacts.area * length**2)
        assert largest_factor(same, points).factor == pytest.approx(straight, rel=1e-7)


def test_a_live_load_in_other_units_divides_the_factor():
    bodies, contacts = PROBLEMS["wall"]()
    straight = largest_factor(bodies, contacts).factor
    for method in (PLANE, CONES):
        solution = largest_factor(replace(bodies, live=1e-5 * bodies.live), contacts, method)
        assert solution.factor == pytest.approx(1e5 * straight, rel=1e-6)


def test_more_points_on_a_dry_joint_change_nothing():
    blocks = wall(6, halves_below=True)
    few, many = (largest_factor(*dry(blocks, [0], 0.65, points=n), method=PLANE).factor for n in (2, 5))
    assert many == pytest.approx(few, rel=1e-7)


def test_dead_loads_alone_say_how_much_of_them_stands_and_who_falls():
    bodies, contacts = PROBLEMS["wall"]()
    assert standing(bodies, contacts).factor == pytest.approx(1.0, abs=1e-9)
    tilted = replace(bodies, dead=bodies.dead + 0.7 * bodies.live)
    for method in (PLANE, CONES):
        solution = standing(tilted, contacts, method)
        assert solution.factor < 1e-6
        assert (tilted.dead * solution.velocity).sum() > 0.99, "the loads do work on what falls"

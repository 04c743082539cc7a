"""Parts of a limit analysis by hand: pyramids in cones, shear among the points of a joint, forces before any load."""

from dataclasses import replace
from itertools import pairwise
from types import SimpleNamespace

import numpy as np
import pytest
from scipy import sparse

import masonry
from masonry.limit_analysis.contact_strengths import contacts_of, sliding_fraction, touching
from masonry.statics.interior_point import Programme, true_gap
from masonry.statics.no_dilation import _LoadPath, without_dilation
from masonry.statics.problem import RigidBodies, RigidContacts, Solution
from masonry.statics.safety import factor_of_safety
from masonry.statics.solve import Method, largest_factor
from tests.limit.blocks import CONES, PLANE, dry, stack
from tests.limit.one_block import SIDEWAYS, STRONG, block
from tests.scenes import load


@pytest.mark.parametrize("sides", [4, 6])
@pytest.mark.parametrize("cohesion", [0.0, 0.1])
def test_pyramids_bear_what_the_cone_bears_at_their_edges_and_less_between_them(sides, cohesion):
    """One edge in so many lies along the push; half-way between two edges a side bears the cosine of half the angle."""
    strength = 0.4 + cohesion * 0.6 / (2.0 * 0.3)
    shares = []
    for degrees in np.arange(0.0, 360.0, 180.0 / sides):
        way = np.cos(np.radians(degrees)), np.sin(np.radians(degrees)), 0.0
        bodies, contacts = dry(stack([(2.0, 1.0)]), [0], 0.4, live=way)
        bodies.free[1] = np.arange(6) < 3
        strong = replace(contacts, cohesion=cohesion * contacts.area)
        shares.append(largest_factor(bodies, strong, Method(plane=False, sides=sides)).factor / strength)
    low, high = sorted(shares[:2])
    assert (low, high) == (pytest.approx(np.cos(np.pi / sides), rel=1e-7), pytest.approx(1.0, rel=1e-7))
    assert all(one != pytest.approx(other, rel=1e-3) for one, other in pairwise(shares)), "by turns round about"


@pytest.mark.parametrize("method", [PLANE, CONES], ids=["plane", "cones"])
def test_no_point_of_a_joint_bears_more_shear_than_its_own_friction_and_cohesion(method):
    """One edge of the base is glued, the other is dry."""
    bodies, contacts = dry(stack([(2.0, 1.0)]), [0], 0.4)
    glued = replace(contacts, cohesion=0.3 * contacts.area * (contacts.point[:, 0] > 1.0))
    solution = largest_factor(bodies, glued, method)
    shear, bears = np.linalg.norm(solution.shear, axis=1), glued.friction * solution.normal + glued.cohesion
    assert solution.factor == pytest.approx(0.4 + 0.3 * 0.5, rel=1e-7)
    assert shear == pytest.approx(bears, abs=1e-6)
    assert len({*np.round(shear, 3)}) > 1, "they do not bear alike"


def test_tension_is_that_of_each_point_where_points_stand_for_unlike_areas():
    """Two blocks of 0.5 and 1 m are lifted alike: each bears its weight and its strength times its own area."""
    bodies, contacts = dry(stack([(0.5, 1.0)]), [0], 0.7, live=(0.0, 0.0, 1.0), points=4)
    areas = np.unique(np.round(contacts.area, 9))
    assert len(areas) == 3
    for method in (PLANE, CONES):
        strong = replace(contacts, tension=0.2 * contacts.area, cohesion=contacts.area)
        assert largest_factor(bodies, strong, method).factor == pytest.approx(1.0 + 0.2 * 0.15 / 0.15, rel=1e-6)
    scene = load(block("", STRONG))
    specimen, joints = touching(scene)
    unlike = contacts_of(scene, specimen, replace(joints, area=joints.area * [1.0, 2.0, 3.0, 4.0]))
    for bears, strength in ((unlike.tension, 4e3), (unlike.cohesion, 100e3)):
        assert bears == pytest.approx(strength * joints.area * [1.0, 2.0, 3.0, 4.0], rel=1e-12)


def test_the_mechanism_of_a_factor_of_safety_is_that_of_what_falls_just_beyond_it():
    bodies, contacts = dry(stack([(2.0, 0.2)]), [0], 0.6, dead=(0.3, 0.0, -1.0))
    factor, _, mechanism = factor_of_safety(bodies, contacts)
    assert factor == pytest.approx(2.0, rel=1e-6)
    assert (bodies.dead * mechanism.velocity).sum() > 0.99, "the loads do work on it"
    assert mechanism.velocity[1, 0] > 0.0 and mechanism.normal.sum() == pytest.approx(2.0 * 0.2 * 0.3, rel=1e-6)


def at_rest(monkeypatch, bodies: RigidBodies, contacts: RigidContacts) -> Solution:
    """The forces under the dead loads alone, with which the way to a factor without dilation begins."""
    begin, begun = _LoadPath.at_rest, []

    def noted(path: _LoadPath) -> np.ndarray:
        begun.append((path, begin(path)))
        return begun[-1][1]

    monkeypatch.setattr(_LoadPath, "at_rest", noted)
    without_dilation(bodies, contacts, CONES)
    path, forces = begun[0]
    return path.end(forces, 1.0, 0).solution


@pytest.mark.parametrize("degrees", [20.0, 45.0])
def test_before_any_load_a_groove_shares_a_weight_as_springs_do(degrees, monkeypatch):
    """Two faces, up by an angle b on either side, hold W by N and T up the slope: 2 (N cos b + T sin b) = W, and
    N^2 / k_n + T^2 / k_s is least where T = N tan(b) k_s / k_n."""
    slope, weight = np.radians(degrees), 3.0
    normal = np.array([[np.sin(slope), 0.0, np.cos(slope)], [-np.sin(slope), 0.0, np.cos(slope)]])
    free, load = np.zeros((2, 6), dtype=bool), np.zeros((2, 6))
    free[1, :3], load[1, 2] = True, -weight
    bodies = RigidBodies(np.array([[0.0, 0.0, -1.0], [0.0, 0.0, 0.5]]), free, load, np.eye(2, 6, -1))
    one, none = np.ones(2), np.zeros(2)
    blocks = np.zeros(2, dtype=int), np.ones(2, dtype=int)
    point = np.array([[-0.3, 0.0, 0.2], [0.3, 0.0, 0.2]])
    contacts = RigidContacts(*blocks, point, normal, np.arange(2), one, 9.0 * one, none, none, none > 0.0)
    forces = at_rest(monkeypatch, bodies, contacts)
    pressing = weight * np.cos(slope) / (2.0 * (np.cos(slope) ** 2 + np.sin(slope) ** 2 / 2.5))
    assert forces.normal == pytest.approx([pressing, pressing], rel=1e-5)
    assert np.linalg.norm(forces.shear, axis=1) == pytest.approx([pressing * np.tan(slope) / 2.5] * 2, rel=1e-5)


def test_before_any_load_an_even_pressure_gives_each_point_its_share_of_the_area(monkeypatch):
    bodies, contacts = dry(stack([(0.5, 1.0)]), [0], 0.7, points=3)
    forces = at_rest(monkeypatch, bodies, contacts)
    assert forces.normal == pytest.approx(0.15 * contacts.area / contacts.area.sum(), rel=1e-4)


def test_what_turns_about_an_edge_does_not_slide_there_and_what_slides_does_half_of_the_work_by_shear():
    """A block that slides by v rises by mu v: W goes up by mu v, mu W pushes by v, and shear takes mu W v."""
    for friction, fraction in ((5.0, 0.0), (0.3, 0.5)):
        bodies, contacts = dry(stack([(0.5, 1.0)]), [0], friction)
        solution = largest_factor(bodies, contacts, CONES)
        assert sliding_fraction(bodies, contacts, solution) == pytest.approx(fraction, abs=1e-5)


def test_the_edge_about_which_a_block_topples_stands_still():
    result = masonry.limit(load(block("")).with_(SIDEWAYS))
    edge = np.array([[0.5, 0.0, 0.0], [0.5, 0.3, 0.0], [0.0, 0.0, 1.0]])
    speed = result.velocity_at(np.ones(3, dtype=int), edge) / np.abs(result.velocity[1]).max()
    assert speed[:2] == pytest.approx(np.zeros((2, 3)), abs=1e-6)
    assert speed[2, 0] == pytest.approx(2.0 * speed[2, 2], rel=1e-6) and speed[2, 2] > 0.0, "it turns about that edge"


@pytest.mark.parametrize(("angle", "expected"), [("30 deg", 6 / 9.5), ("-30 deg", 4 / 10.5)])
def test_a_scene_that_tilts_gravity_is_tilted_the_way_it_says(angle, expected):
    """As `a tilt turns gravity the way its axis says`: a negative angle is a tilt about the axis reversed."""
    tilt = f'[gravity]\nx = "1 m/s^2"\ntilt = {{about = "y", angle = "{angle}", steps = 100}}\n'
    scene = load(block("").replace("[gravity]\n", tilt))
    assert masonry.limit(scene).factor == pytest.approx(expected, rel=1e-8)


@pytest.mark.parametrize("scale", [1.0, 10.0])
def test_the_gap_counts_what_forces_and_velocities_are_off_by(scale):
    """Objectives 0.2 apart; forces off by 0.1 where the velocity is 2; velocities off by 0.3 where the force is 5."""
    matrix, square = sparse.csc_matrix([[2.0]]), sparse.csc_matrix([[0.5]])
    x, z, s = 5.0, 2.0, 0.7
    programme = Programme(square, np.array([0.3 - 2.0 * z - 0.5 * x]), matrix, np.array([2.0 * x + s - 0.1]), [])
    solution = SimpleNamespace(x=[x], z=[z], s=[s], obj_val=-scale, obj_val_dual=-scale + 0.2)
    assert true_gap(programme, solution) == pytest.approx((0.2 + 2.0 * 0.1 + 5.0 * 0.3) / scale)

"""Estimates of horizontal bending by hand, and what is measured of a crack in it."""

from dataclasses import astuple
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from masonry import scene
from masonry.pictures.camera import back_view, front_view
from tests.results.sample import DEPTH, HEIGHT
from tests.verification.paper.test_crack_paths import parted
from verification.paper.bending.by_hand import BentWall, edge_moment, wall_of
from verification.paper.bending.crack import CRACKED, flexural_crack
from verification.paper.bending.runs import ASSUMED, RATIOS, SCENES, STRENGTHS, WEAKER, strengths
from verification.paper.bending.strength_map import even
from verification.paper.experiment import Run
from verification.paper.experiments import bending

WALL = BentWall(0.5e6, 1.5e6, 0.75e6, 0.12, 0.114, 0.45, 6)


def test_a_crack_goes_through_or_round_the_unit_in_every_other_course():
    """Round the lowest unit it turns one bed joint, round each other one two."""
    assert WALL.paths() == {(3, 0), (2, 1), (2, 2), (1, 3), (1, 4), (0, 5)}


def test_the_straight_crack_is_the_elastic_and_the_plastic_moment_of_its_mean_strength():
    assert WALL.brittle((3, 0)) == pytest.approx(1e6)
    assert WALL.plastic((3, 0)) == pytest.approx(3e6)


def test_the_moment_of_a_bed_joint_about_the_pressed_edge_is_the_integral_over_its_area():
    n = 400
    x = (np.arange(n) + 0.5) / n
    distance = np.hypot(0.12 * (x[:, None] - 0.5), 0.114 * x)
    assert edge_moment(0.12, 0.114) == pytest.approx(distance.mean() * 0.12 * 0.114, rel=1e-5)


def test_without_strength_in_tension_only_bed_joints_carry():
    """Torsion of a rectangle, stress growing with the distance from its middle: tau J / r."""
    wall = BentWall(0.0, 0.0, 1e6, 0.1, 0.1, 0.6, 6)
    torsion = 1e6 * (0.1**4 / 6) / (0.1 / np.sqrt(2))
    assert wall.brittle((0, 5)) == pytest.approx(5 * torsion / (0.6 * 0.1**2 / 6))
    assert wall.bounds() == (0.0, 0.0)


def test_the_wall_of_a_scene_has_friction_under_its_pressure():
    free, pressed = (wall_of(scene.load(name, strengths(*WEAKER))) for name in SCENES.values())
    assert astuple(free) == pytest.approx(astuple(WALL))
    assert pressed.shear - free.shear == pytest.approx(0.25e6)


@pytest.mark.parametrize("way", ["brittle", "plastic"])
def test_on_the_line_of_the_map_both_cracks_carry_the_same(way):
    units = even(WALL, 0.4e6, way)
    wall = BentWall(0.4e6, units, 0.6e6, 0.12, 0.114, 0.45, 6)
    assert getattr(wall, way)((3, 0)) == pytest.approx(getattr(wall, way)((0, 5)))


def test_the_map_holds_the_shipped_strengths_and_units_up_to_ten_times_as_strong_as_joints():
    assert {ASSUMED, WEAKER} <= set(STRENGTHS) and max(RATIOS) == 10
    assert {round(units / joints, 9) for joints, units in STRENGTHS} == set(RATIOS)
    loaded = scene.load("bending-0", strengths(*ASSUMED))
    assert loaded.contact == scene.load("bending-0").contact


def wall_of_the_sample() -> Any:
    return SimpleNamespace(unit_height=0.9 * HEIGHT, joint_thickness=0.1 * HEIGHT, courses=4, thickness=DEPTH)


def test_a_crack_round_all_units_is_stepped():
    crack = flexural_crack(parted(), wall_of_the_sample())
    assert (crack.word, crack.through, crack.unit_fraction) == ("stepped", 0, 0.0)


def test_a_crack_through_units_in_every_other_course_is_straight_and_in_fewer_mixed():
    made = parted()
    within = made.joint_group == 2
    low = made.joints.point[:, 2] < HEIGHT
    for broken, word, through in ((within, "straight", 4), (within & low, "mixed", 1)):
        damage = np.where(broken, 1.0, 0.0)
        crack = flexural_crack(parted(damage_tension=damage, damage_shear=0.0 * damage), wall_of_the_sample())
        assert (crack.word, crack.through) == (word, through)
        assert np.sum(crack.courses > CRACKED) == through


def test_from_behind_right_is_left_and_the_viewer_stands_opposite():
    points = np.array([[0.0, 0.0, 0.0], [2.0, 1.0, 3.0]])
    front, back = front_view(points), back_view(points)
    assert np.allclose(back.project(points), front.project(points) * (-1, 1))
    assert np.allclose(back.toward, -front.toward)


def test_only_walls_of_strong_units_are_said_to_give_way_at_once():
    sudden = [run for run in bending.runs(False).values() if run.sudden]
    strong = {"4 MPa", "4.5 MPa", "5 MPa"}
    assert {run.settings["contact.within_units.tensile_strength"] for run in sudden} == strong
    assert len(sudden) == 6 and not Run("couplet").sudden

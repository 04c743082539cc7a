"""Joints that bend: where the rows of their contact points decide the answer, a run says so, and by how much."""

import re
from pathlib import Path

import numpy as np
import pytest

import verification
from masonry.judgement.trust import trust
from masonry.laboratory import laboratory
from masonry.laboratory.remarks.joint_sections import envelope, of_points, spread, strength
from masonry.laws.brittle import Brittle
from masonry.laws.exponential import Exponential
from masonry.laws.state import JointProperties
from masonry.scene import load
from tests import scenes

TORN = Path(verification.__file__).parent / "scenes" / "joint-torn-from-one-side.toml"
BENT = {
    "drive.steps": None,
    "drive.accuracy": 0.02,
    "drive.displacement": "60 um",
    "specimen.box.1.size": ["0.3 m", "0.05 m", "0.05 m"],
}
MORTAR = """
[contact.{group}]
normal_stiffness = "80 GPa/m"
shear_stiffness = "35 GPa/m"
tensile_strength = "0.15 MPa"
cohesion = "0.22 MPa"
tan_friction_angle = 0.7
tan_residual_friction_angle = 0.6
fracture_energy_mode_1 = "{energy} N/m"
fracture_energy_mode_2 = "50 N/m"
"""
BLOCK = """
law = "exponential"
[specimen]
kind = "boxes"
section = "0.02 m^2"
box = [
  {name = "ground", origin = ["-0.1 m", "0 m", "-0.1 m"], size = ["0.4 m", "0.1 m", "0.1 m"], unit = 0},
  {name = "block", origin = ["0 m", "0 m", "0 m"], size = ["0.2 m", "0.1 m", "0.5 m"], unit = 1},
]
[material.units]
density = "2000 kg/m^3"
[[support]]
on = "ground"
fix = "all"
[[support]]
on = "block"
fix = ["y", "rotation x", "rotation z"]
[[traction]]
on = "block.z+"
stress = {z = "-1 kPa"}
[drive]
on = "block"
direction = "x"
displacement = "0.5 mm"
accuracy = "2 %"
"""
WALL = """
law = "exponential"
[specimen]
kind = "wall"
thickness = "0.25 m"
unit_length = "0.5 m"
unit_height = "0.25 m"
base = "0.2 m"
beam = "0.2 m"
{shape}
[material]
units = {{density = "2000 kg/m^3"}}
lintels = {{density = "2000 kg/m^3"}}
plates = {{density = "2000 kg/m^3"}}
[[support]]
on = "base"
fix = "all"
[[support]]
on = "beam"
fix = ["y", "rotation"]
[[traction]]
on = "beam.z+"
stress = {{z = "-{pressure} MPa"}}
[drive]
on = "beam"
direction = "x"
displacement = "1.5 mm"
accuracy = "2 %"
"""
DOOR = """length = "2 m"
height = "1.5 m"
opening = [{name = "door", left = "0.5 m", width = "1 m", height = "0.75 m"}]"""
FACADE = """length = "3 m"
height = "1.75 m"
opening = [
  {name = "window", left = "0.5 m", sill = "0.5 m", width = "0.5 m", height = "0.75 m"},
  {name = "door", left = "2 m", width = "0.5 m", height = "1.25 m"},
]"""
GROUPS = "unit_unit", "lintels_units", "plate"
EDGE, AREA = 0.2, 0.02
CORNERS = np.array([[0.0, 0.0, 0.0], [EDGE, 0.0, 0.0], [EDGE, AREA / EDGE, 0.0], [0.0, AREA / EDGE, 0.0]])
JOINT = JointProperties(80e9, 35e9, tensile_strength=0.2e6, cohesion=0.3e6, tan_friction=0.7)
GAUSS, VERTEX = 0.5 * EDGE / 3**0.5, 0.5 * EDGE


def torn(rows: int):
    """A joint that is pulled far beside its middle, with so many rows of points across."""
    return laboratory.run(load(TORN, {**BENT, "specimen.points_per_edge": {"x": rows, "y": 1}}))


def block(energy: float, rule: str, rows: int, **over: object):
    """A block that is pushed at its middle, so that its bed bends open."""
    points = {"specimen__contact_points": rule, "specimen__points_per_edge": {"x": rows, "y": 2}}
    return laboratory.run(scenes.load(BLOCK + MORTAR.format(group="unit_unit", energy=energy), **points, **over))


def wall(shape: str, pressure: float, rule: str, rows: int):
    """A mortared wall with openings below a beam that stays level."""
    text = WALL.format(shape=shape, pressure=pressure) + "".join(MORTAR.format(group=g, energy=10) for g in GROUPS)
    points = {"x": rows, "y": 2, "z": rows}
    return laboratory.run(scenes.load(text, specimen__contact_points=rule, specimen__points_per_edge=points))


def said(result) -> float:
    """The factor by which the peak is off, by the sentence of trust; 1 where it says nothing of that."""
    words = re.search(r"the peak may be about (\S+) (times|% too (high|low))", trust(result.summary))
    if words is None:
        return 1.0
    number = float(words[1])
    return number if words[2] == "times" else 1.0 + number / (100.0 if words[3] == "high" else -100.0)


def proposed(result) -> int:
    """The number of points that the sentence proposes."""
    words = re.search(r"take specimen.points_per_edge = (\d+)", trust(result.summary))
    assert words is not None
    return int(words[1])


def bears(arms: list[float], law, force: float = 0.0, moment: float = 0.0, farthest: float = 1.0) -> float:
    """N m, by points of equal areas."""
    return strength(of_points(np.array(arms), np.full(len(arms), AREA / len(arms))), law, force, moment, farthest)


@pytest.mark.parametrize(("arm", "times"), [(GAUSS, 3**0.5), (VERTEX, 3.0)])
def test_a_brittle_section_bears_its_elastic_moment_and_two_rows_of_points_what_their_arm_gives(arm, times):
    law = envelope(Brittle(), JOINT, 1e-3)
    many = spread(CORNERS, np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0]), np.array([0.5 * EDGE, 0.0, 0.0]))
    elastic = JOINT.tensile_strength * AREA * EDGE / 6.0
    assert strength(many, law, 0.0, 0.0, 1e-4) == pytest.approx(elastic, rel=0.05)
    assert bears([-arm, arm], law) == pytest.approx(times * elastic, rel=0.02)


def test_a_tough_section_and_one_that_is_pressed_turn_about_their_edge():
    tough, brittle = envelope(Exponential(1e5, 1e5), JOINT, 1e-2), envelope(Brittle(), JOINT, 1e-2)
    many = spread(CORNERS, np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0]), np.array([0.5 * EDGE, 0.0, 0.0]))
    edge, turn = 0.5 * EDGE * JOINT.tensile_strength * AREA, 0.05
    pressed = (2.0 * JOINT.tensile_strength * EDGE / (JOINT.normal_stiffness * turn)) ** 0.5 / EDGE
    exact = edge * (1.0 - pressed) * (1.0 + pressed / 3.0)
    assert strength(many, tough, 0.0, 0.0, turn) == pytest.approx(exact, rel=0.02)
    assert bears([-GAUSS, GAUSS], tough) == pytest.approx(edge / 3**0.5, rel=0.02)
    pressed = -20.0 * JOINT.tensile_strength * AREA
    assert strength(many, brittle, pressed, 0.0, 1.0) == pytest.approx(-pressed * 0.5 * EDGE, rel=0.07)
    assert bears([-VERTEX, VERTEX], brittle, pressed) == pytest.approx(-pressed * 0.5 * EDGE * 1.05, rel=0.02)


def test_a_section_that_is_pulled_bears_as_much_as_the_line_of_action_allows():
    law, force = envelope(Brittle(), JOINT, 1e-3), 10.0
    many = spread(CORNERS, np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0]), np.array([0.5 * EDGE, 0.0, 0.0]))
    arm = 0.25 * EDGE
    exact = JOINT.tensile_strength * AREA / (1.0 + 6.0 * arm / EDGE) * arm
    assert strength(many, law, force, arm * force, 1e-4) == pytest.approx(exact, rel=0.05)
    assert bears([-VERTEX, VERTEX], law, force, arm * force) == pytest.approx(
        JOINT.tensile_strength * AREA / (1.0 + 2.0 * arm / EDGE) * arm, rel=0.02
    )


def test_few_rows_of_points_change_the_answer_and_a_run_with_them_says_by_how_much():
    few, more, many = torn(2), torn(6), torn(12)
    peak = many.summary["peak_stress_pa"]
    assert (
        abs(few.summary["peak_stress_pa"] / peak - 1.0) > 0.1 > 0.05 > abs(more.summary["peak_stress_pa"] / peak - 1.0)
    )
    assert said(few) == pytest.approx(few.summary["peak_stress_pa"] / peak, rel=0.03)
    assert said(more) == pytest.approx(more.summary["peak_stress_pa"] / peak, rel=0.03)
    assert said(many) == 1.0


@pytest.mark.parametrize("energy", [1, 50])
def test_the_moment_of_a_bed_is_off_as_the_run_says_brittle_or_tough_inside_or_at_the_edge(energy):
    peak = block(energy, "gauss", 16).summary["peak_force_n"]
    for rule, rows in (("gauss", 2), ("vertex", 2), ("vertex", 4), ("vertex", 6)):
        result = block(energy, rule, rows)
        off = result.summary["peak_force_n"] / peak
        assert said(result) == pytest.approx(off, rel=0.05), (rule, rows)
        enough = block(energy, rule, proposed(result))
        assert said(enough) == 1.0 and enough.summary["peak_force_n"] == pytest.approx(peak, rel=0.03)


def test_a_wall_in_which_joints_bend_and_slide_says_to_which_side_its_peak_is_off():
    peak = wall(DOOR, 0.1, "gauss", 10).summary["peak_force_n"]
    for rule, rows in (("gauss", 2), ("vertex", 2), ("vertex", 4)):
        result = wall(DOOR, 0.1, rule, rows)
        off = result.summary["peak_force_n"] / peak
        assert abs(off - 1.0) > 0.05 and (said(result) - 1.0) * (off - 1.0) > 0.0, (rule, rows)
        assert said(result) == pytest.approx(off, rel=0.15), (rule, rows)
    enough = wall(DOOR, 0.1, "gauss", 8)
    assert said(enough) == 1.0 and enough.summary["peak_force_n"] == pytest.approx(peak, rel=0.02)


def test_a_facade_with_two_points_at_the_edges_of_its_joints_is_too_strong_and_says_so():
    few, enough = wall(FACADE, 0.3, "vertex", 2), wall(FACADE, 0.3, "gauss", 6)
    assert few.summary["peak_force_n"] > 1.05 * enough.summary["peak_force_n"]
    assert said(few) > 1.05 and said(enough) == 1.0


@pytest.mark.parametrize("rule", ["gauss", "vertex"])
def test_a_joint_that_only_slid_has_points_enough_whatever_their_number(rule):
    slid = block(10, rule, 2, support__1__fix=["y", "rotation"])
    assert slid.summary["damaged_area_m2"]["unit_unit"] > 0.0 and said(slid) == 1.0


@pytest.mark.parametrize("scene", ["couplet", "wallette-mode-1"])
def test_joints_that_are_pulled_as_a_whole_or_cells_that_crack_need_no_such_word(scene):
    changes = {} if scene == "couplet" else {"specimen.divisions": [4, 2], "drive.accuracy": 0.02}
    assert "rows of contact points" not in trust(laboratory.run(load(scene, changes)).summary)


def test_a_joint_that_is_pulled_open_evenly_and_shut_again_has_not_bent():
    pulled = {"drive.direction": "z", "drive.displacement": None, "drive.history": ["0.5 mm", "-0.01 mm"]}
    summary = laboratory.run(load("couplet", {**pulled, "confinement": "0 MPa", "drive.accuracy": "5 %"})).summary
    assert summary["broken_area_m2"]["unit_unit"] > 0.0 > summary["lowest_stress_pa"]
    assert "rows of contact points" not in trust(summary)

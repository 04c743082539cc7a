"""Joints that bend: where the rows of their contact points decide the answer, a run says so, and by how much."""

import re
from pathlib import Path

import numpy as np
import pytest

import verification
from geometry.joints.faces.strips import of_points, spread
from masonry.assembly.assemble import assemble
from masonry.errors import Stopped
from masonry.estimates.joint_faces import faces_of
from masonry.estimates.joint_loads import look_at
from masonry.estimates.strength.joint_sections import envelope, strength
from masonry.judgement.judgement import judgement_of
from masonry.judgement.sentence import trust
from masonry.laboratory import laboratory
from masonry.laws.brittle import Brittle
from masonry.laws.exponential import Exponential
from masonry.laws.state import JointProperties
from masonry.scene import load
from tests.scenes import box, listed, specimen, tables
from tests.scenes import load as scenes_load
from verification import scene_runs
from verification.studies import points_of_joints_that_bend as study
from verification.studies.mortared_walls import MortaredWall, proposed, said, walls

TORN = Path(verification.__file__).parent / "scenes" / "joint-torn-from-one-side.toml"
BENT = {
    "drive.steps": None,
    "drive.accuracy": 0.02,
    "drive.displacement": "60 um",
    "specimen.box.1.size": ["0.3 m", "0.05 m", "0.05 m"],
}
EDGE, AREA = 0.2, 0.02
CORNERS = np.array([[0.0, 0.0, 0.0], [EDGE, 0.0, 0.0], [EDGE, AREA / EDGE, 0.0], [0.0, AREA / EDGE, 0.0]])
JOINT = JointProperties(80e9, 35e9, tensile_strength=0.2e6, cohesion=0.3e6, tan_friction=0.7)
GAUSS, VERTEX = 0.5 * EDGE / 3**0.5, 0.5 * EDGE


def torn(rows: int):
    """A joint that is pulled far beside its middle, with so many rows of points across."""
    return laboratory.run(load(TORN, {**BENT, "specimen.points_per_edge": {"x": rows, "y": 1}}))


def peak_and_word(wall: MortaredWall, rule: str, rows: int) -> tuple[float, float, int]:
    """N, the factor by which the run says that this is off, and the points along edges that it proposes."""
    summary = laboratory.run(scene_runs.load(wall.scene, wall.with_points(rule, rows))).summary
    return summary["peak_force_n"], said(summary), proposed(summary)


def names(summary: dict) -> set[str]:
    """Of its doubts."""
    return {doubt.name for doubt in judgement_of(summary).doubts}


def bears(arms: list[float], law, force: float = 0.0, moment: float = 0.0, farthest: float = 1.0) -> float:
    """N m, by points of equal areas."""
    return strength(of_points(np.array(arms), np.full(len(arms), AREA / len(arms))), law, force, moment, farthest)


@pytest.mark.parametrize(("arm", "times"), [(GAUSS, 3**0.5), (VERTEX, 3.0)])
def test_a_brittle_section_bears_its_elastic_moment_and_two_rows_of_points_what_their_arm_gives(arm, times):
    law = envelope(Brittle(), JOINT, 1e-3)
    many = spread([CORNERS], np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0]), np.array([0.5 * EDGE, 0.0, 0.0]))
    elastic = JOINT.tensile_strength * AREA * EDGE / 6.0
    assert strength(many, law, 0.0, 0.0, 1e-4) == pytest.approx(elastic, rel=0.05)
    assert bears([-arm, arm], law) == pytest.approx(times * elastic, rel=0.02)


def test_a_section_of_more_fibres_than_turns_bears_what_one_of_few_does():
    law = envelope(Exponential(10.0, 30.0), JOINT, 1e-3)
    few, many = (bears(list(np.linspace(-0.5 * EDGE, 0.5 * EDGE, n)), law) for n in (40, 900))
    assert many == pytest.approx(few, rel=0.06)


def test_a_tough_section_and_one_that_is_pressed_turn_about_their_edge():
    tough, brittle = envelope(Exponential(1e5, 1e5), JOINT, 1e-2), envelope(Brittle(), JOINT, 1e-2)
    many = spread([CORNERS], np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0]), np.array([0.5 * EDGE, 0.0, 0.0]))
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
    many = spread([CORNERS], np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0]), np.array([0.5 * EDGE, 0.0, 0.0]))
    arm = 0.25 * EDGE
    exact = JOINT.tensile_strength * AREA / (1.0 + 6.0 * arm / EDGE) * arm
    assert strength(many, law, force, arm * force, 1e-4) == pytest.approx(exact, rel=0.05)
    assert bears([-VERTEX, VERTEX], law, force, arm * force) == pytest.approx(
        JOINT.tensile_strength * AREA / (1.0 + 2.0 * arm / EDGE) * arm, rel=0.02
    )


def test_the_work_of_the_joints_in_a_frame_is_that_of_the_drive():
    scene = load(TORN, {**BENT, "specimen.points_per_edge": {"x": 6, "y": 1}})
    assembly, history = assemble(scene), laboratory.run(scene).history
    faces, moved = faces_of(assembly), [frame for frame in history.frames if frame.displacement > 0.0]
    looks = [look_at(assembly, faces, frame) for frame in moved]
    force = [history.rows["force"][history.rows["step"] == frame.step][0] for frame in moved]
    done = [look.work.total for look in looks]
    assert done == pytest.approx([f * frame.displacement for f, frame in zip(force, moved, strict=True)], rel=0.01)
    assert all(0.0 <= look.inelastic.bending.sum() <= look.work.bending.sum() for look in looks)
    assert looks[-1].torn.all()


def test_few_rows_of_points_change_the_answer_and_a_run_with_them_says_by_how_much():
    few, more, many = (torn(rows).summary for rows in (2, 6, 12))
    peak = many["peak_stress_pa"]
    assert abs(few["peak_stress_pa"] / peak - 1.0) > 0.1 > 0.05 > abs(more["peak_stress_pa"] / peak - 1.0)
    assert said(few) == pytest.approx(few["peak_stress_pa"] / peak, rel=0.03)
    assert said(more) == pytest.approx(more["peak_stress_pa"] / peak, rel=0.03)
    assert said(many) == 1.0


@pytest.mark.parametrize("mortar", ["brittle", "tough"])
def test_the_moment_of_a_bed_is_off_as_the_run_says_with_points_inside_or_at_the_edge(mortar):
    bed = walls()[f"block, {mortar} mortar"]
    right = peak_and_word(bed, "gauss", 16)[0]
    for rule, rows in (("gauss", 2), ("vertex", 2), ("vertex", 4), ("vertex", 6)):
        peak, word, enough = peak_and_word(bed, rule, rows)
        assert word == pytest.approx(peak / right, rel=0.05) and enough <= 16, (rule, rows)
        peak, word, _ = peak_and_word(bed, rule, enough)
        assert word == 1.0 and peak == pytest.approx(right, rel=0.03), (rule, enough)


def test_a_wall_in_which_joints_bend_and_slide_says_to_which_side_its_peak_is_off():
    wall = walls()["wall with a door"]
    right = peak_and_word(wall, "gauss", 10)[0]
    for rule, rows in (("gauss", 2), ("vertex", 2)):
        peak, word, _ = peak_and_word(wall, rule, rows)
        assert abs(peak / right - 1.0) > 0.05 and (word - 1.0) * (peak - right) > 0.0, (rule, rows)
        assert word == pytest.approx(peak / right, rel=0.15), (rule, rows)
    peak, word, _ = peak_and_word(wall, "gauss", 8)
    assert word == 1.0 and peak == pytest.approx(right, rel=0.02)


@pytest.mark.parametrize(
    ("name", "points", "near"),
    [("slender pier", ("gauss", 2), 0.035), ("strip, pushed at its middle", ("vertex", 4), 0.045)],
)
def test_joints_that_do_not_bear_most_at_once_are_asked_together(name, points, near):
    """Joint by joint the pier would be 10 % too weak, and the strip 8 % too strong."""
    wall = walls()[name]
    (few, word, _), (right, silent, _) = (peak_and_word(wall, *these) for these in (points, ("gauss", 12)))
    assert word == pytest.approx(few / right, abs=near) and few > 1.01 * right and silent == 1.0


def test_a_facade_with_two_points_at_the_edges_of_its_joints_is_too_strong_and_says_so():
    facade = walls()["facade, 0.3 MPa"]
    (few, doubt, _), (right, silent, _) = (peak_and_word(facade, *points) for points in (("vertex", 2), ("gauss", 6)))
    assert few > 1.05 * right and doubt > 1.05 and silent == 1.0


def test_a_squat_wall_slides_but_joints_that_are_whole_bear_too_much_by_points_at_their_edges():
    squat = walls()["squat wall, 0.5 MPa"]
    points = ("gauss", 6), ("gauss", 2), ("vertex", 2)
    (right, silent, _), (inside, little, _), (edge, doubt, _) = (peak_and_word(squat, *these) for these in points)
    assert silent == 1.0 and little == pytest.approx(inside / right, abs=0.03)
    assert edge > 1.05 * right and doubt > 1.02


def test_a_load_that_grows_until_a_bed_gives_way_is_told_to_be_too_large():
    bed = walls()["block, brittle mortar"]
    grows = {"drive": None, "limit": {"pattern": "force", "on": "block", "force": {"x": "1 kN"}, "accuracy": "2 %"}}
    few, right = (
        laboratory.run(scene_runs.load(bed.scene, bed.with_points("vertex", rows) | grows)).summary for rows in (2, 12)
    )
    off = few["collapse_load"]["borne"] / right["collapse_load"]["borne"]
    assert "the load that is borne may be about" in trust(few) and said(few) == pytest.approx(off, rel=0.1)
    assert said(right) == 1.0


def test_joints_whose_strengths_scatter_are_held_against_their_own():
    strip, scatter = walls()["strip, pushed at its middle"], {"tensile_strength": 0.5, "cohesion": 0.5}
    drawn = {"scatter": {"seed": 4, "unit_unit": scatter}}
    few, right = (
        laboratory.run(scene_runs.load(strip.scene, strip.with_points(*points) | drawn)).summary
        for points in (("gauss", 2), ("gauss", 12))
    )
    assert said(few) == pytest.approx(few["peak_force_n"] / right["peak_force_n"], rel=0.06) and said(right) == 1.0


@pytest.mark.parametrize("rule", ["gauss", "vertex"])
def test_a_joint_that_only_slid_has_points_enough_whatever_their_number(rule):
    slides = MortaredWall("block-bent-at-its-bed", {"support.1.fix": ["y", "rotation"]})
    summary = laboratory.run(scene_runs.load(slides.scene, slides.with_points(rule, 2))).summary
    assert summary["damaged_area_m2"]["unit_unit"] > 0.0 and said(summary) == 1.0


@pytest.mark.parametrize("scene", ["couplet", "wallette-mode-1"])
def test_joints_that_are_pulled_as_a_whole_or_cells_that_crack_need_no_such_word(scene):
    changes = {} if scene == "couplet" else {"specimen.divisions": [4, 2], "drive.accuracy": 0.02}
    assert "few_points" not in names(laboratory.run(load(scene, changes)).summary)


def test_a_joint_that_is_pulled_open_evenly_and_shut_again_has_not_bent():
    pulled = {"drive.direction": "z", "drive.displacement": None, "drive.history": ["0.5 mm", "-0.01 mm"]}
    summary = laboratory.run(load("couplet", {**pulled, "confinement": "0 MPa", "drive.accuracy": "5 %"})).summary
    assert summary["broken_area_m2"]["unit_unit"] > 0.0 > summary["lowest_stress_pa"]
    assert "few_points" not in names(summary)


def test_a_bed_that_opens_without_much_damage_is_held_against_one_of_many_points():
    """A tough joint of little strength: pressure holds it, as far out as its points are."""
    weak = {"tensile_strength": "10 kPa", "fracture_energy_mode_1": "10 N/m"}
    over = {f"contact.unit_unit.{key}": value for key, value in weak.items()}
    over |= {"traction.0.stress": {"z": "-0.3 MPa"}, "drive.displacement": "0.1 mm"}
    few, many = (
        laboratory.run(scene_runs.load("block-bent-at-its-bed", over | {"specimen.points_per_edge": {"x": n, "y": 2}}))
        for n in (2, 30)
    )
    assert max(few.history.frames[-1].damage_tension) < 0.05
    off = few.summary["peak_force_n"] / many.summary["peak_force_n"]
    assert off < 0.8 and said(few.summary) == pytest.approx(off, abs=0.02)
    assert "few_points" not in names(many.summary)


def test_a_joint_whose_blocks_are_held_against_turning_does_not_bend():
    """Pulled open and pressed, in large displacement, where rounding turns it by next to nothing."""
    boxes = [box(f"b{k}", (0, 0, 0.05 * k), (0.1, 0.1, 0.05), "units", k) for k in range(2)]
    text = 'displacements = "large"\nlaw = "linear"\nkinematics = "rigid"\n' + specimen(boxes, 0.01)
    text += tables("material", {"units": 'density = "2000 kg/m^3"'})
    joint = 'normal_stiffness = "100 GPa/m"\nshear_stiffness = "40 GPa/m"\ntensile_strength = "0.2 MPa"\n'
    joint += 'cohesion = "0.3 MPa"\ntan_friction_angle = 0.75\nfracture_energy_mode_1 = "10 N/m"\n'
    text += tables("contact", {"default": joint + 'fracture_energy_mode_2 = "50 N/m"'})
    text += listed("support", ['on = "b0"\nfix = "all"', 'on = "b1"\nfix = ["x", "y", "rotation"]'])
    text += '[drive]\non = "b1"\ndirection = "-z"\nhistory = ["-0.5 mm", "0.05 mm"]\naccuracy = 0.01\n'
    assert "few_points" not in names(laboratory.run(scenes_load(text)).summary)


@pytest.mark.parametrize("name", ["wall with a door", "slender pier", "block, pressed", "strip, pushed at its middle"])
def test_joints_with_one_row_of_points_are_hinges_and_a_run_says_how_far_at_most_its_peak_is_too_low(
    name,
):
    wall = walls()[name]
    few, right = (
        laboratory.run(scene_runs.load(wall.scene, wall.with_points("gauss", rows))).summary for rows in (1, 8)
    )
    lacks = 1.0 - few["peak_force_n"] / right["peak_force_n"]
    (doubt,) = [doubt for doubt in judgement_of(few).doubts if doubt.name == "hinges"]
    words = re.search(r"one row .* the peak may be (far too low|too low by up to (\S+) %).*_per_edge = 4", doubt.line)
    assert (lacks > 0.99) if words[2] is None else (0.2 < lacks < 0.01 * float(words[2]) < 0.95)
    assert "hinges" not in names(right)


def test_a_run_that_ends_at_once_as_its_one_joint_is_a_hinge_says_so():
    bed = walls()["block, brittle mortar"]
    with pytest.raises(Stopped) as stopped:
        laboratory.run(scene_runs.load(bed.scene, bed.with_points("gauss", 1)))
    assert "hinges" in names(stopped.value.result.summary)


@pytest.mark.parametrize("drive", [{}, {"drive.direction": "z", "confinement": "0 MPa"}])
def test_one_point_is_enough_where_no_joint_turns(drive):
    one = {"specimen.points_per_edge": 1, "drive.accuracy": "2 %"}
    assert "hinges" not in names(laboratory.run(load("couplet", one | drive)).summary)


@pytest.mark.parametrize(
    ("points", "fixed", "told"),
    [
        ({"x": 1, "y": 6}, ["y", "rotation x", "rotation z"], True),
        ({"x": 6, "y": 1}, ["y", "rotation x", "rotation z"], False),
        ({"x": 6, "y": 1}, ["y", "rotation z"], True),
        (1, ["y", "rotation"], False),
        (2, ["y"], False),
    ],
)
def test_a_scene_says_before_it_runs_which_joints_are_hinges_about_axes_that_blocks_may_turn_about(points, fixed, told):
    scene = load(TORN, {**BENT, "specimen.points_per_edge": points, "support.1.fix": fixed})
    lines = [line for line in laboratory.check(scene)["warnings"] if "one row" in line]
    assert [line.split(":")[0] for line in lines] == ["contact.unit_unit"] * told
    assert all("1 joint has one row of contact points, and bears no moment" in line for line in lines)


def test_the_points_of_a_joint_that_has_one_lie_at_one_place_wherever_it_is():
    faces = faces_of(assemble(load("wallette-mode-1", {"specimen.points_per_edge": 1})))
    assert len(faces.patch) > 100 and not faces.inverse.any()


def test_the_report_sets_the_error_of_each_number_of_points_beside_what_the_run_says_of_it():
    chapter = study.chapter(lambda _: None, {"block, brittle mortar": walls()["block, brittle mortar"]})
    (verdict,) = chapter.verdicts
    assert verdict.kind == "ok" and "6 runs of 1 mortared walls" in verdict.sentence
    assert "said +1.3e+02 %" in "".join(chapter.parts) and "silent" in "".join(chapter.parts)

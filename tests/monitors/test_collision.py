"""Blocks that had no joint and meet during a run stop it; nothing else does."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from geometry.polyhedra.construct import concatenate
from geometry.polyhedra.intersect import are_convex
from geometry.polyhedra.overlaps import overlapping_pairs, widest_gaps
from geometry.specimens.boxes import boxes
from masonry import write_blocks
from masonry.assembly.assemble import assemble
from masonry.cli.main import main
from masonry.configuration.energy import Seen
from masonry.errors import Stopped
from masonry.judgement.judgement import judge
from masonry.laboratory import laboratory
from masonry.monitors.collisions.block_corners import Corners
from masonry.monitors.collisions.collision import Collision, overlap_along
from masonry.monitors.observer import View
from tests.geometry.polyhedra.test_solids import box as solid_box
from tests.geometry.polyhedra.test_solids import tube
from tests.scenes import MATERIAL, box, listed, load, specimen, tables

DRY = """law = "brittle"
normal_stiffness = "150 GPa/m"
shear_stiffness = "70 GPa/m"
tensile_strength = "0 Pa"
cohesion = "0 Pa"
friction_angle = "30 deg"
"""


def slider(gap_mm, kinematics="rigid", way=1.0, more=""):
    """A block pushed along a base towards a stop that begins `gap_mm` away, on the side of `way`."""
    start = (0.1 + gap_mm / 1e3) * way
    parts = [
        box("base", (-0.3, 0, 0), (0.7, 0.1, 0.05), "units", 1),
        box("slider", (0, 0, 0.05), (0.1, 0.1, 0.05), "units", 2),
        box("stop", (start, 0, 0.05), (0.1, 0.1, 0.05), "units", 3),
    ]
    return (
        f'kinematics = "{kinematics}"\n'
        + specimen(parts, 0.01, "50 mm")
        + tables("material", {"units": MATERIAL})
        + tables("contact", {"unit_unit": DRY})
        + listed("support", ['on = "base"\nfix = "all"', 'on = "stop"\nfix = "all"', 'on = "slider"\nfix = ["y"]'])
        + listed("traction", ['on = "slider.z+"\nstress = {z = "-0.1 MPa"}'])
        + f'[settle]\nsteps = 1000\n[drive]\non = "slider"\ndirection = "{"x" if way > 0 else "-x"}"\n'
        + 'displacement = "4 mm"\naccuracy = "5 %"\n'
        + more
    )


@pytest.mark.parametrize(("kinematics", "way"), [("rigid", 1.0), ("rigid", -1.0), ("affine", 1.0), ("tets", 1.0)])
def test_a_slider_that_meets_a_stop_is_stopped_there_with_both_names(kinematics, way):
    with pytest.raises(Stopped, match=r"'slider' and 'stop' meet around \(.*\) m, where they have no joint") as stop:
        laboratory.run(load(slider(1.0, kinematics, way)))
    places = stop.value.result.history.rows["displacement"]
    step = np.diff(places).max()
    assert 1e-3 - step < places[-1] < 1.01e-3 + 1e-5  # the next row would be beyond the face of the stop


def test_a_slider_that_does_not_get_there_goes_on():
    summary = laboratory.run(load(slider(4.5))).summary
    assert summary["displacement_at_peak_m"] > 0.0 and summary["stopped"] == ""


def test_the_shell_names_both_and_keeps_the_rows(tmp_path, capsys):
    scene = tmp_path / "slider.toml"
    scene.write_text(slider(1.0), encoding="utf-8")
    assert main(["run", str(scene), "--out", str(tmp_path / "r")]) == 3
    assert "'slider' and 'stop' meet" in capsys.readouterr().err
    assert (tmp_path / "r" / "curve.csv").is_file()


def test_blocks_of_a_set_are_named_by_number_and_blocks_without_a_set_by_unit():
    model = assemble(load(slider(1.0))).model
    look = Collision(model, {"all": np.arange(3), "pair": np.array([0, 1])})
    assert look._name(1) == "block 1 of 'pair'" and look._name(2) == "block 2 of 'all'"
    assert Collision(model, {})._name(2) == "block 2 (unit 3)"


def crossing():
    """Four blocks round an edge: those across it have no joint."""
    cuts = [(f"b{i}{k}", (0.1 * i, 0.1 * k)) for i in (0, 1) for k in (0, 1)]
    parts = [box(name, (x, 0, z), (0.1, 0.1, 0.1), "units", n) for n, (name, (x, z)) in enumerate(cuts)]
    return assemble(
        load(
            'kinematics = "rigid"\n'
            + specimen(parts, 0.01)
            + tables("material", {"units": MATERIAL})
            + tables("contact", {"unit_unit": DRY})
            + listed("support", ['on = "b00"\nfix = "all"'])
            + '[drive]\non = "b11"\ndirection = "x"\ndisplacement = "1 mm"\n'
        )
    ).model


def pushed(model, shift, turn=0.0, opening=0.0):
    """Look with the last block shifted (m) and turned about y (rad); whether it lies on the one across."""
    body, look = model.bodies.rigid, Collision(model, {})
    body.q[3, :3], body.q[3, 4] = shift, turn
    look.look(model, shown(model, opening, abs(turn)), 0)
    return look.words != ""


def shown(model, opening=0.0, rotation=0.0):
    """All contacts open by the same (m)."""
    return View(Seen(np.full(len(model.group), opening), *np.zeros((3, len(model.group)))), rotation=rotation)


def test_blocks_that_touch_along_an_edge_may_close_like_contacts_but_no_further():
    model = crossing()
    assert not pushed(model, (0.0, 0.0, 0.0))
    assert not pushed(model, (-9e-6, 0.0, -9e-6))  # a ten thousandth of 100 mm is 10 micrometres
    assert pushed(model, (-1.1e-5, 0.0, -1.1e-5))
    assert not pushed(model, (-1.1e-5, 0.0, -1.1e-5), opening=-1e-6)  # contacts close by 1 micrometre: 3 more
    assert not pushed(model, (-5e-3, 0.0, 1e-7))  # over the edge, without going in
    assert pushed(model, (-5e-3, 0.0, -2e-5))


def test_a_turn_that_only_grows_the_box_of_a_block_is_no_collision():
    model = crossing()
    for turn in (0.02, -0.02):
        assert not pushed(model, (0.0012, 0.0, 0.0012), turn)  # its nearest corner turns away by 1 mm
        assert pushed(model, (-0.002, 0.0, -0.002), turn)


def test_where_all_blocks_have_joints_with_each_other_nothing_is_looked_at():
    from masonry.scene import load as shipped

    assert Collision(assemble(shipped("couplet")).model, {}).alone


def test_a_block_that_goes_into_the_hole_of_another_does_not_meet_it_and_one_beside_it_does():
    for low, high, meets in (((1.2, 1.2, 0.5), (1.8, 1.8, 3), False), ((0.2, 1.2, 0.5), (1.8, 1.8, 3), True)):
        blocks = concatenate([tube(), solid_box(low, high)])
        pairs = [pair for *pair, _ in overlapping_pairs(blocks, np.array([[0, 1]]), 1e-6, are_convex(blocks, 1e-9))]
        assert pairs == ([[0, 1]] if meets else [])


def test_the_widest_gap_is_that_of_the_face_which_parts_two_blocks_best():
    cubes = [(f"b{k}", (x, 0, z), (1, 1, 1), "g", k, (1, 1, 1)) for k, (x, z) in enumerate([(0, 0), (1.5, 1.2)])]
    blocks = boxes(cubes, 1.0).blocks
    for pair in ([0, 1], [1, 0]):
        gap, face = widest_gaps(blocks, np.array([pair]))
        assert gap == pytest.approx([0.5])
        assert np.ptp(blocks.face(int(face[0])), axis=0)[0] == 0.0  # a face across x


def test_blocks_that_touched_along_an_edge_lie_on_each_other_a_little_with_a_doubt_and_no_further():
    model = crossing()
    look = Collision(model, {"corner": np.array([3])})
    for depth in (2e-5, 9.9e-4):  # 1 % of 100 mm is 1 mm
        model.bodies.rigid.q[3, :3] = -depth, 0.0, -depth
        look.look(model, shown(model), 7)
        assert "(unit 0) and 'corner' meet" in look.words and "from step 7 on" in look.words
    again = Collision(model, {})
    again.restore(look.state())
    assert again.words == look.words
    model.bodies.rigid.q[3, :3] = -1.1e-3, 0.0, -1.1e-3
    for one in (look, again):
        with pytest.raises(Stopped, match="meet around"):
            one.look(model, shown(model), 8)


def test_the_doubt_is_told():
    met = {"met": "block 1 and block 2 meet around (0, 0, 0) m, where they have no joint, from step 9 on"}
    doubts = {doubt.name: doubt.sentence for doubt in judge(met).doubts}
    assert "from step 9 on: nothing holds them apart" in doubts["meeting"]


@pytest.mark.parametrize("kinematics", ["rigid", "affine", "tets"])
def test_corners_move_as_pictures_show_them(kinematics):
    model = assemble(load(slider(1.0, kinematics))).model
    rng, (rigid, affine, tets) = np.random.default_rng(3), model.bodies
    for body in (rigid, affine):
        if body is not None:
            body.q[...] = 1e-3 * rng.standard_normal(body.q.shape)
    if tets is not None:
        model.contacts.u[...] = rng.standard_normal(model.contacts.u.shape)
    corners = Corners(model)
    moved = corners.frames.corners()[corners.points]
    np.testing.assert_allclose(corners.now()[0] - corners.place, moved, atol=1e-15)


def test_candidates_are_neighbours_and_a_face_that_turns_with_its_block_still_parts_them():
    for gap_mm, count in ((0.1, 1), (2.5, 0)):  # 1 % of 100 mm is 1 mm
        model = assemble(load(slider(gap_mm))).model
        far = Collision(model, {})
        far.look(model, shown(model), 0)
        assert len(far.pairs) == count
    model = assemble(load(slider(0.1))).model
    look = Collision(model, {})
    model.bodies.rigid.q[1:, 4] = 0.02  # both turn alike: their boxes overlap by 1.9 mm, and their faces do not
    place, _, gradient = look.corners.now()
    look.look(model, shown(model, rotation=0.02), 1)
    assert look.pairs.tolist() == [[1, 2]]
    assert len(look._not_parted(place, gradient, np.array([1e-6]))) == 0


@pytest.mark.parametrize("first", ["lower", "upper"])
def test_crossed_edges_that_part_two_blocks_are_remembered_and_seen_to_meet_later(tmp_path, first):
    """A roof below and one upside down across it above: no face parts the ridges, nor do the boxes of turned ones."""
    roof = np.array([[-1, -0.2, -1], [1, -0.2, -1], [1, 0.2, -1], [-1, 0.2, -1], [-1, 0, 0], [1, 0, 0]]) / 10
    faces = [[0, 3, 2, 1], [0, 1, 5, 4], [2, 3, 4, 5], [1, 2, 5], [3, 0, 4]]
    turn = Rotation.from_rotvec([0.4, 0.7, 0.2]).as_matrix()
    roofs = [roof @ turn.T, (roof[:, [1, 0, 2]] * (1, 1, -1)) @ turn.T][:: 1 if first == "lower" else -1]
    path = write_blocks(tmp_path / "ridges.blocks.h5", [(points, faces) for points in roofs], names=["one", "other"])
    model = assemble(
        load(
            f'kinematics = "rigid"\n[specimen]\nkind = "file"\npath = "{path}"\n'
            + tables("material", {"units": MATERIAL})
            + tables("contact", {"unit_unit": DRY})
            + listed("support", ['on = "one"\nfix = "all"', 'on = "other"\nfix = ["y", "z"]'])
            + '[drive]\non = "other"\ndirection = "x"\ndisplacement = "1 mm"\n'
        )
    ).model
    look, away = Collision(model, {}), 1.0 if first == "lower" else -1.0
    for gap in (1e-4, 2e-5):
        model.bodies.rigid.q[1, :3] = turn @ (0.02, 0.03, away * gap)
        look.look(model, shown(model), 1)
        place, _, gradient = look.corners.now()
        assert len(look._not_parted(place, gradient, np.array([1e-6]))) == 0 and look.words == ""
    model.bodies.rigid.q[1, :3] = turn @ (0.02, 0.03, -away * 1e-3)
    look.look(model, shown(model), 2)
    assert "meet around" in look.words


def test_the_overlap_over_a_face_is_the_least_shift_along_its_turned_normal_that_parts_two_blocks():
    rng = np.random.default_rng(4)
    corners = np.array([[x, y, z] for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)])
    turn = np.cross(np.eye(3), [0.01, -0.02, 0.015])  # of the block of the face, as the linear motion has it
    place = np.stack([corners + corners @ turn.T, corners @ np.linalg.qr(rng.standard_normal((3, 3)))[0] + 1.5])
    normal = np.eye(3)[0] - turn.T @ np.eye(3)[0]
    normal /= np.linalg.norm(normal)
    gradient = np.stack([turn, np.zeros((3, 3))])
    overlap = overlap_along(place, gradient, 0, 1, np.eye(3)[0])
    assert overlap > 0.1
    parted = place[1] + overlap * normal
    assert (parted @ normal).min() == pytest.approx((place[0] @ normal).max(), abs=1e-14)
    face = place[0] @ normal > 0.5  # the face has kept its plane, across the normal
    assert face.sum() == 4 and np.ptp((place[0] @ normal)[face]) < 2e-3

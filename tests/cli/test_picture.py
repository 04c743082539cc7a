"""`masonry picture --geometry`: what is drawn is what stands in the scene; the file is there whole or not at all."""

import re
import time

import numpy as np
import pytest

from geometry.joints.covered import covered_fractions
from geometry.joints.find import find_joints
from geometry.polyhedra.construct import concatenate, divide, from_boxes
from geometry.polyhedra.measures import face_areas_normals_centroids
from geometry.specimens.from_arrays import polyhedra
from masonry.assembly.assemble import joined
from masonry.cli.main import main
from masonry.drawings.condition_marks import marks, parts_of
from masonry.drawings.geometry_picture import camera_for, draw_geometry, geometry_figure
from masonry.drawings.picture_frame import _apart, _clear
from masonry.pictures.camera import front_view, iso_view
from masonry.pictures.hidden_surfaces import hidden, turning_edges, visible_pieces
from masonry.scene import load

PNG = b"\x89PNG\r\n\x1a\n"


def grid(numbers, low=(0, 0, 0), high=(1, 1, 1), unit=0):
    lows, highs = divide(low, high, numbers)
    return from_boxes(lows, highs, np.full(len(lows), unit), np.zeros(len(lows)), ["units"])


def drawn_area(piece, camera):
    x, y = camera.project(piece.corners).T
    return 0.5 * abs(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y))


@pytest.mark.parametrize("view", [[], ["--view", "front"], ["--view", "iso"]])
def test_the_command_writes_a_picture_and_says_where(tmp_path, capsys, view):
    out = tmp_path / "wall.png"
    assert main(["picture", "couplet", "--geometry", "--out", str(out), *view]) == 0
    assert capsys.readouterr().out.strip() == str(out)
    assert out.read_bytes()[:8] == PNG and out.stat().st_size > 10_000
    assert [path.name for path in tmp_path.iterdir()] == ["wall.png"]


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["--geometry", "--out", "wall.jpg"], "wall.jpg.*a .png, .pdf or .svg file; nearest: 'wall.png'"),
        (["--geometry", "--out", "no/such/folder/wall.png"], "cannot write.*No such file"),
        (["--geometry", "--view", "back"], "--view back is for a folder of results"),
        (["--geometry", "--view", "side"], "--view side is for a folder of results"),
        ([], "--geometry"),
        (["--geometry", "--set", "drive.on=left"], "drive.on = 'left' selects nothing"),
    ],
)
def test_what_cannot_be_drawn_ends_with_code_2_one_message_and_no_file(tmp_path, capsys, monkeypatch, words, says):
    monkeypatch.chdir(tmp_path)
    assert main(["picture", "couplet", *words]) == 2
    complaint = capsys.readouterr().err
    assert re.search(says, complaint) and complaint.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


def test_a_picture_that_fails_leaves_the_old_one(tmp_path, monkeypatch):
    out = tmp_path / "wall.png"
    out.write_bytes(b"old")

    def fail(figure, path):
        path.write_bytes(b"half")
        raise KeyboardInterrupt

    monkeypatch.setattr("masonry.drawings.geometry_picture.write_picture", fail)
    with pytest.raises(KeyboardInterrupt):
        draw_geometry(load("couplet"), out)
    assert [path.name for path in tmp_path.iterdir()] == ["wall.png"] and out.read_bytes() == b"old"


def test_the_view_is_oblique_by_default_only_where_the_drive_moves_across_the_front():
    for name, front in (("couplet", True), ("wallette-mode-1", True), ("bending-0", False)):
        scene = load(name)
        assert camera_for(scene, joined(scene)[0], None).along_an_axis is front


BOX = np.array([[0, 0, 0], [3, 1, 2.0]])


@pytest.mark.parametrize("camera", [front_view(BOX), iso_view(BOX)])
def test_what_is_drawn_of_a_divided_box_is_its_outer_faces_toward_the_viewer_and_no_more(camera):
    blocks = grid((4, 2, 3), high=(3, 1, 2))
    pieces = visible_pieces(blocks, find_joints(blocks), camera)
    faces = 4 * 3 if camera.along_an_axis else 4 * 3 + 4 * 2 + 2 * 3
    assert len({piece.face for piece in pieces}) == faces
    outline = abs(camera.toward) @ (1 * 2, 3 * 2, 3 * 1)
    assert sum(drawn_area(piece, camera) for piece in pieces) == pytest.approx(outline)


def test_edges_between_blocks_of_a_unit_are_inner_and_ridges_and_edges_between_units_outer():
    blocks = concatenate([grid((2, 1, 1)), grid((1, 1, 1), (1, 0, 0), (2, 1, 1), 1)])
    pieces = visible_pieces(blocks, find_joints(blocks), iso_view(blocks.points))
    inner = [piece.corners[k] for piece in pieces for k in np.flatnonzero(piece.block_edge & ~piece.unit_edge)]
    assert {tuple(p[:1]) for p in inner} == {(0.5,)}
    assert len(inner) == 4, "one edge on the front and one on the top, from both sides"


@pytest.mark.parametrize("height", [0.02, 0.5, 3.0])
def test_a_post_before_a_wall_is_drawn_after_all_that_it_hides(height):
    wall = grid((6, 1, 6), high=(3, 0.3, 3))
    post = grid((1, 1, 1), (1.2, -0.1, 0.0), (1.3, 0.0, height), 1)
    blocks = concatenate([wall, post])
    camera = iso_view(blocks.points)
    pieces = visible_pieces(blocks, find_joints(blocks), camera)
    owner = blocks.face_block()
    of_post = np.array([owner[piece.face] == wall.count for piece in pieces])
    in_front = np.array([abs(piece.corners[:, 1].max()) < 1e-9 for piece in pieces])
    assert np.flatnonzero(of_post).min() > np.flatnonzero(in_front & ~of_post).max()


def test_a_point_behind_the_wall_is_hidden_and_one_before_or_above_it_is_not():
    wall = grid((3, 1, 3), high=(3, 0.3, 3))
    camera = iso_view(wall.points)
    pieces = visible_pieces(wall, find_joints(wall), camera)
    for place, behind in (((1.5, 0.4, 1.5), True), ((1.5, -0.1, 1.5), False), ((1.5, 0.15, 3.2), False)):
        assert hidden(np.array(place), pieces, camera, 1e-6) is behind


def test_covered_faces_are_those_in_joints():
    blocks = grid((2, 1, 1))
    assert np.allclose(np.sort(covered_fractions(blocks, find_joints(blocks)))[-2:], 1)
    assert np.count_nonzero(covered_fractions(blocks, find_joints(blocks))) == 2


def test_marks_stand_where_the_scene_holds_and_loads_the_specimen():
    scene = load("couplet")
    bottom, top, drive, traction = marks(scene, *joined(scene))
    assert bottom.all_held and not top.all_held and top.axes == (1,)
    base, way, presses = drive.arrows[0]
    assert np.allclose(base[:, 0], 0) and way.tolist() == [1, 0, 0] and presses
    assert drive.value == "1 mm"
    base, way, presses = traction.arrows[0]
    assert np.allclose(base[:, 2], 0.1) and way.tolist() == [0, 0, -1] and presses
    assert traction.value == "z -0.5 MPa"


def test_a_plate_that_is_pulled_has_arrows_that_lead_away_from_its_outer_side():
    scene = load("wallette-mode-1")
    specimen, joints = joined(scene)
    drive = marks(scene, specimen, joints)[-1]
    base, way, presses = drive.arrows[0]
    assert np.allclose(base[:, 0], specimen.blocks.points[:, 0].max()) and way[0] == 1 and not presses


def test_a_history_of_one_way_is_drawn_the_way_it_goes_and_one_that_turns_says_so():
    scene = load("arch-spread")
    drive = marks(scene, *joined(scene))[-1]
    base, way, presses = drive.arrows[0]
    assert drive.words == "drive: right abutment, -1 mm along -x"
    assert way.tolist() == [1.0, 0.0, 0.0] and not presses and base[:, 0].min() > 1.0
    turning = load("couplet-cyclic")
    assert [mark.value for mark in marks(turning, *joined(turning)) if mark.kind == "drive"] == [
        "0.4 mm at most, back and forth"
    ]


def test_names_keep_clear_of_other_words_and_stay_in_order():
    moved = _clear([0.0, 0.04, 0.3], [0.02, 0.31], 0.05)
    assert np.all(np.diff(moved) >= 0.05 - 1e-12)
    assert all(abs(level - taken) >= 0.05 for level in moved for taken in (0.02, 0.31))
    assert _clear([0.0, 1.0], [], 0.05) == [0.0, 1.0]


def test_rollers_that_stand_apart_are_marked_one_by_one():
    scene = load("bending-0")
    specimen, joints = joined(scene)
    assert [len(part) for part in parts_of(joints, np.unique(specimen.sets["load rollers"]), None)] == [1, 1]
    assert len(marks(scene, specimen, joints)[-1].arrows) == 2


def test_names_beside_the_picture_are_apart_and_in_order():
    moved = _apart([0.0, 0.0, 0.01, 1.0], 0.1)
    assert np.all(np.diff(moved) >= 0.1 - 1e-12)
    assert np.mean(moved) == pytest.approx(np.mean([0.0, 0.0, 0.01, 1.0]))


@pytest.mark.parametrize(
    ("name", "view"),
    [
        *((name, None) for name in ("couplet", "wallette-mode-2", "bending-025", "arch-spread")),
        *(("couplet-cyclic", view) for view in ("front", "iso")),
    ],
)
def test_no_words_of_the_picture_overlap_or_are_cut(name, view):
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.text import Text

    scene = load(name)
    figure = geometry_figure(scene, *joined(scene), view)
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    axes = figure.axes[0]
    if axes.axison:
        upright = axes.spines["left"].get_window_extent()
        assert not any(Text.get_window_extent(text).overlaps(upright) for text in axes.texts)
    texts = [t for t in [*figure.axes[0].texts, figure.axes[0].title] if t.get_text()]
    boxes = [Text.get_window_extent(t, canvas.get_renderer()) for t in texts]  # without the line of a name
    page = figure.bbox
    for text, box in zip(texts, boxes, strict=True):
        assert page.x0 <= box.x0 and box.x1 <= page.x1 and page.y0 <= box.y0 and box.y1 <= page.y1, text
    pairs = [(j, k) for k in range(len(texts)) for j in range(k)]
    assert [(texts[j], texts[k]) for j, k in pairs if boxes[j].overlaps(boxes[k])] == []


def test_a_wall_of_5000_blocks_is_drawn_in_seconds(tmp_path):
    scene = load("wallette-mode-2", {"specimen.divisions": [36, 18]})
    specimen, joints = joined(scene)
    assert specimen.blocks.count > 5000
    begin = time.process_time()
    geometry_figure(scene, specimen, joints, "iso").savefig(tmp_path / "large.png")
    assert time.process_time() - begin < 20


def test_no_line_is_drawn_within_a_face_that_is_cut_in_two():
    """The diagonal of a nearly flat upper face is no edge; that of a roof is one."""
    faces = [(0, 3, 2, 1), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7), (4, 5, 6), (4, 6, 7)]
    for rise, drawn in ((0.01, 0), (0.2, 2)):
        points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1 + rise)]
        blocks = polyhedra([(points, faces)], ["box"], [0], ["units"])
        upper = np.flatnonzero(face_areas_normals_centroids(blocks)[1][:, 2] > 0.5)
        normal = face_areas_normals_centroids(blocks)[1]
        edges = turning_edges(blocks, upper, normal)
        assert len(edges) == 6 and edges.sum() == 4 + drawn

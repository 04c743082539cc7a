"""A page that shows a model or a result: its numbers are those of the model, and it takes nobody's place."""

import gzip
import json
import re
from base64 import b64decode

import numpy as np
import pytest

import masonry
from geometry.polyhedra.measures import centroids, face_areas_normals_centroids, volumes
from masonry.assembly.assemble import fabric_of
from masonry.assembly.conditions import select
from masonry.cli.main import main
from masonry.errors import SceneError
from masonry.viewing.buffers import Buffers
from masonry.viewing.frames_part import chosen_frames, compression, middle_of
from masonry.viewing.joint_tiles import JointTiles
from masonry.viewing.view import view_of_result, view_of_scene
from tests.results.sample import sample

KINDS = {"f4": np.float32, "u4": np.uint32, "i2": np.int16}


class ReadPage:
    """What a page holds."""

    def __init__(self, text):
        content, arrays = (
            re.search(f'<script id="{name}" type="[^"]*">(.*?)</script>', text, re.S)[1]
            for name in ("content", "arrays")
        )
        self.content = json.loads(content)
        self._bytes = gzip.decompress(b64decode(arrays))

    def array(self, entry, *shape):
        values = np.frombuffer(self._bytes, KINDS[entry["kind"]], entry["count"], entry["at"])
        return (values * entry.get("unit", 1)).reshape(shape or (-1,)).astype(float)

    def forces(self, words):
        (load,) = [load for load in self.content["loads"] if load["words"].startswith(words)]
        tip, direction = self.array(load["tip"], -1, 3), self.array(load["direction"], -1, 3)
        return tip + self.content["origin"], self.array(load["force"])[:, None] * direction


@pytest.fixture(scope="module")
def leaning_arch():
    scene = masonry.load("arch", {"specimen.voussoirs": 7, "specimen.turned": {"about": "y", "angle": "8 deg"}})
    return scene, fabric_of(scene), ReadPage(view_of_scene(scene).text)


def test_rounded_numbers_are_within_half_a_unit_and_others_in_single_precision():
    numbers = np.random.default_rng(3).normal(size=(40, 3)) * 1e-4
    buffers = Buffers()
    entries = buffers.add(numbers[:5]), buffers.add_rounded(numbers), buffers.add(np.array([7, 2**31]), "u4")
    buffers.add_rounded(np.array([np.nan, np.inf, 0.0]))
    page = f'<script id="content" type="x">{json.dumps(entries)}</script>'
    page = ReadPage(f'{page}<script id="arrays" type="x">{buffers.text()}</script>')
    assert page.array(entries[0], 5, 3) == pytest.approx(numbers[:5], rel=1e-7)
    assert np.abs(page.array(entries[1], 40, 3) - numbers).max() <= 0.51 * np.abs(numbers).max() / 32767
    assert page.array(entries[2]).tolist() == [7, 2**31]


def test_triangles_enclose_the_volume_of_each_block(leaning_arch):
    _, fabric, page = leaning_arch
    blocks = page.content["blocks"]
    points = page.array(blocks["points"], -1, 3)
    triangles, owner = page.array(blocks["triangles"], -1, 3), page.array(blocks["triangle_block"])
    a, b, c = (points[triangles[:, k].astype(int)] for k in range(3))
    enclosed = np.bincount(owner.astype(int), np.einsum("ij,ij->i", a, np.cross(b, c)) / 6)
    assert enclosed == pytest.approx(volumes(fabric.specimen.blocks), rel=1e-5)
    assert page.array(blocks["volume"]) == pytest.approx(enclosed, rel=1e-5)


def test_tiles_cover_the_joints(leaning_arch):
    _, fabric, page = leaning_arch
    joints = page.content["joints"]
    start, corners = page.array(joints["tile_start"]).astype(int), page.array(joints["tile_points"], -1, 3)
    areas = [
        0.5 * np.linalg.norm(sum(np.cross(p[k] - p[0], p[k + 1] - p[0]) for k in range(1, len(p) - 1)))
        for p in np.split(corners, start[1:-1])
    ]
    whole = np.bincount(fabric.joints.patch, fabric.joints.area)
    assert np.bincount(page.array(joints["joint"]).astype(int), areas) == pytest.approx(whole, rel=1e-4)
    assert np.bincount(page.array(joints["joint"]).astype(int), page.array(joints["area"])) == pytest.approx(whole)


def test_arrows_of_the_weight_are_the_weight_of_each_block(leaning_arch):
    _, fabric, page = leaning_arch
    blocks = fabric.specimen.blocks
    tip, force = page.forces("weight")
    assert force == pytest.approx(fabric.density[:, None] * volumes(blocks)[:, None] * [0.0, 0.0, -9.81], rel=1e-5)
    assert tip == pytest.approx(centroids(blocks), abs=1e-5)


def test_the_arrow_of_a_traction_lies_on_its_line_of_action():
    oblique = {"x": "0.03 MPa", "y": "-0.02 MPa", "z": "-0.05 MPa"}
    on = masonry.load("wall-with-window").traction[0].on
    scene = masonry.load("wall-with-window", {"traction": [{"on": on, "stress": oblique}]})
    traction = scene.traction[0]
    fabric = fabric_of(scene)
    _, faces = select(fabric.specimen, fabric.joints, traction.on, "traction.0.on")
    area, _, centre = face_areas_normals_centroids(fabric.specimen.blocks)
    tip, force = ReadPage(view_of_scene(scene).text).forces("traction 0")
    stress = np.array(traction.stress)
    assert force.sum(axis=0) == pytest.approx(area[faces].sum() * stress, rel=1e-5)
    moment = np.cross(centre[faces], area[faces][:, None] * stress).sum(axis=0)
    assert np.cross(tip, force).sum(axis=0) == pytest.approx(moment, rel=1e-4, abs=1e-4 * np.abs(moment).max())


def test_a_load_that_grows_is_shown_at_a_factor_of_one():
    scene = masonry.load("wall-to-and-fro")
    _, force = ReadPage(view_of_scene(scene).text).forces(scene.limit.words)
    assert force.sum(axis=0) == pytest.approx(np.array(scene.limit.force or (0, 0, 0)), rel=1e-5, abs=1e-6)


def test_axles_of_a_vehicle_press_on_its_road():
    scene = masonry.load("bridge")
    tip, force = ReadPage(view_of_scene(scene).text).forces("vehicle")
    assert -force[:, 2] == pytest.approx(scene.vehicle.axles)
    assert np.diff(tip[:, 0]) == pytest.approx(np.sign(np.diff(tip[:, 0])) * scene.vehicle.spacings, rel=1e-5)


def test_blocks_move_as_their_corners_do():
    result = sample()
    page = ReadPage(view_of_result(result).text)
    shown, blocks = page.content["result"], result.specimen.blocks
    owner = np.repeat(blocks.face_block(), np.diff(blocks.face_start))
    arm = blocks.points[blocks.face_points] - middle_of(blocks.points) - page.array(shown["centre"], -1, 3)[owner]
    for entry, frame in zip(shown["list"], result.history.frames, strict=True):
        gradient = page.array(entry["gradient"], -1, 3, 3)[owner]
        moved = page.array(entry["shift"], -1, 3)[owner] + np.einsum("nij,nj->ni", gradient, arm)
        size = max(np.abs(frame.corners).max(), 1e-12)
        assert moved == pytest.approx(frame.corners[blocks.face_points], abs=2e-4 * size)


def test_the_point_on_the_curve_is_that_of_the_frame():
    result = sample()
    shown = ReadPage(view_of_result(result).text).content["result"]
    rows, line = result.history.rows, shown["curve"]["lines"][0]
    for row, frame in zip(line["at"], result.history.frames, strict=True):
        assert line["x"][row] == pytest.approx(
            1e3 * np.interp(frame.step, rows["step"], rows["displacement"]), rel=1e-5
        )


def test_of_many_points_whole_joints_are_shown_with_the_same_force(leaning_arch):
    joints = leaning_arch[1].joints
    whole, points = JointTiles(joints, True), JointTiles(joints, False)
    stress = np.random.default_rng(5).normal(size=len(joints.area))
    force = np.bincount(joints.patch, points.area * points.mean(stress))
    assert whole.area * whole.mean(stress) == pytest.approx(force)
    assert whole.largest(np.abs(stress)).max() == np.abs(stress).max()
    assert len(whole.first) == len(joints.patch_start) - 1 < len(points.first)
    centre = np.bincount(joints.patch, joints.area * joints.point[:, 0]) / whole.area
    assert whole.mean(joints.point)[:, 0] == pytest.approx(centre)


def test_few_frames_keep_the_first_the_last_and_the_peak():
    frames = list(range(100))
    assert chosen_frames(frames, 5, 37) == [0, 25, 37, 50, 74, 99]
    assert chosen_frames(frames[:4], 5, None) == [0, 1, 2, 3]


def test_the_largest_compression_is_a_principal_stress():
    turn = np.linalg.qr(np.random.default_rng(1).normal(size=(3, 3)))[0]
    xx, xy, xz, _, yy, yz, _, _, zz = (turn @ np.diag([-3.0, 1.0, 2.0]) @ turn.T).ravel()
    assert compression(np.array([[xx, yy, zz, yz, xz, xy], [1.0, 2.0, 3.0, 0, 0, 0]])) == pytest.approx([3.0, 0.0])


def test_names_of_a_user_do_no_harm_to_the_page():
    page = masonry.view(masonry.load("couplet", {"title": "</script><i>$x$"})).text
    assert "</script><i>" not in page and "<title>&lt;/script&gt;&lt;i&gt;$x$</title>" in page
    assert ReadPage(page).content["title"] == "</script><i>$x$"


def test_files_of_others_stay_and_our_own_page_is_written_again(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(["view", "couplet"]) == 0 and main(["view", "couplet"]) == 0
    assert capsys.readouterr().out == "couplet-view.html\ncouplet-view.html\n"
    (tmp_path / "mine.html").write_text("mine")
    assert main(["view", "couplet", "--out", "mine.html"]) == 2 and (tmp_path / "mine.html").read_text() == "mine"
    assert main(["view", "couplet", "--out", "couplet.png"]) == 2
    assert "nearest: 'couplet.html'" in capsys.readouterr().err


@pytest.mark.parametrize("words", [("couplet", "--frames", "9"), ("no-such-scene",), ("couplet", "--set", "law=none")])
def test_what_cannot_be_shown_is_refused_and_nothing_is_written(tmp_path, monkeypatch, words):
    monkeypatch.chdir(tmp_path)
    assert main(["view", *words]) == 2
    assert not list(tmp_path.iterdir())


def test_a_result_is_shown_with_fewer_frames_and_not_with_one(tmp_path):
    result = sample()
    assert len(ReadPage(result.view(2).text).content["result"]["list"]) <= 3
    with pytest.raises(SceneError, match="2 or more"):
        view_of_result(result, 1)
    with pytest.raises(SceneError, match="frames: of a result"):
        masonry.view("couplet", frames=5)


def test_a_page_asks_nothing_of_the_network():
    text = masonry.view("couplet").text
    assert not re.search(r"(?:src|href)\s*=\s*[\"']?https?:", text)
    assert "srcdoc" in masonry.view("couplet")._repr_html_()

"""Pictures of large displacement show blocks where they lie: each outline moved, the nearer before the farther."""

import dataclasses

import numpy as np
import pytest

from geometry.blocks import Blocks, Specimen
from geometry.polyhedra.construct import from_boxes
from masonry.laboratory.result import Result
from masonry.movies.movie import Movie
from masonry.pictures.camera import OUT, box_of, camera_of, front_view, iso_view, usual_view
from masonry.pictures.crack_picture import cracks_figure, drawing_of, gallery
from masonry.pictures.front import FlatDrawing
from masonry.pictures.large.depth_order import farthest_first, overlaps
from masonry.pictures.large.edges import continued
from masonry.pictures.large.moved_blocks import MovedDrawing, seen_pieces
from masonry.pictures.large.scale_bar import round_length, words
from masonry.pictures.oblique import SolidDrawing
from masonry.rows.history import Frame, History
from tests.results.sample import joints_of, sample

LARGE = 'displacements = "large"\n'
QUARTER = {"x": [[1, 0, 0], [0, 0, -1], [0, 1, 0]], "y": [[0, 0, 1], [0, 1, 0], [-1, 0, 0]]}
"""A quarter of a turn about an axis."""


def boxes(low, size, unit=None) -> Blocks:
    """Boxes of one size (3,) m with their lowest corners at low (B, 3) m."""
    low = np.atleast_2d(np.asarray(low, dtype=float))
    unit = np.arange(len(low)) if unit is None else unit
    return from_boxes(low, low + size, unit, np.zeros(len(low)), ("units",))


def fallen(blocks: Blocks, displacement: np.ndarray, damage: float = 0.9) -> Result:
    """A result of large displacement whose only frame has corners moved by displacement (P, 3) m."""
    joints = joints_of(blocks)
    zero = np.zeros(len(joints.area))
    frame = Frame(
        step=1,
        time=1.0,
        displacement=0.0,
        corners=displacement,
        nodes=np.zeros((0, 3)),
        opening=zero + 1e-3,
        slip=zero,
        normal_stress=zero,
        shear_stress=zero,
        damage_tension=zero + damage,
        damage_shear=zero,
        stress=np.zeros((blocks.count, 6)),
    )
    return Result(
        summary={},
        history=History({}, [frame]),
        specimen=Specimen(blocks, shape="wall"),
        joints=joints,
        joint_group=np.zeros(len(joints.area), dtype=int),
        joint_groups=("unit_unit",),
        scene_toml=LARGE,
    )


def turned(blocks: Blocks, number: int, about: str, shift: tuple[float, float, float]) -> np.ndarray:
    """(P, 3) m, the displacement of the corners where one block has turned by 90 degrees and moved."""
    moved = np.zeros_like(blocks.points)
    own = np.unique(blocks.face_points[24 * number : 24 * (number + 1)])
    corner = blocks.points[own]
    centre = corner.mean(axis=0)
    moved[own] = (corner - centre) @ np.array(QUARTER[about], dtype=float).T + centre + shift - corner
    return moved


def pieces_of(result: Result, view: str):
    """The pieces that are drawn of the last frame at true scale, and the drawing."""
    drawing = drawing_of(result, view)
    return drawing.pieces(result.history.frames[-1], 1.0), drawing


@pytest.mark.parametrize("view", ["front", "back", "side", "iso"])
def test_the_outline_of_a_block_that_turned_is_that_of_its_moved_corners(view):
    blocks = boxes([[0, 0, 0], [0, 0, 0.1]], (0.3, 0.2, 0.1))
    moved = turned(blocks, 1, "y", (0.5, 0.1, 0.0))
    pieces, drawing = pieces_of(fallen(blocks, moved), view)
    of_block = [piece.corners for piece in pieces if piece.face >= 6]
    corners = (blocks.points + moved)[8:]
    np.testing.assert_allclose(np.ptp(corners, axis=0), (0.1, 0.2, 0.3), atol=1e-12)
    outline = drawing.camera.project(np.concatenate(of_block))
    for low_or_high in (np.min, np.max):
        np.testing.assert_allclose(
            low_or_high(outline, axis=0), low_or_high(drawing.camera.project(corners), axis=0), atol=1e-12
        )
    area = sum(np.cross(*np.diff(c, axis=0)[:2]) @ drawing.camera.toward for c in of_block)
    assert area == pytest.approx(np.abs(drawing.camera.toward) @ (0.2 * 0.3, 0.1 * 0.3, 0.1 * 0.2)), "its whole shadow"


def test_a_face_that_lay_in_a_joint_is_seen_once_the_joint_is_open():
    blocks = boxes([[0, 0, 0], [0, 0, 0.1]], (0.3, 0.2, 0.1))
    aside = np.zeros_like(blocks.points)
    aside[8:] = (0.5, 0.0, -0.1)
    top = 5
    for moved, seen in ((aside, True), (1e-6 * aside, False)):
        pieces, _ = pieces_of(fallen(blocks, moved), "iso")
        assert (top in {piece.face for piece in pieces}) == seen
    small = fallen(blocks, aside)
    small.scene_toml = ""
    assert top not in {piece.face for piece in SolidDrawing(small).visible}


def test_a_block_that_fell_before_another_hides_it_and_behind_it_is_hidden():
    blocks = boxes([[0, 0, 0], [0, 0, 0.1]], (0.3, 0.2, 0.1))
    for y, first in ((-0.5, 0), (0.5, 1)):
        away = np.zeros_like(blocks.points)
        away[8:] = (0.05, y, -0.1)
        pieces, _ = pieces_of(fallen(blocks, away), "front")
        assert [piece.face // 6 for piece in pieces] == [first, 1 - first]


def test_what_is_drawn_last_at_any_place_of_a_heap_is_what_is_nearest_there():
    random = np.random.default_rng(3)
    low = np.stack(np.meshgrid(*3 * [np.arange(5.0)], indexing="ij"), axis=-1).reshape(-1, 3)
    blocks = boxes(low, (0.55, 0.55, 0.55))
    turn = np.linalg.qr(random.normal(size=(len(low), 3, 3)))[0]
    turn *= np.linalg.det(turn)[:, None, None]
    centre = np.repeat(low + 0.275, 8, axis=0)
    points = centre + np.einsum("nij,nj->ni", np.repeat(turn, 8, axis=0), blocks.points - centre)
    for camera in (front_view(points), iso_view(points)):
        pieces = seen_pieces(dataclasses.replace(blocks, points=points), camera, continued(blocks))
        depth, inside = [], []
        place = random.uniform(*np.quantile(camera.project(points), (0.0, 1.0), axis=0), size=(2000, 2))
        for piece in pieces:
            flat = camera.project(piece.corners)
            edge = np.roll(flat, -1, axis=0) - flat
            beside = place[:, None] - flat
            inside.append((edge[:, 0] * beside[..., 1] - edge[:, 1] * beside[..., 0] > 1e-3).all(axis=1))
            normal = np.cross(*np.diff(piece.corners, axis=0)[:2])
            level = (piece.corners[0] @ normal - place @ camera.project(normal)) / (normal @ camera.toward)
            depth.append(np.where(inside[-1], level, -np.inf))
        shown = np.array(inside).any(axis=0)
        assert shown.mean() > 0.4
        last = len(pieces) - 1 - np.argmax(np.array(inside)[::-1], axis=0)
        assert np.array_equal(last[shown], np.argmax(depth, axis=0)[shown])


def test_faces_in_a_ring_are_all_drawn():
    bar = np.array([[-2, -0.4, -1], [2, 0.4, -1], [2, 0.4, -0.5], [-2, -0.4, -0.5]])
    thirds = [
        np.array([[c, 0, -s], [0, 1, 0], [s, 0, c]]) for c, s in ((1, 0), (-0.5, 0.75**0.5), (-0.5, -(0.75**0.5)))
    ]
    faces = np.array([bar @ turn.T for turn in thirds])
    camera = front_view(np.array([[-3, 0, -3], [3, 1, 3.0]]))
    pair, nearer = overlaps(faces, camera)
    assert len(pair) == 3
    assert len({int(both[1 if second else 0]) for both, second in zip(pair, nearer, strict=True)}) == 3, (
        "each is nearer"
    )
    assert sorted(farthest_first(faces, camera).tolist()) == [0, 1, 2]


def test_an_edge_between_cells_of_a_unit_is_one_of_the_unit_once_they_part():
    blocks = boxes([[0, 0, 0], [0.2, 0, 0]], (0.2, 0.1, 0.1), np.zeros(2))
    edges = continued(blocks)
    for gap, outer in ((1e-5, False), (0.05, True)):
        points = blocks.points.copy()
        points[8:, 0] += gap
        unit, block = edges.kinds(dataclasses.replace(blocks, points=points))
        on_front = [e for e in edges.edge.tolist() if 8 <= e % 24 < 12]
        assert len(on_front) == 2 and unit[on_front].tolist() == [outer, outer] and block.all()


def test_cracks_are_drawn_where_two_blocks_are_near_and_not_in_the_air_between_them():
    blocks = boxes([[0, 0, 0], [0, 0, 0.1], [0, 0, 0.2]], (0.3, 0.2, 0.1))
    away = np.zeros_like(blocks.points)
    away[8:16] = (0.0, 0.0, 0.01)
    away[16:] = (0.6, 0.0, -0.2)
    result = fallen(blocks, away)
    drawing = drawing_of(result, "front")
    shown = drawing.cracks(result.history.frames[-1]).contact
    assert set(result.joints.patch[shown]) == {0} and len(shown) > 0


def test_marks_of_forces_and_their_key_are_where_joints_have_not_parted():
    blocks = boxes([[0, 0, 0], [0, 0, 0.1], [0, 0, 0.2], [0, 0, 0.3]], (0.3, 0.2, 0.1))
    for fall, joints in ((0.0, 3), (1.0, 2)):
        away = np.zeros_like(blocks.points)
        away[24:] = (fall, 0.0, 0.0)
        result = fallen(blocks, away)
        result.scene_toml += '[gravity]\nz = "-9.81 m/s^2"\n'
        frame = dataclasses.replace(result.history.frames[0], normal_stress=np.full(len(result.joints.area), -1e5))
        result.history.frames = [frame]
        place = drawing_of(result, "front").thrust.displaced(result, frame, 1.0)
        assert np.isfinite(place[:, 0]).sum() == joints
        assert "thrust line" in _keys(result)
    result.history.frames = [dataclasses.replace(frame, normal_stress=0.0 * frame.normal_stress)]
    assert "thrust line" not in _keys(result)


def test_a_mark_of_a_force_is_hidden_by_what_fell_before_its_joint():
    blocks = boxes([[0, 0, 0], [0, 0, 0.1], [0, 0, 0.2], [0, 0, 0.3]], (0.3, 0.2, 0.1))
    for y, marks in ((-0.5, 1), (0.5, 2)):
        away = turned(blocks, 3, "y", (0.0, y, -0.05))
        result = fallen(blocks, away)
        result.scene_toml += '[gravity]\nz = "-9.81 m/s^2"\n'
        pressed = np.where(result.joints.point[:, 2] < 0.25, -1e5, 0.0)
        frame = dataclasses.replace(result.history.frames[0], normal_stress=pressed)
        place = drawing_of(result, "front").forces_at(frame, 1.0)
        assert np.isfinite(place[:, 0]).sum() == marks


def _keys(result: Result) -> list[str]:
    return [text.get_text() for text in cracks_figure(result).legends[0].get_texts()]


def test_what_falls_out_of_the_front_is_seen_from_the_side_unless_a_view_is_asked_for():
    blocks = boxes([[0, 0, 0], [0, 0, 0.1]], (0.3, 0.2, 0.1))
    for direction, view in (((0.0, 0.6, -0.1), "side"), ((0.6, 0.0, -0.1), "front"), ((0.0, 0.0, 0.0), "front")):
        away = np.zeros_like(blocks.points)
        away[8:] = direction
        result = fallen(blocks, away)
        assert usual_view(result) == view
        result.scene_toml = ""
        assert usual_view(result) == "front"
    side = camera_of("side", result.specimen)
    np.testing.assert_array_equal((side.right, side.up, side.toward), ([0, 1, 0], [0, 0, 1], [1, 0, 0]))


def test_a_picture_of_large_displacement_has_a_bar_of_length_and_one_of_small_has_none():
    blocks = boxes([[0, 0, 0], [0, 0, 0.1]], (0.3, 0.2, 0.1))
    result = fallen(blocks, turned(blocks, 1, "x", (0.5, 0.1, 0.0)))
    frame = result.history.frames[0]
    (axes,) = gallery([("at the end", result, frame)]).axes[:1]
    (bar,) = [line for line in axes.get_lines() if line.get_linestyle() == "-"]
    (word,) = axes.texts
    assert word.get_text() == words(float(np.ptp(bar.get_xdata())))
    assert [text.get_text() for text in Movie(result).panel.texts] == [word.get_text()]
    small = sample()
    assert not gallery([("at the end", small, small.history.frames[-1])]).axes[0].texts
    assert round_length(0.49) == pytest.approx(0.2) and round_length(0.5) == pytest.approx(0.5)
    assert (words(0.5), words(0.02), words(10.0)) == ("0.5 m", "20 mm", "10 m")


def test_only_results_of_large_displacement_are_drawn_anew_in_every_frame():
    small, large = sample(), sample()
    large.scene_toml += LARGE
    assert isinstance(drawing_of(small), FlatDrawing) and isinstance(drawing_of(small, "iso"), SolidDrawing)
    assert all(isinstance(drawing_of(large, view), MovedDrawing) for view in ("front", "back", "side", "iso"))


def test_what_has_left_the_floor_and_fell_for_long_does_not_make_a_point_of_the_rest():
    blocks = boxes([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]], (1.0, 1.0, 1.0))
    camera, stays = camera_of("front", Specimen(blocks)), np.zeros_like(blocks.points)
    fell = np.where(blocks.points[:, :1] > 1.0, [0.0, 0.0, -1.0], 0.0) * (OUT * camera.size)
    assert np.ptp(box_of(camera, blocks, [stays, 0.99 * fell]), axis=0)[1] > 4.0 * camera.size
    assert box_of(camera, blocks, [stays, 1.01 * fell]) == pytest.approx(box_of(camera, blocks, [stays]))

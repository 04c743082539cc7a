"""Pictures show what happened, where it happened, and nothing where nothing happened."""

import dataclasses
from types import SimpleNamespace

import numpy as np
import pytest
from matplotlib import image

import masonry
from masonry.laboratory.text import summary_text
from masonry.pictures.camera import front_view
from masonry.pictures.crack_lines import crack_lines, outlines
from masonry.pictures.crack_picture import cracks_figure, frames_to_draw, magnification
from masonry.pictures.crack_style import THICK, THIN, crack_keys, kinds_of, scale_of, widths
from masonry.pictures.front import FlatDrawing
from masonry.pictures.oblique import SolidDrawing
from masonry.results.deformation import BlockCorners, Deformation
from masonry.results.dry_joints import as_it_stands
from masonry.results.summary import Summary
from tests.results.sample import HEIGHT, LENGTH, joints_of, opened, sample, wall, with_tets


def pixels(result, path, draw):
    """(rows, columns, 3) of the upper 85 % of the left 80 % of a picture: without legend and colour bars."""
    getattr(result, draw)(path)
    picture = image.imread(path)[:, :, :3]
    return picture[: int(0.85 * len(picture)), : int(0.8 * picture.shape[1])]


def red(picture):
    return (picture[..., 0] > 0.4) & (picture[..., 1] < 0.3) & (picture[..., 2] < 0.3)


def blue(picture):
    return (picture[..., 2] > 0.5) & (picture[..., 0] < 0.35)


def test_broken_joints_are_red_where_tension_leads_and_blue_where_shear_leads(tmp_path):
    picture = pixels(sample(), tmp_path / "cracks.png", "picture")
    assert picture.shape[1] > 1000
    assert red(picture).sum() > 1000 and blue(picture).sum() > 500
    assert red(picture).any(axis=1).mean() > 0.3, "the crack goes through the height of the wall"


def test_a_sound_wall_shows_no_crack(tmp_path):
    picture = pixels(sample(damaged=False), tmp_path / "cracks.png", "picture")
    assert not red(picture).any() and not blue(picture).any()
    assert np.ptp(picture) > 0.5, "it is drawn nevertheless"


def test_the_picture_of_a_wall_with_tets_and_of_a_standing_wall_can_be_drawn(tmp_path):
    assert red(pixels(with_tets(sample()), tmp_path / "a.png", "picture")).any()
    standing = sample()
    standing.history.frames = standing.history.frames[:1]
    assert not red(pixels(standing, tmp_path / "b.png", "picture")).any()


def test_the_curve_is_drawn_at_1200_pixels_with_its_peak_and_its_ledger(tmp_path):
    result = sample()
    result.plot(tmp_path / "curve.png")
    picture = image.imread(tmp_path / "curve.png")[:, :, :3]
    assert picture.shape[1] == 1200
    ledger = picture[len(picture) * 6 // 10 :, :1000]
    assert red(ledger).sum() > 5000, "fracture energy fills an area"


def test_the_peak_is_that_of_the_summary_and_without_one_that_of_the_rows(tmp_path):
    result = sample()
    result.summary |= {"peak_stress_pa": 190001.0}
    assert result.peak == (4e-5, 190001.0)
    result.summary = Summary.read({"peak_stress_pa": None, "law": {"a": "elastic", "b": "linear"}})
    result.plot(tmp_path / "curve.png")
    assert result.peak == pytest.approx((4e-5, 190000.0))


@pytest.mark.parametrize(("rise", "word"), [(0.0099, "peak"), (0.0101, "highest")])
def test_a_force_that_still_rises_at_the_end_has_no_peak_in_words_and_picture(rise, word):
    result = sample()
    result.summary |= {"rise_at_end": rise}
    assert word in [line.get_label() for line in result.plot().axes[0].get_lines()]
    assert ("; it still rose at the end" in summary_text(result.summary)) == (word == "highest")


def test_a_negative_term_and_an_empty_history_do_not_stop_the_curve(tmp_path):
    result = sample()
    result.history.rows["elastic_contacts"] *= -1
    result.plot(tmp_path / "curve.png")
    result.history.rows = {}
    result.plot(tmp_path / "empty.png")
    assert (tmp_path / "empty.png").stat().st_size > 1000


def test_the_frames_drawn_are_the_one_nearest_the_peak_and_the_last():
    drawn = frames_to_draw(sample())
    assert [(name, frame.step) for name, frame in drawn] == [("at the peak", 200), ("at the end", 1000)]
    growing = sample()
    growing.history.rows["stress"] = growing.history.rows["displacement"]
    assert [frame.step for _, frame in frames_to_draw(growing)] == [1000]


def test_the_largest_displacement_is_drawn_as_a_twentyfifth_of_the_wall():
    frame = sample().history.frames[-1]
    assert magnification(frame, 1.0) * 2e-4 == pytest.approx(0.04, rel=0.06)
    assert magnification(sample().history.frames[0], 1.0) == 1.0


@pytest.mark.parametrize(
    ("extent", "plane", "toward"),
    [
        ((2, 1, 3), (0, 2), (0, -1, 0)),
        ((3, 2, 1), (0, 1), (0, 0, 1)),
        ((1, 2, 3), (1, 2), (1, 0, 0)),
        ((1, 1, 1), (0, 2), (0, -1, 0)),
    ],
)
def test_the_view_is_onto_the_two_largest_extents(extent, plane, toward):
    view = front_view(np.array([[0, 0, 0], extent], dtype=float))
    assert (view.right.argmax(), view.up.argmax()) == plane
    np.testing.assert_allclose(view.toward, toward)


def test_each_block_shows_one_face_and_edges_between_cells_of_one_unit_are_inner():
    blocks = wall()
    shown = outlines(blocks, front_view(blocks.points))
    assert len(shown.face) == blocks.count
    inner = int((~shown.outer).sum())
    whole_units = 6
    assert inner == 2 * whole_units, "one edge, seen from both cells, in every unit of two cells"


def test_crack_lines_cover_each_joint_once_and_lie_midway_between_its_sides():
    blocks = wall()
    joints = joints_of(blocks)
    frame = opened(blocks, joints, 1e-3, 1)
    view = front_view(blocks.points)
    lines = crack_lines(joints, frame, view)
    length = np.bincount(joints.patch[lines.contact], np.linalg.norm(lines.end - lines.start, axis=1))
    np.testing.assert_allclose(length * 0.05, np.bincount(joints.patch, joints.area), rtol=1e-9)
    broken = lines.select(lines.tension_led & (lines.damage > 0.5))
    ends = broken.displaced(joints, Deformation(BlockCorners(blocks), frame), 10.0)
    places = np.unique(np.round(ends[:, :, 0], 9))
    np.testing.assert_allclose(places, [LENGTH + 0.005, 1.5 * LENGTH + 0.005])
    assert ends[:, :, 2].max() == pytest.approx(4 * HEIGHT)


def test_a_joint_that_is_open_at_one_end_only_is_drawn_so():
    blocks = wall()
    joints = joints_of(blocks)
    frame = opened(blocks, joints, 1e-3, 1)
    low = joints.point[:, 2] % HEIGHT < HEIGHT / 2
    frame = dataclasses.replace(frame, damage_tension=np.where(low, frame.damage_tension, 0.0))
    lines = crack_lines(joints, frame, front_view(blocks.points))
    broken = lines.tension_led & (lines.damage > 0.5)
    np.testing.assert_allclose(np.linalg.norm((lines.end - lines.start)[broken], axis=1), HEIGHT / 2)


def test_a_crack_is_drawn_as_wide_as_it_is_open_and_the_key_says_what_width_is_what_opening():
    blocks = wall()
    joints = joints_of(blocks)
    lines = crack_lines(joints, opened(blocks, joints, 3.4e-4, 1), front_view(blocks.points))
    parted = lines.damage > 0.5
    np.testing.assert_allclose(lines.opening[parted], 3.4e-4)
    assert not lines.opening[~parted].any()
    scale = scale_of(lines.opening)
    assert scale == pytest.approx(4e-4)
    keys = {key.get_label(): key.get_linewidth() for key in crack_keys(scale, ["shear"])}
    np.testing.assert_allclose(widths(lines.opening[parted], scale), THIN + 0.85 * (THICK - THIN))
    thin, thick = keys["opened or slid 0.001 mm (less is not drawn)"], keys["opened or slid 0.4 mm"]
    assert (thin, thick) == (pytest.approx(THIN, rel=0.02), pytest.approx(THICK))
    assert keys["opened or slid 0.2 mm"] == pytest.approx(0.5 * (THIN + THICK))


def test_sliding_widens_a_crack_as_much_as_opening_and_pressing_together_does_not():
    blocks = wall()
    joints = joints_of(blocks)
    frame = opened(blocks, joints, 1e-4, 1)
    slid = dataclasses.replace(frame, slip=np.full(len(joints.area), 2e-4), opening=np.full(len(joints.area), -1e-3))
    np.testing.assert_allclose(crack_lines(joints, slid, front_view(blocks.points)).opening, 2e-4)


def test_where_nothing_opened_no_width_stands_for_an_opening():
    assert scale_of(np.zeros(3)) == scale_of(np.zeros(0)) == scale_of(np.full(3, 2e-18)) == 0.0
    np.testing.assert_allclose(widths(np.zeros(3), 0.0), THIN)


def test_the_key_lists_the_kinds_of_cracks_that_occur_and_no_others():
    led, none = np.array([True, True]), np.array([False, False])
    cracks = [SimpleNamespace(tension_led=words, dry=none, crushed=none) for words in (led, ~led)]
    assert kinds_of(cracks) == ["shear", "tension"] and kinds_of(cracks[:1]) == ["tension"]
    assert kinds_of([SimpleNamespace(tension_led=led, dry=led, crushed=none)]) == ["dry"]
    assert kinds_of([SimpleNamespace(tension_led=led, dry=led, crushed=led)]) == ["crushed"]
    assert kinds_of([]) == [] and crack_keys(0.0, []) == []
    assert [key.get_label() for key in crack_keys(0.0, ["shear"])] == ["crack, mostly shear"]
    sound, cracked = cracks_figure(sample(damaged=False)), cracks_figure(sample())
    assert len(cracked.axes) - len(sound.axes) == 2, "no bars of damage where there is none"


DRY = {"law": "brittle", "drive.displacement": "0.1 mm", "drive.accuracy": "5 %"} | {
    f"contact.unit_unit.{key}": value
    for key, value in (("cohesion", "0 Pa"), ("tensile_strength", "0 Pa"), ("tan_residual_friction_angle", 1.01))
}


def test_a_dry_joint_that_slid_is_drawn_as_wide_as_it_slid_and_an_elastic_one_is_not(tmp_path):
    slid = masonry.run(masonry.load("couplet", DRY))
    drawing = FlatDrawing(slid)
    frame = slid.history.frames[-1]
    assert not frame.damage.any()
    cracks = drawing.cracks(frame)
    assert cracks.dry.all() and kinds_of([cracks]) == ["dry"]
    np.testing.assert_allclose(cracks.opening, 0.1e-3, rtol=1e-3)
    length = np.linalg.norm(cracks.end - cracks.start, axis=1).sum()
    assert length == pytest.approx(0.2, rel=1e-12), "all of the joint"
    assert SolidDrawing(slid).cracks(frame).dry.all()
    stuck = min(slid.history.frames, key=lambda frame: abs(frame.slip.max() - 1e-6))
    elastic = dataclasses.replace(stuck, slip=np.abs(stuck.shear_stress) / 70e9, opening=stuck.normal_stress / 150e9)
    assert not len(drawing.cracks(elastic).damage)
    slid.scene_toml, slid.joint_properties = "title = 'nothing is known of its stiffness'", {}
    assert not len(FlatDrawing(slid).cracks(frame).damage)


def resting(**gauges):
    """The sample without a drive: its supports and weight only, and gauges."""
    result = sample()
    acts = {"on": "bottom", "force_n": [1e-14, 0.0, 134.2], "moment_nm": [0.0, 0.0, 0.0]}
    end = {"step": 1000, "displacement_m": 0.0, "support.0": acts, "gravity": {"force_n": [0.0, 0.0, -134.2]}}
    result.summary |= {"reactions": {"end": end}}
    rows = result.history.rows
    rows |= {"displacement": 0.0 * rows["step"], "stress": 0.0 * rows["step"], **gauges}
    return result


def test_without_a_drive_the_top_and_the_reactions_are_drawn_and_no_curve():
    result = resting()
    moved, ledger = result.plot().axes
    words = moved.get_title(loc="left").split("\n")
    assert words == ["reactions at the end, along x, y, z", "support.0 (bottom): 0, 0, 134.2 N"]
    top = result.specimen.blocks.points[:, 2] == result.specimen.blocks.points[:, 2].max()
    (line,) = moved.get_lines()
    assert line.get_label() == "top of the specimen, x"
    expected = [0.0, *(1e3 * frame.corners[top, 0].mean() for frame in result.history.frames)]
    np.testing.assert_allclose(line.get_ydata(), expected, rtol=1e-12)
    assert line.get_xdata().tolist() == [0.0, *(frame.step for frame in result.history.frames)]
    assert ledger.get_xlabel() == "step" and moved.get_ylabel() == "displacement [mm]"


def test_without_a_drive_gauges_take_the_place_of_the_top():
    sag = np.linspace(0.0, -2e-4, len(sample().history.rows["step"]))
    moved = resting(sag=sag).plot().axes[0]
    (line,) = moved.get_lines()
    assert line.get_label() == "sag"
    np.testing.assert_allclose(line.get_ydata(), 1e3 * sag, rtol=1e-12)


def test_without_a_drive_there_is_a_picture_of_the_end_alone_that_speaks_of_no_stress():
    result = resting()
    assert [(name, frame.step) for name, frame in frames_to_draw(result)] == [("at the end", 1000)]
    (title,) = [axes.get_title() for axes in result.picture().axes if axes.get_title()]
    assert title.startswith("at the end: step 1000\ndisplacements drawn ") and "stress" not in title


def test_joints_that_are_whole_look_closed_however_far_displacements_are_drawn():
    frame = sample().history.frames[-1]
    wide = magnification(frame, 1.0)
    strained = dataclasses.replace(
        frame,
        opening=np.full(len(frame.opening), 1e-4),
        normal_stress=np.full(len(frame.opening), 1e5),
        damage_tension=np.zeros(len(frame.opening)),
        damage_shear=np.zeros(len(frame.opening)),
    )
    assert magnification(strained, 1.0) * 1e-4 == pytest.approx(0.0025, rel=0.06)
    pressed = dataclasses.replace(strained, opening=-strained.opening, normal_stress=-strained.normal_stress)
    assert magnification(pressed, 1.0) == magnification(strained, 1.0) < wide
    cracked = dataclasses.replace(strained, damage_tension=np.full(len(frame.opening), 0.5))
    parted = dataclasses.replace(strained, normal_stress=0.0 * strained.normal_stress)
    assert magnification(cracked, 1.0) == magnification(parted, 1.0) == wide


def test_blocks_that_fell_are_drawn_where_they_lie_and_joints_that_parted_are_no_cracks():
    result = sample()
    frame = result.history.frames[-1]
    fallen = dataclasses.replace(frame, corners=frame.corners + [0.0, 0.0, -3.0])
    assert magnification(fallen, 0.5) == 1.0
    apart = np.zeros(len(frame.opening))
    apart[result.joints.patch == 0] = 2.0
    broken = dataclasses.replace(frame, opening=apart, damage_tension=np.ones_like(apart))
    shown = as_it_stands(result, broken)
    assert not shown.damage_tension[result.joints.patch == 0].any() and shown.opening.max() == 0.0
    assert np.all(shown.damage_tension[result.joints.patch != 0] == 1.0)

"""The thrust line in pictures: where it is drawn, where it goes, and where there is none."""

import dataclasses
from functools import cache

import numpy as np
import pytest

import masonry
from masonry.laboratory.result import Result
from masonry.pictures.crack_picture import cracks_figure
from masonry.pictures.front import FlatDrawing
from masonry.pictures.thrust_line import WALL, row_of
from masonry.results.dry_joints import as_it_stands
from tests.results.sample import opened, sample


@cache
def arch() -> Result:
    return masonry.run("arch")


def keys(result: Result) -> list[str]:
    return [text.get_text() for text in cracks_figure(result).legends[0].get_texts()]


def test_the_line_goes_through_the_places_of_the_resultants_in_order():
    drawing = FlatDrawing(arch())
    assert drawing.thrust is not None and drawing.thrust.in_a_row
    force, place = drawing.thrust.forces(arch(), arch().history.frames[-1])
    table = arch().resultants
    end = table["moment"] == "end"
    units = drawing.thrust.joints.units[drawing.thrust.order]
    ends = [(0, 15), *((k, k + 1) for k in range(14)), (14, 16)]
    assert [tuple(pair) for pair in units.tolist()] in (ends, ends[::-1])
    for pair, here, acts in zip(units, place, force, strict=True):
        (row,) = np.flatnonzero(end & (table["unit_a"] == pair[0]) & (table["unit_b"] == pair[1]))
        assert here == pytest.approx([table[f"place_{axis}"][row] for axis in "xyz"], rel=1e-9, abs=1e-12)
        assert acts == pytest.approx(table["normal_force"][row], rel=1e-9)
    assert keys(arch()).count("thrust line") == 1


def test_the_line_moves_with_the_joints():
    frame, thrust = arch().history.frames[-1], FlatDrawing(arch()).thrust
    shift = np.array([0.3e-3, 0.0, -0.1e-3])
    moved = dataclasses.replace(frame, corners=np.broadcast_to(shift, frame.corners.shape))
    assert np.allclose(
        thrust.displaced(arch(), moved, 10.0) - thrust.forces(arch(), frame)[1], 10.0 * shift, atol=1e-12
    )


def test_without_weight_or_with_too_few_joints_there_is_no_line():
    assert FlatDrawing(sample()).thrust is None
    couplet = masonry.load("couplet", {"gravity.z": "-9.81 m/s^2", "drive.displacement": "0.02 mm"})
    assert FlatDrawing(masonry.run(couplet)).thrust is None


def test_a_wall_under_its_weight_has_a_mark_on_each_joint_that_bears_and_no_line():
    wall = sample()
    wall.scene_toml += '[gravity]\nz = "-9.81 m/s^2"\n'
    thrust = FlatDrawing(wall).thrust
    assert thrust is not None and not thrust.in_a_row
    frame = opened(wall.specimen.blocks, wall.joints, 0.0, 1)
    beds = np.abs(wall.joints.normal[:, 2]) > 0.5
    pressed = dataclasses.replace(frame, normal_stress=np.where(beds, -1e5, 0.0))
    force, place = thrust.forces(wall, pressed)
    assert np.array_equal(np.isfinite(place[:, 0]), force < 0.0), "head joints bear nothing"
    assert np.abs(place[force < 0.0, 2] / 0.1 % 1.0).min() < 1e-9
    assert len(force) < WALL and not any("acts here" in key for key in keys(wall)), "nothing presses in its frames"
    wall.history.frames = [pressed]
    assert any("acts here" in key for key in keys(wall))


def test_units_are_a_row_where_each_has_two_neighbours_but_for_the_ends():
    assert row_of(np.array([[0, 1], [1, 2], [0, 3]])).tolist() in ([2, 0, 1], [1, 0, 2])
    assert row_of(np.array([[0, 1], [1, 2], [1, 3]])) is None, "a branch"
    assert row_of(np.array([[0, 1], [1, 2], [0, 2]])) is None, "a ring"
    assert row_of(np.array([[0, 1], [2, 3], [3, 4], [2, 4]])) is None, "a ring beside a pair"
    assert row_of(np.zeros((0, 2), dtype=int)) is None


def test_an_arch_is_seen_along_its_depth_however_deep_it_is():
    deep = masonry.run(masonry.load("arch", {"specimen.depth": "4 m"}))
    view = FlatDrawing(deep).camera
    assert (view.right.argmax(), view.up.argmax()) == (0, 2)


def test_dry_joints_have_no_scale_of_damage_but_say_whether_they_opened_or_slid():
    result = sample()
    keys = {text.get_text() for text in cracks_figure(result).legends[0].get_texts()}
    assert {"crack, mostly tension", "crack, mostly shear"} <= keys
    bars = len(cracks_figure(result).axes)
    result.summary |= {"law_by_group": {"unit_unit": "friction"}}
    result.joint_properties |= {"normal_stiffness": np.array([1e12]), "shear_stiffness": np.array([1e12])}
    figure = cracks_figure(result)
    labels = {text.get_text() for text in figure.legends[0].get_texts()}
    assert "joint, mostly opened" in labels and not labels & {"crack, mostly tension", "crack, mostly shear"}
    assert len(figure.axes) == bars - 2, "no bars of damage"


def test_dry_joints_are_drawn_where_they_are_open_or_slid_now_and_not_for_rounding():
    frame = arch().history.frames[-1]
    rounding = np.full_like(frame.damage_shear, 1.0)
    noisy = dataclasses.replace(frame, damage_shear=rounding, damage_tension=rounding)
    shown = as_it_stands(arch(), noisy)
    assert 0 < (shown.damage > 0.0).sum() < len(rounding)
    open_now = frame.opening > 0.01 * frame.opening.max()
    assert np.array_equal(shown.damage_tension > 0.0, open_now)
    other = sample().history.frames[-1]
    assert as_it_stands(sample(), other) is other, "other laws keep their damage"

"""The table [scatter]: what it may say, what it refuses, and what a user is told of what was drawn."""

import numpy as np
import pytest

from masonry import scene
from masonry.assembly.assemble import assemble
from masonry.errors import SceneError
from masonry.laboratory import laboratory
from masonry.laboratory.text import check_text

JOINTS = {
    "scatter.seed": 3,
    "scatter.unit_unit.tensile_strength": 0.3,
    "scatter.unit_unit.cohesion": 0.2,
    "scatter.unit_unit.correlation": 0.5,
}
WALL = {"specimen.divisions": [2, 1], **JOINTS}


def test_a_scene_with_scatter_comes_back_from_its_toml_as_it_was(tmp_path):
    loaded = scene.load("wallette-mode-1", WALL)
    file = tmp_path / "wallette-mode-1.toml"
    file.write_text(scene.to_toml(loaded), encoding="utf-8")
    assert scene.load(file) == loaded
    assert loaded.scatter.groups["unit_unit"].variations == {"tensile_strength": 0.3, "cohesion": 0.2}


def test_an_assumption_may_be_about_scatter(tmp_path):
    file = tmp_path / "own.toml"
    file.write_text(
        'base = "wallette-mode-1"\n[scatter.unit_unit]\ncohesion = 0.3\n'
        '[assumptions]\n"scatter.unit_unit.cohesion" = "of another wall"\n',
        encoding="utf-8",
    )
    assert "scatter.unit_unit.cohesion" in scene.load(file).assumptions


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"scatter.unit_unit.cohesion": -0.1}, "scatter.unit_unit.cohesion: -0.1 is out of range"),
        ({"scatter.unit_unit.correlation": 1.2}, "correlation must be in [0, 1]"),
        ({"scatter.unit_unt.cohesion": 0.1}, "did you mean 'unit_unit'"),
        ({"scatter.unit_unit.cohesoin": 0.1}, "did you mean 'cohesion'"),
        ({"scatter.plate.cohesion": 0.1}, "contact.plate.cohesion is not given or 0"),
        ({"scatter": {"seed": 1}}, "name a group"),
        ({"scatter": {"unit_unit": {"correlation": 0.5}}}, "names no property"),
        ({"scatter.unit_unit": 3}, "must be a table"),
    ],
)
def test_bad_scatter_is_refused_in_one_message(changes, said):
    with pytest.raises(SceneError) as error:
        scene.load("wallette-mode-1", {**JOINTS, **changes} if "scatter" not in changes else changes)
    assert said in str(error.value) and "\n" not in str(error.value)


def test_a_property_that_the_law_does_not_read_is_refused():
    bad = scene.load("wallette-mode-1", {"law": "brittle", "scatter.unit_unit.fracture_energy_mode_1": 0.3})
    with pytest.raises(SceneError, match=r"scatter\.unit_unit\.fracture_energy_mode_1: law 'brittle' does not read it"):
        assemble(bad)


def test_snap_back_is_refused_for_the_worst_draw_and_the_joint_is_named():
    """Linear law: G_I must be above fT^2/(2 kn), here for a strength that alone scatters."""
    changes = {
        "law": "linear",
        "contact.unit_unit.fracture_energy_mode_1": "0.04 N/m",
        "contact.unit_unit.cohesion": "5 MPa",
        "contact.unit_unit.fracture_energy_mode_2": "2000 N/m",
    }
    assemble(scene.load("wallette-mode-1", {**changes, "specimen.divisions": [2, 1]}))
    wide = {**changes, "specimen.divisions": [2, 1], "scatter.unit_unit.tensile_strength": 1.0}
    with pytest.raises(SceneError) as error:
        assemble(scene.load("wallette-mode-1", wide))
    drawn = assemble(scene.load("wallette-mode-1", {**wide, "law": "exponential"})).drawn[0]
    strength = drawn.values["tensile_strength"]
    worst = int(np.argmax(strength))
    a, b = drawn.pairs[worst]
    assert f"the joint of units {a} and {b} at (" in str(error.value)
    assert f"above {strength[worst] ** 2 / (2 * 167e9):.6g} N/m" in str(error.value)
    count = int(np.sum(strength**2 / (2 * 167e9) >= 0.04))
    assert f"{count} of {len(strength)} draws are refused" in str(error.value)


def test_a_residual_cohesion_above_a_drawn_cohesion_is_refused_and_the_joint_named():
    changes = {"contact.unit_unit.residual_cohesion": "0.1 MPa", "scatter.unit_unit.cohesion": 1.0}
    with pytest.raises(SceneError, match=r"residual_cohesion.* draws it for the joint of units \d+ and \d+ at \("):
        assemble(scene.load("wallette-mode-1", {"specimen.divisions": [2, 1], **changes}))


def test_a_joint_has_the_same_strength_however_its_units_are_divided():
    strengths = []
    for changes in ({"specimen.divisions": [2, 1]}, {"specimen.divisions": [8, 4]}, {"specimen.cells": {"total": 60}}):
        drawn = assemble(scene.load("wallette-mode-1", {**JOINTS, **changes})).drawn[0]
        strengths.append(dict(zip(map(tuple, drawn.pairs.tolist()), drawn.values["tensile_strength"], strict=True)))
    assert strengths[0] == strengths[1] == strengths[2] and len(strengths[0]) == 18


def test_scatter_of_one_group_leaves_the_draws_of_another():
    alone = assemble(scene.load("wallette-mode-1", WALL)).drawn
    both = assemble(scene.load("wallette-mode-1", {**WALL, "scatter.within_units.cohesion": 0.4})).drawn
    assert [d.group for d in alone] == ["unit_unit"] and [d.group for d in both] == ["unit_unit", "within_units"]
    assert all(np.array_equal(alone[0].values[key], both[0].values[key]) for key in alone[0].values)


def test_within_units_each_unit_draws_once():
    cut = {**WALL, "specimen.divisions": [4, 2], "scatter.within_units.cohesion": 0.4}
    drawn = assemble(scene.load("wallette-mode-1", cut)).drawn[1]
    assert drawn.pairs.tolist() == [[u, u] for u in range(10)]
    assert len(np.unique(drawn.values["cohesion"])) == 10


def test_check_says_what_was_drawn_and_without_scatter_that_it_is_left_out():
    report = laboratory.check(scene.load("wallette-mode-1", WALL))
    strength = assemble(scene.load("wallette-mode-1", WALL)).drawn[0].values["tensile_strength"] / 1e6
    line = f"{strength.min():.4g} to {strength.max():.4g} MPa, mean {strength.mean():.4g}, over 18 joints"
    assert f"unit_unit.tensile_strength: {line}" in report["scatter"]
    assert line in check_text(report) and not any("scatter" in words for words in report["left_out"])
    plain = laboratory.check(scene.load("wallette-mode-1", {"specimen.divisions": [2, 1]}))
    assert plain["scatter"] == [] and any(words.startswith("scatter:") for words in plain["left_out"])

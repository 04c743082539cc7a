"""A wall with two cracks that are alike, of which one opens."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from masonry import scene
from masonry.assembly.assemble import assemble
from masonry.judgement.sentence import note
from masonry.laboratory import laboratory
from masonry.laboratory.summary.symmetry import is_loaded_alike, symmetry_lost

SHORT = {"drive.displacement": "0.06 mm"}


@cache
def run(**changes):
    return laboratory.run(scene.load("wallette-mode-1", SHORT | changes))


def test_a_symmetric_wall_says_that_one_of_two_cracks_opened():
    result = run()
    assert result.summary["symmetry_lost"] == "x"
    assert "have left the symmetry of the specimen across x" in result.trust
    assert not result.trust.startswith("with care")


def test_a_symmetric_wall_whose_cracks_are_symmetric_says_nothing():
    cracks = run(**{"drive.displacement": "0.03 mm"})
    assert cracks.history.frames[-1].damage.max() > 0.3
    assert cracks.summary["symmetry_lost"] == ""


def test_a_wall_whose_strengths_scatter_decides_by_itself():
    strengths = {"scatter.unit_unit.tensile_strength": 0.3, "scatter.unit_unit.cohesion": 0.3}
    assert run(**strengths).summary["symmetry_lost"] == ""


def test_a_wall_that_is_not_symmetric_has_none_to_lose():
    result = run()
    joints = result.joints
    shifted = np.where(np.arange(len(joints.point)) == 0, 1e-3, 0.0)[:, None] * (1.0, 0.0, 0.0)
    assert symmetry_lost(joints, result.history.frames) == "x"
    assert symmetry_lost(replace(joints, point=joints.point + shifted), result.history.frames) == ""


SIDEWAYS = {"pattern": "weight", "direction": "x", "accuracy": 0.01}
LOADED = {
    "drawn apart along x": ("wallette-mode-1", {}, "xyz"),
    "weight along x": ("wallette-mode-1", {"gravity": {"x": "1 m/s^2"}}, "yz"),
    "a drive along x at the top": ("shear-wall", {}, "y"),
    "ground that tilts": ("wall-tilted", {}, "y"),
    "weight down": ("arch-own-weight", {}, "xy"),
    "weight sideways": ("arch", {"limit": SIDEWAYS}, "y"),
    "a push at the middle along y": (
        "arch-own-weight",
        {"limit": {"pattern": "force", "on": "keystone", "force": {"y": "1 kN"}, "accuracy": 0.01}},
        "x",
    ),
    "a push at the middle": (
        "arch-own-weight",
        {"limit": {"pattern": "force", "on": "keystone", "force": {"z": "-1 kN"}, "accuracy": 0.01}},
        "xy",
    ),
    "a push at one side": (
        "arch-own-weight",
        {"limit": {"pattern": "force", "on": "voussoir 6", "force": {"z": "-1 kN"}, "accuracy": 0.01}},
        "y",
    ),
    "a traction on one face": (
        "arch-own-weight",
        {"traction": [{"on": "voussoir 6.y+", "stress": {"z": "-1 kPa"}}]},
        "",
    ),
}


@pytest.mark.parametrize("name", LOADED)
def test_only_what_is_held_and_loaded_alike_on_both_sides_can_lose_its_symmetry(name):
    base, changes, axes = LOADED[name]
    assembly = assemble(scene.load(base, changes))
    assert "".join(axis for axis in "xyz" if is_loaded_alike(assembly, axis)) == axes


def test_a_symmetric_wall_that_is_pushed_to_one_side_has_no_symmetry_to_lose():
    result = run(**{"gravity.x": "0.01 m/s^2"})
    assert symmetry_lost(result.joints, result.history.frames) == "x", "one of two cracks opened here as well"
    assert result.summary["symmetry_lost"] == "" and "symmetry" not in result.trust


def test_where_a_factor_was_asked_for_nothing_is_said_of_what_is_dissipated():
    assert "have left the symmetry" in note({"symmetry_lost": "x"})
    assert note({"symmetry_lost": "x", "collapse_load": {"borne": 1.0, "falls": 1.01}}) == ""

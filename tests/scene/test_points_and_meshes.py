"""What a scene may say of contact points and of tets, and that it comes to what it says."""

import re

import numpy as np
import pytest

from masonry.assembly.assemble import assemble, joined
from masonry.errors import SceneError
from masonry.laboratory import laboratory
from masonry.scene import load, to_toml


@pytest.mark.parametrize(
    ("key", "value", "points"),
    [
        ("points_per_edge", 3, 9),
        ("points_per_edge", {"y": 10}, 20),
        ("points_per_edge", {"x": 5, "y": 1, "z": 7}, 5),
        ("points_per_face", 16, 16),
        ("contact_spacing", "1 m", 1),
        ("contact_spacing", "29.8 mm", 10 * 2),  # the middle two of ten Gauss points are 0.148874 of 200 mm apart
    ],
)
def test_a_joint_gets_the_points_that_the_scene_asks_for_and_the_written_scene_too(key, value, points, tmp_path):
    scene = load("couplet", {f"specimen.{key}": value})
    assert len(joined(scene)[1].area) == points
    (tmp_path / "again.toml").write_text(to_toml(scene), encoding="utf-8")
    assert load(tmp_path / "again.toml").specimen == scene.specimen


@pytest.mark.parametrize(
    ("overrides", "says"),
    [
        (["specimen.points_per_face=9", "specimen.points_per_edge=2"], "points_per_edge and points_per_face exclude"),
        (
            ["specimen.points_per_face=9", "specimen.contact_spacing=1 cm"],
            "points_per_face and contact_spacing exclude",
        ),
        (["specimen.points_per_edge={w=3}"], r"points_per_edge\.w: unknown key; allowed: x, y, z"),
        (["specimen.points_per_edge={y=0}"], "0 is out of range; y must be in"),
        (
            ["specimen.points_per_edge=[2, 10, 2]"],
            r"a table by axis such as \{x = 2, y = 10, z = 2\}; not \[2, 10, 2\]",
        ),
        (["specimen.points_per_edge=true"], "must be a whole number, or a table by axis"),
        (["specimen.contact_points=vertex", "specimen.points_per_edge={y=1}"], "must be 2 or more"),
        (["specimen.contact_points=vertex", "specimen.points_per_face=3"], "must be 4 or more"),
        (["specimen.contact_spacing=0 mm"], "out of range"),
        (["specimen.mesh=tetgen"], "'tetgen' is not allowed; allowed: gmsh, fan"),
    ],
)
def test_what_cannot_be_meant_is_refused_with_what_can(overrides, says):
    with pytest.raises(SceneError) as error:
        load("couplet", overrides)
    assert re.search(says, str(error.value))


def test_a_key_that_is_set_takes_the_place_of_the_other_two():
    scene = load("bending-0", ["specimen.points_per_face=4"])
    assert scene.specimen.points_per_edge is None and scene.specimen.points_per_face == 4


@pytest.mark.parametrize(
    "overrides",
    [{"specimen.points_per_face": 100000, "specimen.divisions": [100, 100, 10]}, {"specimen.contact_spacing": "1 um"}],
)
def test_more_points_than_a_machine_can_hold_are_refused_by_the_key_that_asks_for_them(overrides):
    with pytest.raises(SceneError, match=f"{next(iter(overrides))}.*contact points"):
        assemble(load("couplet", overrides))


def test_a_couplet_of_fans_slides_at_the_strength_of_its_joint_with_12_tets_in_each_box():
    scene = load(
        "couplet",
        {
            "kinematics": "tets",
            "specimen.mesh": "fan",
            "specimen.divisions": [2, 1, 1],
            "drive.steps": 8000,
            "settle.steps": 2000,
        },
    )
    assert len(assemble(scene).mesh.tets) == 4 * 12
    summary = laboratory.run(scene).summary
    assert summary["peak_stress_pa"] == pytest.approx(0.87e6 + 1.01 * 0.5e6, rel=0.02)
    assert abs(summary["energy_imbalance"]) < 1e-9


def test_a_fan_needs_no_mesh_size():
    text = to_toml(load("couplet", {"kinematics": "tets", "specimen.mesh": "fan"}))
    assert "mesh_size" in text
    scene = load(
        "couplet-meso-coarse",
        {
            "kinematics": {"default": "rigid", "mortar": "tets"},
            "specimen.mesh": "fan",
            "material.mortar.young_modulus": "5 GPa",
            "material.mortar.poisson_ratio": 0.2,
        },
    )
    assert scene.specimen.mesh == "fan"
    mesh = assemble(scene).mesh
    assert np.count_nonzero(np.diff(mesh.tet_start)) == 100


@pytest.mark.parametrize(
    ("name", "displacements"),
    [("couplet", "small"), ("couplet", "large"), ("wall-with-window", "large"), ("arch-tilted", "large")],
)
def test_a_scene_that_is_written_out_has_the_contact_points_of_the_one_that_ran(name, displacements, tmp_path):
    """Results are resumed, and run again, from the scene.toml that stands in them."""
    scene = load(name, {"displacements": displacements})
    (tmp_path / "scene.toml").write_text(to_toml(scene), encoding="utf-8")
    again = load(tmp_path / "scene.toml")
    kept = ("contact_points", "points_per_edge", "must_stand", "grows", "turns_back", "is_controlled")
    assert [getattr(again, key) for key in kept] == [getattr(scene, key) for key in kept]
    assert load("couplet").with_(displacements="large").points_per_edge == (4, 4, 4)
    assert scene.points_per_edge == 3 * (4 if displacements == "large" and scene.contact_points == "vertex" else 2,)


CRUSHES = {"contact.unit_unit.crushing": "cut-off", "contact.unit_unit.compressive_strength": "5 MPa"}


@pytest.mark.parametrize(
    ("changes", "points"),
    [
        ({}, (6, 2, 6)),
        ({"specimen.contact_points": "vertex"}, (10, 4, 10)),
        ({"limit.about": "x"}, (6, 6, 6)),
        ({"limit.about": "-x", "specimen.contact_points": "vertex"}, (10, 10, 10)),
        ({"gravity.y": "1 m/s^2"}, (6, 6, 6)),
        ({"traction": [{"on": "x+", "stress": {"x": "1 kPa"}}]}, (6, 2, 6)),
        ({"traction": [{"on": "y+", "stress": {"y": "1 kPa"}}]}, (6, 6, 6)),
        ({"specimen.points_per_edge": 3}, (3, 3, 3)),
        ({"specimen.cells.total": 10}, (2, 2, 2)),
    ],
)
def test_joints_that_crush_have_as_many_points_as_their_edge_needs(changes, points):
    assert load("wall-tilted").points_per_edge == (2, 2, 2)
    assert load("wall-tilted", {"specimen.contact_points": "gauss", **CRUSHES, **changes}).points_per_edge == points


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"specimen.patch_points_per_edge": 7}, "must be even, as points lie on lines from the middle of a patch"),
        ({"specimen.patch_points_per_edge": 42}, r"must be in \[2, 40\]"),
        ({"specimen.patch_points_per_edge": 8, "specimen.patch_points": "spread"}, "exclude each other"),
    ],
)
def test_points_of_patches_are_even_and_said_once(changes, words):
    with pytest.raises(SceneError, match=words):
        load("block-rocking", changes)


def test_patches_that_crush_have_ten_points_along_an_edge_unless_a_scene_says_otherwise():
    crushes = {key.replace("unit_unit", "floor_units"): value for key, value in CRUSHES.items()}
    assert len(assemble(load("block-rocking")).model.large.near.search.rounds) == 1
    assert len(assemble(load("block-rocking", crushes)).model.large.near.search.rounds) == 5
    chosen = {**crushes, "specimen.patch_points_per_edge": 20}
    assert len(assemble(load("block-rocking", chosen)).model.large.near.search.rounds) == 10
    corners = {**crushes, "specimen.patch_points": "corners"}
    assert len(assemble(load("block-rocking", corners)).model.large.near.search.rounds) == 1

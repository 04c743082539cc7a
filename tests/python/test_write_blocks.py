"""Blocks handed over from Python: a file that a scene names, with the numbers of the same blocks built by a scene."""

import signal
from types import SimpleNamespace

import numpy as np
import pytest

import masonry
from geometry.blocks import GeometryError
from geometry.files.blocks_h5 import load_blocks, save_blocks
from geometry.joints.find import find_joints
from geometry.meshes.fan import mesh_by_fans
from masonry.cli.main import main
from masonry.errors import SceneError
from tests.faults.samples import ALWAYS, ended_after, resume
from tests.geometry.specimens.test_from_arrays import CUBE, QUADS

SIZE = np.array([0.25, 0.12, 0.06])


def unit(k, gap=0.0):
    return (CUBE + [0, 0, k]) * SIZE + [0, 0, gap * k], QUADS


@pytest.fixture
def triplet(tmp_path):
    return masonry.write_blocks(
        tmp_path / "own.blocks.h5", [unit(k) for k in range(3)], names=["bottom", "unit 2", "top"]
    )


def on(path, **more):
    return masonry.load("triplet-dry", {"specimen": {"kind": "file", "path": str(path)}} | more)


def test_a_triplet_of_arrays_slides_as_the_packaged_one(triplet):
    own, packaged = masonry.run(on(triplet)), masonry.run("triplet-dry")
    assert own.specimen.section == pytest.approx(0.25 * 0.12, rel=1e-15)
    assert own.summary["peak_force_n"] == pytest.approx(packaged.summary["peak_force_n"], rel=1e-9)
    assert own.energies["friction"] == pytest.approx(packaged.energies["friction"], rel=1e-9)


def test_a_saved_result_finds_its_blocks_again(triplet, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    result = masonry.run(on(triplet.name, **{"drive.displacement": "0.01 mm"}))
    result.save("there/out")
    monkeypatch.chdir("there")
    again = masonry.run(masonry.load("out/scene.toml"))
    assert np.array_equal(again.history.rows["force"], result.history.rows["force"])


def test_a_run_of_such_blocks_goes_on_where_it_was_ended_with_the_same_bits(triplet, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    words = ["--set", f"specimen={{kind = 'file', path = '{triplet.name}'}}", "--quiet", *ALWAYS]
    assert main(["run", "triplet-dry", *words, "--out", "whole"]) == 0
    with ended_after(10, signal.SIGINT, monkeypatch):
        assert main(["run", "triplet-dry", *words, "--out", "parts"]) == 130
    assert resume(tmp_path / "parts") == 0
    rows = [masonry.load_result(tmp_path / name).history.rows["force"] for name in ("whole", "parts")]
    assert np.array_equal(*rows)


def test_a_run_does_not_go_on_with_other_blocks(triplet, tmp_path, monkeypatch, capsys):
    out = tmp_path / "parts"
    words = ["--set", f"specimen={{kind = 'file', path = '{triplet}'}}", "--quiet", *ALWAYS]
    with ended_after(10, signal.SIGINT, monkeypatch):
        assert main(["run", "triplet-dry", *words, "--out", str(out)]) == 130
    names = ["bottom", "unit 2", "top"]
    masonry.write_blocks(triplet, [(points * 2, faces) for points, faces in map(unit, range(3))], names=names)
    assert resume(out) == 2
    assert "file of blocks" in capsys.readouterr().err


def test_meshes_of_trimesh_and_of_compas_are_taken_as_they_are(tmp_path):
    points, faces = unit(0)
    triangles = np.array([[f[0], f[k], f[k + 1]] for f in faces for k in (1, 2)])
    like_trimesh = SimpleNamespace(vertices=points, faces=triangles)
    like_compas = SimpleNamespace(to_vertices_and_faces=lambda: unit(1))
    path = masonry.write_blocks(tmp_path / "two.blocks.h5", [like_trimesh, like_compas], groups=["stone", "units"])
    specimen, _ = load_blocks(path)
    assert specimen.blocks.count == 2 and specimen.blocks.groups == ("stone", "units")
    assert specimen.blocks.unit.tolist() == [0, 1]
    assert {name: found.tolist() for name, found in specimen.sets.items()} == {
        "all": [0, 1],
        "bottom": [0],
        "top": [1],
        "stone": [0],
        "units": [1],
    }


def test_blocks_share_units_names_and_a_section(tmp_path):
    path = masonry.write_blocks(
        tmp_path / "a.blocks.h5",
        [unit(k) for k in range(3)],
        names=["half", "half", ""],
        units=np.array([5, 5, 6]),
        section="0.06 m^2",
    )
    specimen, _ = load_blocks(path)
    assert specimen.section == 0.06 and specimen.sets["half"].tolist() == [0, 1]
    scene = on(path, support=[{"on": "bottom", "fix": "all"}], traction=[{"on": "top.z+", "stress": {"z": "-1 kPa"}}])
    scene = scene.with_({"drive.on": "top", "contact.within_units": {"law": "elastic", **STIFF}})
    assert set(masonry.check(scene)["contacts"]) == {"unit_unit", "within_units"}


STIFF = {"normal_stiffness": "100 GPa/m", "shear_stiffness": "40 GPa/m"}


def test_small_gaps_are_mended_and_larger_ones_refused(tmp_path):
    path = masonry.write_blocks(tmp_path / "a.blocks.h5", [unit(k, gap=5e-5) for k in range(3)])
    assert len(masonry.run(on(path, **NAMED)).joints.patch_start) - 1 == 2
    with pytest.raises(GeometryError, match=r"2 gaps .*tried: tolerance = .0\.51 mm. mends them, or open_gaps = True"):
        masonry.write_blocks(tmp_path / "b.blocks.h5", [unit(k, gap=5e-4) for k in range(3)])
    assert not (tmp_path / "b.blocks.h5").exists()


NAMED = {
    "support": [{"on": "bottom", "fix": "all"}],
    "drive.on": "top",
    "drive.displacement": "0.01 mm",
}

BAD = {
    "name": ({}, "own.h5", SceneError, r"the name of a file of blocks ends in \.blocks\.h5"),
    "names": ({"names": ["a"]}, "o.blocks.h5", SceneError, "names: one for each of the 2 blocks, not 1"),
    "names as a text": (
        {"names": "ab"},
        "o.blocks.h5",
        SceneError,
        "names: one for each of the 2 blocks, not one text",
    ),
    "groups": ({"groups": ["a", 3]}, "o.blocks.h5", SceneError, "groups: block 1 has 3, for example 'units'"),
    "empty group": ({"groups": ["a", ""]}, "o.blocks.h5", SceneError, "groups: block 1 has ''"),
    "units": ({"units": [0, 1.5]}, "o.blocks.h5", SceneError, "units: block 1 has 1.5"),
    "negative unit": ({"units": [0, -1]}, "o.blocks.h5", SceneError, "units: -1 is no number of a unit"),
    "unit beyond all": ({"units": [0, 10**30]}, "o.blocks.h5", SceneError, "is no number of a unit; allowed: 0 to 10"),
    "name of the group of both": (
        {"names": ["units", "a"]},
        "o.blocks.h5",
        SceneError,
        "'units' is the set of 2 blocks",
    ),
    "name of all": ({"names": ["", "all"]}, "o.blocks.h5", SceneError, "'all' is the set of 2 .* be block 1 besides"),
    "name of the other end": ({"names": ["top", ""]}, "o.blocks.h5", SceneError, "'top' is the set of 1 blocks"),
    "section": ({"section": "3 m"}, "o.blocks.h5", SceneError, "section"),
    "tolerance": ({"tolerance": "1 kg"}, "o.blocks.h5", SceneError, "tolerance"),
    "folder": ({}, "none/o.blocks.h5", GeometryError, "cannot write"),
}


@pytest.mark.parametrize(("more", "name", "error", "message"), BAD.values(), ids=BAD)
def test_bad_input_is_refused_and_nothing_is_written(more, name, error, message, tmp_path):
    with pytest.raises(error, match=message):
        masonry.write_blocks(tmp_path / name, [unit(0), unit(1)], **more)
    assert not list(tmp_path.iterdir())


def test_blocks_that_overlap_or_are_none_at_all_are_refused_by_name(tmp_path):
    with pytest.raises(GeometryError, match=r"'a \(block 0\)' and 'b \(block 1\)'"):
        masonry.write_blocks(tmp_path / "o.blocks.h5", [unit(0), unit(0.5)], names=["a", "b"])
    with pytest.raises(GeometryError, match="block 1 must be a pair of vertices and faces"):
        masonry.write_blocks(tmp_path / "o.blocks.h5", [unit(0), None])
    with pytest.raises(GeometryError, match="there are no blocks"):
        masonry.write_blocks(tmp_path / "o.blocks.h5", [])
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("cut", [{"divisions": [2, 1, 2]}, {"cells": {"per_unit": 3}}, {"mesh": "fan"}], ids=str)
def test_units_that_are_cut_up_slide_at_the_same_force(triplet, cut):
    affine = {"material.units.young_modulus": "5 GPa", "material.units.poisson_ratio": 0.2} if "mesh" in cut else {}
    scene = on(triplet).with_({f"specimen.{key}": value for key, value in cut.items()} | affine)
    if affine:
        scene = scene.with_({"kinematics": "tets", "specimen.divisions": [2, 1, 1]})
    scene = scene.with_({"contact.within_units": {"law": "elastic", **STIFF}, "drive.displacement": "0.2 mm"})
    result = masonry.run(scene)
    assert result.specimen.blocks.count > 3
    assert result.history.rows["force"][-1] == pytest.approx(2 * 0.65 * 0.5e6 * 0.25 * 0.12, rel=1e-3)


def test_a_division_into_too_much_is_refused_before_it_is_made(triplet):
    with pytest.raises(SceneError, match=r"specimen\.divisions: this would make about .* blocks"):
        masonry.check(on(triplet).with_({"specimen.divisions": [1000, 1000, 1]}))
    with pytest.raises(SceneError, match="divisions and cells exclude each other"):
        both = {"kind": "file", "path": str(triplet), "divisions": [2, 1, 1], "cells": {"total": 9}}
        masonry.load("triplet-dry", {"specimen": both})


def test_tets_of_a_file_do_not_serve_units_that_are_cut_up(triplet):
    specimen, _ = load_blocks(triplet)
    mesh, _ = mesh_by_fans(specimen.blocks, np.ones(3, dtype=bool), find_joints(specimen.blocks))
    save_blocks(triplet, specimen, mesh)
    tets = {"kinematics": "tets", "material.units.young_modulus": "5 GPa", "material.units.poisson_ratio": 0.2}
    whole = on(triplet, **tets, **{"contact.within_units": {"law": "elastic", **STIFF}})
    assert masonry.check(whole)["tets"] == len(mesh.tets) == 3 * 12
    cut = whole.with_({"specimen.divisions": [2, 1, 1], "specimen.mesh": "fan"})
    assert masonry.check(cut)["tets"] == 2 * 3 * 12


@pytest.mark.parametrize("seed", range(4))
def test_bricks_in_single_precision_are_taken_with_their_joint(tmp_path, seed):
    from scipy.spatial.transform import Rotation

    turn = Rotation.random(random_state=seed)
    bricks = [(turn.apply(corners).astype(np.float32).astype(float), faces) for corners, faces in map(unit, range(2))]
    blocks = load_blocks(masonry.write_blocks(tmp_path / "own.blocks.h5", bricks))[0].blocks
    assert find_joints(blocks).area.sum() == pytest.approx(0.25 * 0.12, rel=1e-5)
    bent = bricks[0][0].copy()
    bent[0] += 1e-3
    with pytest.raises(GeometryError, match="not flat"):
        masonry.write_blocks(tmp_path / "bent.blocks.h5", [(bent, QUADS)])

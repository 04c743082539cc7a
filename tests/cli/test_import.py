"""`masonry import`: from a CAD file to a scene that is checked and run."""

import time

import numpy as np
import pytest

from geometry.files.blocks_h5 import load_blocks
from geometry.joints.find import find_joints
from geometry.polyhedra.measures import volumes
from masonry.cli.main import main
from masonry.judgement.sentence import trust
from masonry.laboratory import laboratory
from masonry.scene import load
from masonry.scene.schema import INVENTED
from tests.geometry.files import step_files as files


def imported(path, out, *words):
    assert main(["import", str(path), "--out", str(out), *words]) == 0
    return load_blocks(out.with_name(out.stem + ".blocks.h5"))[0]


def complaint(capsys, *words):
    assert main(["import", *map(str, words)]) == 2
    said = capsys.readouterr().err
    assert said.startswith("masonry: ") and said.count("\n") == 1 and "Traceback" not in said
    return said


def run_100_steps(out):
    scene = load(out, {"drive.steps": 100, "solver.rows": 2})
    report = laboratory.check(scene)
    return report, laboratory.run(scene).summary


@pytest.fixture(scope="module")
def wall(tmp_path_factory):
    path = tmp_path_factory.mktemp("step") / "wall.step"
    grey = {f"brick-2-{i}": (0.5, 0.5, 0.5) for i in range(4)}
    return files.write_step(path, files.wall(4, 3), files.wall_names(4, 3), grey)


def test_a_wall_is_imported_checked_and_run(wall, tmp_path, capsys):
    out = tmp_path / "wall.toml"
    specimen = imported(wall, out)
    said = capsys.readouterr().out
    assert "units: 12 blocks" in said and "no gaps and no overlaps" in said and "wall.blocks.h5" in said
    assert specimen.sets["brick-1-2"].tolist() == [6]
    assert specimen.sets["bottom"].tolist() == [0, 1, 2, 3] and specimen.sets["top"].tolist() == [8, 9, 10, 11]
    assert len(specimen.sets["all"]) == len(specimen.sets["units"]) == 12
    assert specimen.section == pytest.approx(4 * 0.25 * 0.12, rel=1e-12)
    assert len(np.unique(specimen.blocks.unit)) == 12
    report, summary = run_100_steps(out)
    assert report["blocks"] == 12 and list(report["contacts"]) == ["unit_unit"]
    assert summary["steps"] == 100 and abs(summary["energy_imbalance"]) < 1e-9
    assert set(load(out).assumptions) >= {"material.units", "contact.unit_unit", "law", "support", "drive"}
    made_up = "made up: material.units, contact.unit_unit, law, support, drive; put in your own"
    assert made_up in summary["doubts"][0]["sentence"] + "; " + summary["doubts"][0]["advice"]
    assert any(made_up in line for line in report["warnings"])
    own = out.read_text().replace(INVENTED, "measured by us")
    out.write_text(own)
    assert "made up" not in trust(run_100_steps(out)[1])


def test_groups_by_name_and_by_colour_make_materials_and_contacts(wall, tmp_path, capsys):
    out = tmp_path / "wall.toml"
    imported(wall, out, "--group", "brick-1-*=mortar", "--group", "#808080=plates", "--section", "0.1 m^2")
    assert "mortar: 4 blocks" in capsys.readouterr().out
    report, _ = run_100_steps(out)
    assert set(report["contacts"]) == {"unit_mortar", "unit_unit", "mortar_mortar", "plate"}
    assert load(out).specimen.section is not None
    assert laboratory.assemble(load(out)).specimen.section == 0.1


@pytest.mark.parametrize(
    ("name", "build", "names", "area", "words"),
    [
        ("gaps", files.wall(4, 3, 0.05), files.wall_names(4, 3), files.wall_joint_area(4, 3), {"rel": 1e-4}),
        ("overlaps", files.wall(4, 3, -0.05), files.wall_names(4, 3), files.wall_joint_area(4, 3), {"rel": 1e-4}),
        ("arch", files.arch(11), [f"v{k}" for k in range(11)], 10 * 0.25 * 0.2, {"rel": 1e-6}),
    ],
)
def test_gaps_overlaps_and_an_arch_run(tmp_path, name, build, names, area, words):
    path = files.write_step(tmp_path / f"{name}.step", build, names)
    specimen = imported(path, tmp_path / "out.toml")
    assert find_joints(specimen.blocks).area.sum() == pytest.approx(area, **words)
    _, summary = run_100_steps(tmp_path / "out.toml")
    assert summary["steps"] == 100


def test_a_wall_in_inches_runs(tmp_path):
    path = files.write_step(tmp_path / "in.step", files.wall(3, 3, 0, 0.04), files.wall_names(3, 3), inch=True)
    specimen = imported(path, tmp_path / "out.toml")
    area = files.wall_joint_area(3, 3, 0.04 * 0.0254)
    assert find_joints(specimen.blocks).area.sum() == pytest.approx(area, rel=1e-6)
    assert run_100_steps(tmp_path / "out.toml")[1]["steps"] == 100


def test_perforated_units_run(tmp_path):
    path = files.write_step(tmp_path / "perforated.step", files.perforated(3), ["a", "b", "c"])
    specimen = imported(path, tmp_path / "out.toml")
    holes = 2 * 0.04**2 + np.pi * 0.015**2
    assert find_joints(specimen.blocks).area.sum() == pytest.approx(2 * (0.25 * 0.12 - holes), rel=1e-3)
    assert find_joints(specimen.blocks).area.sum() == pytest.approx(2 * volumes(specimen.blocks)[0] / 0.06, rel=1e-6)
    assert run_100_steps(tmp_path / "out.toml")[1]["steps"] == 100


def test_supports_and_drives_by_plane_are_those_of_the_sets(wall, tmp_path):
    out = tmp_path / "wall.toml"
    imported(wall, out)
    by_set = run_100_steps(out)[1]
    text = out.read_text()
    out.write_text(
        text.replace('on = "bottom"', 'on = "blocks at z = 0 mm"').replace('"top"', '"blocks at z = 180 mm"')
    )
    by_plane = run_100_steps(out)[1]
    for key in ("peak_stress_pa", "final_stress_pa", "energy_imbalance"):
        assert by_plane[key] == by_set[key]


def test_a_scene_finds_its_blocks_from_any_folder_and_says_when_they_are_gone(wall, tmp_path, monkeypatch, capsys):
    out = tmp_path / "wall.toml"
    imported(wall, out)
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    monkeypatch.chdir(elsewhere)
    assert main(["check", "../wall.toml"]) == 0
    on_top = elsewhere / "other.toml"
    on_top.write_text('base = "../wall.toml"\ntitle = "other"\n')
    assert main(["check", str(on_top)]) == 0
    (tmp_path / "wall.blocks.h5").unlink()
    capsys.readouterr()
    assert main(["check", "../wall.toml"]) == 2
    assert "masonry import" in capsys.readouterr().err


def test_a_single_pillar_gets_weight_instead_of_a_press(tmp_path):
    specimen = imported(files.write_step(tmp_path / "one.step", files.wall(1, 1), ["pillar"]), tmp_path / "one.toml")
    assert specimen.sets["pillar"].tolist() == [0]
    scene = load(tmp_path / "one.toml")
    assert scene.drive is None and scene.gravity.z == -9.81


def test_wrong_words_end_in_one_message(wall, tmp_path, capsys):
    out = tmp_path / "wall.toml"
    assert "no solid has such a name or colour" in complaint(capsys, wall, "--out", out, "--group", "stone*=units")
    assert "PATTERN=GROUP" in complaint(capsys, wall, "--out", out, "--group", "stone")
    assert ".step" in complaint(capsys, tmp_path / "wall.dwg", "--out", out)
    assert "exist" in complaint(capsys, tmp_path / "none.step", "--out", out)
    assert "folder" in complaint(capsys, wall, "--out", tmp_path / "none" / "wall.toml")
    assert ".toml" in complaint(capsys, wall, "--out", tmp_path / "wall.step")
    assert "--tolerance" in complaint(capsys, wall, "--out", out, "--tolerance", "1 kg")
    assert list(tmp_path.iterdir()) == []
    imported(wall, out)
    assert "--overwrite" in complaint(capsys, wall, "--out", out)
    imported(wall, out, "--overwrite")


def test_names_that_the_system_or_the_scene_cannot_hold_leave_nothing_behind(wall, tmp_path, capsys):
    loop = tmp_path / "loop.step"
    loop.symlink_to("loop.step")
    assert "cannot be read" in complaint(capsys, loop, "--out", tmp_path / "out.toml")
    assert "UTF-8" in complaint(capsys, wall, "--out", tmp_path / "a\udcff.toml")
    assert "at most 200" in complaint(capsys, wall, "--out", tmp_path / f"{201 * 'x'}.toml")
    assert ".toml" in complaint(capsys, wall, "--out", "")
    assert "no dot" in complaint(capsys, wall, "--out", tmp_path / "out.toml", "--group", "*=\x1b[2J")
    (tmp_path / "out.toml").mkdir()
    assert "is a folder" in complaint(capsys, wall, "--out", tmp_path / "out.toml", "--overwrite")
    assert "--unit" in complaint(capsys, wall, "--out", tmp_path / "small.toml", "--unit", "1e-9 m")
    brep = files.write_step(tmp_path.parent / "far.step", files.wall(1, 1, 0, 1e9), [])
    assert "from the origin" in complaint(capsys, brep, "--out", tmp_path / "far.toml", "--unit", "1000 m")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["loop.step", "out.toml"]


@pytest.mark.parametrize("group", ["stone", "units", "mortar", "plates"])
def test_a_lone_block_of_any_group_makes_a_scene_that_can_be_checked(tmp_path, group):
    path = files.write_step(tmp_path / "one.step", files.wall(1, 1), ["pillar"])
    imported(path, tmp_path / "one.toml", "--group", f"*={group}")
    assert main(["check", str(tmp_path / "one.toml")]) == 0


@pytest.mark.parametrize("suffix", [".step", ".tess", ".msh", ".vtu", ".brep", ".iges"])
def test_torn_empty_and_hostile_files_end_in_one_message(tmp_path, capsys, suffix):
    contents = {
        "empty": b"",
        "noise": np.random.default_rng(2).bytes(50_000),
        "zeros": bytes(1_000_000),
        "text": b"hello world " * 1000,
        "mesh": b"$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 999999999999 1 999999999999\n",
        "tess": b"***tess\n **format\n   3.4\n **general\n   3 standard\n **cell\n  99999999999\n",
        "xml": b'<?xml version="1.0"?><!DOCTYPE a [<!ENTITY b "c">]><VTKFile type="UnstructuredGrid">&b;</VTKFile>',
        "step": b"ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\n#1=CARTESIAN_POINT('',(0.,0.,0.));\n",
    }
    for name, content in contents.items():
        path = tmp_path / f"{name}{suffix}"
        path.write_bytes(content)
        complaint(capsys, path, "--out", tmp_path / "out.toml")
    huge = tmp_path / f"huge{suffix}"
    huge.write_bytes(b"x")
    with huge.open("r+b") as stream:
        stream.truncate(600_000_000)
    assert "at most" in complaint(capsys, huge, "--out", tmp_path / "out.toml")


@pytest.mark.slow
def test_a_thousand_units_take_ten_times_as_long_as_a_hundred(tmp_path):
    seconds = {}
    for columns, courses in ((15, 7), (32, 16), (34, 30)):
        names = files.wall_names(columns, courses)
        path = files.write_step(tmp_path / "wall.step", files.wall(columns, courses), names)
        begin = time.process_time(), time.perf_counter()
        specimen = imported(path, tmp_path / "wall.toml", "--overwrite")
        seconds[columns * courses] = time.perf_counter() - begin[1]
        assert specimen.blocks.count == columns * courses
        assert specimen.sets[names[-1]].tolist() == [columns * courses - 1]
        area = files.wall_joint_area(columns, courses)
        assert find_joints(specimen.blocks).area.sum() == pytest.approx(area, rel=1e-6)
        assert run_100_steps(tmp_path / "wall.toml")[1]["steps"] == 100
    print(seconds)
    assert seconds[1020] < 3 * 1020 / 512 * seconds[512]

"""A mesh file from import to results: its own tets, on nodes where they match and between nodes where they do not."""

from pathlib import Path

import numpy as np
import pytest

from geometry.blocks import Specimen
from geometry.files.blocks_h5 import load_blocks
from geometry.files.export import export
from geometry.joints.find import find_joints
from geometry.meshes.fan_tets import gathered
from geometry.meshes.tetrahedralise import mesh_blocks
from geometry.specimens.boxes import boxes
from masonry import scene
from masonry.assembly.assemble import assemble
from masonry.cli.main import main
from masonry.laboratory import laboratory

HEIGHTS = (0.05, 0.06, 0.05)
ELASTIC = ["material.units.young_modulus=5 GPa", "material.units.poisson_ratio=0.2"]


def pier():
    levels = np.cumsum([0.0, *HEIGHTS])
    return boxes(
        [(f"u{k}", (0, 0, levels[k]), (0.2, 0.1, h), "units", k, (1, 1, 1)) for k, h in enumerate(HEIGHTS)], 0.02
    )


@pytest.fixture(params=["matched", "unmatched"])
def imported(request, tmp_path):
    specimen = pier()
    blocks = specimen.blocks
    if request.param == "matched":
        mesh, _ = mesh_blocks(blocks, np.ones(3, dtype=bool), 0.05, find_joints(blocks))
    else:
        far = find_joints(boxes([("far", (9, 9, 9), (1, 1, 1), "g", 0, (1, 1, 1))], 1.0).blocks)
        sizes = (0.05, 0.04, 0.06)
        mesh = gathered(3, {b: (mesh_blocks(blocks, np.arange(3) == b, sizes[b], far)[0], b) for b in range(3)})
    export(tmp_path / "pier.msh", Specimen(blocks), mesh)
    assert main(["import", str(tmp_path / "pier.msh"), "--out", str(tmp_path / "pier.toml")]) == 0
    return tmp_path / "pier.toml", request.param == "matched"


def test_an_imported_mesh_keeps_its_tets_and_runs_with_them(imported, tmp_path, capsys):
    path, matched = imported
    assembly = assemble(scene.load(path, ["kinematics=tets", *ELASTIC]))
    mesh = load_blocks(path.with_suffix("").with_suffix(".blocks.h5"))[1]
    assert np.array_equal(assembly.mesh.nodes, mesh.nodes)
    assert (assembly.joints.corner_a is None) == matched
    assert assembly.joints.area.sum() == pytest.approx(0.04, rel=1e-12)
    words = [word for change in ("kinematics=tets", "drive.steps=300", *ELASTIC) for word in ("--set", change)]
    assert main(["run", str(path), "--out", str(tmp_path / "r"), "--quiet", *words]) == 0
    assert main(["plot", str(tmp_path / "r")]) == 0


def test_both_meshes_take_the_same_stress(imported):
    path, _ = imported
    result = laboratory.run(scene.load(path, ["kinematics=tets", "drive.steps=3000", *ELASTIC]))
    assert result.summary["energy_imbalance"] < 1e-12
    again = laboratory.run(scene.load(path, ["drive.steps=3000", "kinematics=affine", *ELASTIC]))
    stress = [np.abs(r.history.rows["stress"]).max() for r in (result, again)]
    assert stress[0] == pytest.approx(stress[1], rel=0.1)


def test_a_file_without_tets_asks_for_a_mesh_size(tmp_path, capsys):
    export(tmp_path / "pier.step", pier())
    assert main(["import", str(tmp_path / "pier.step"), "--out", str(tmp_path / "pier.toml")]) == 0
    capsys.readouterr()
    words = [word for change in ("kinematics=tets", *ELASTIC) for word in ("--set", change)]
    assert main(["check", str(tmp_path / "pier.toml"), *words]) == 2
    assert "mesh_size" in capsys.readouterr().err


PLANE = Path(__file__).resolve().parents[1] / "geometry" / "files" / "plane.tess"


def test_a_plane_tessellation_is_imported_with_a_thickness(tmp_path, capsys):
    path, out = tmp_path / "cells.tess", tmp_path / "cells.toml"
    path.write_bytes(PLANE.read_bytes())
    assert main(["import", str(path), "--out", str(out)]) == 2
    assert "thickness" in capsys.readouterr().err
    assert main(["import", str(path), "--unit", "100 mm", "--thickness", "50 mm", "--out", str(out)]) == 0
    assembly = assemble(scene.load(out))
    assert assembly.joints.area.sum() == pytest.approx(0.05 * np.hypot(0.02, 0.1), rel=1e-12)

"""Blocks out to a file and in again by the command line: every volume and every joint as it was."""

import pytest

from geometry.files.blocks_h5 import load_blocks
from geometry.polyhedra.measures import volumes
from masonry import scene
from masonry.assembly.assemble import joined
from masonry.cli.main import main


@pytest.mark.parametrize("suffix", [".step", ".msh", ".vtu"])
@pytest.mark.parametrize("name", ["wallette-mode-1", "wallette-mode-1-218"])
def test_volumes_and_joints_come_back_to_a_billionth(tmp_path, suffix, name):
    path, out = tmp_path / f"wall{suffix}", tmp_path / "again.toml"
    assert main(["export", name, "--to", str(path)]) == 0
    assert main(["import", str(path), "--unit", "1 m", "--out", str(out)]) == 0
    specimen, joints = joined(scene.load(name))
    again, _ = load_blocks(tmp_path / "again.blocks.h5")
    _, joints_again = joined(scene.load(out))
    assert again.blocks.count == specimen.blocks.count
    assert volumes(again.blocks) == pytest.approx(volumes(specimen.blocks), rel=1e-9)
    assert joints_again.area.sum() == pytest.approx(joints.area.sum(), rel=1e-9)
    if suffix != ".vtu":
        named = [specimen.blocks.groups[g] for g in specimen.blocks.group]
        back = [again.blocks.groups[g] for g in again.blocks.group]
        assert suffix == ".step" or named == back


BAD = {
    ".tess": [b"", b"***tess\n", b"\x80\x04" * 999, b"***tess\n **format\n   3.4\n **general\n   3 standard\n***end\n"],
    ".msh": [
        b"",
        b"$MeshFormat\n4.1 0 8\n",
        b"\x80\x04" * 999,
        b"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n9999999999\n",
    ],
    ".vtu": [b"", b"<VTKFile", b"\x80\x04" * 999, b'<!DOCTYPE a [<!ENTITY b "c">]><VTKFile>&b;</VTKFile>'],
}


@pytest.mark.parametrize("suffix", BAD)
def test_bad_files_end_with_exit_code_2_and_one_line(tmp_path, capsys, suffix):
    for content in BAD[suffix]:
        path = tmp_path / f"bad{suffix}"
        path.write_bytes(content)
        assert main(["import", str(path), "--out", str(tmp_path / "bad.toml")]) == 2
        told = capsys.readouterr()
        assert told.err.count("\n") == 1
        assert told.out == ""
        assert [p.name for p in tmp_path.iterdir()] == [f"bad{suffix}"]

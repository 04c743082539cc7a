import pytest

from geometry.files.mesh_files import read_mesh
from masonry.cli.main import main


@pytest.mark.parametrize("suffix", [".step", ".msh", ".vtu"])
def test_export_writes_the_blocks_of_a_scene(tmp_path, capsys, suffix):
    path = tmp_path / f"wall{suffix}"
    assert main(["export", "couplet", "--to", str(path)]) == 0
    assert "blocks" in capsys.readouterr().out
    if suffix != ".step":
        assert read_mesh(path).blocks.count > 1


def test_export_to_an_unknown_kind_of_file_ends_with_exit_code_2(tmp_path, capsys):
    assert main(["export", "couplet", "--to", str(tmp_path / "wall.dxf")]) == 2
    assert capsys.readouterr().err.count("\n") == 1
    assert list(tmp_path.iterdir()) == []

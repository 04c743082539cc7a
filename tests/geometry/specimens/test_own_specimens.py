"""The tunnel of docs/own-laws.md, as an installed package: its shape, its table in a scene, what mistakes are told."""

import numpy as np
import pytest

from geometry.blocks import GeometryError
from geometry.polyhedra.measures import volumes
from masonry.assembly.assemble import joined
from masonry.cli.main import main
from masonry.errors import SceneError
from masonry.laboratory import laboratory
from masonry.scene import load, to_toml
from masonry.sweep.job import Job
from tests.laws.own_package import files_of_page, install, on_the_path

TUNNEL = files_of_page()["tunnel.py"]


@pytest.fixture
def package(tmp_path, monkeypatch):
    folder = install(tmp_path / "package")
    monkeypatch.chdir(folder)
    with on_the_path(folder):
        yield


def changed(tmp_path, old: str, new: str):
    """The package with its tunnel edited."""
    assert old in TUNNEL
    return on_the_path(install(tmp_path / "changed", files_of_page() | {"tunnel.py": TUNNEL.replace(old, new, 1)}))


def test_the_vault_has_the_volume_the_joints_and_the_sets_of_the_drawing(package):
    specimen, joints = joined(load("tunnel.toml", {"specimen.voussoirs": 9, "specimen.angle": "120 deg"}))
    one = 0.2 * 0.5 * np.sin(np.radians(120) / 9) * (1.075**2 - 0.925**2)
    np.testing.assert_allclose(volumes(specimen.blocks), one, rtol=1e-12)
    assert specimen.blocks.count == 11 and len(joints.patch_start) - 1 == 10
    assert joints.area.sum() == pytest.approx(10 * 0.15 * 0.2, rel=1e-12)
    crown = specimen.blocks.points[specimen.blocks.face_points].reshape(11, -1, 3)[5].mean(axis=0)
    assert crown[0] == pytest.approx(0.0, abs=1e-12) and specimen.sets["crown"].tolist() == [5]


def test_the_vault_is_checked_drawn_and_exported_by_the_commands(package, tmp_path, capsys):
    assert main(["check", "tunnel.toml"]) == 0
    assert "17 rigid blocks" in capsys.readouterr().out
    assert main(["picture", "tunnel.toml", "--geometry", "--out", str(tmp_path / "tunnel.png")]) == 0
    assert main(["export", "tunnel.toml", "--to", str(tmp_path / "tunnel.vtu")]) == 0
    assert (tmp_path / "tunnel.png").stat().st_size > 1e4


def test_the_vault_runs_and_its_springers_bear_what_the_haunch_is_pushed_with(package):
    result = laboratory.run(load("tunnel.toml"))
    assert abs(result.summary["energy_imbalance"]) < 1e-10
    assert result.summary["reaction_mismatch_max"] < 0.05
    assert result.summary["peak_stress_pa"] > 0 and result.summary["damaged_area_m2"]["unit_unit"] > 0
    assert "+" in result.summary["source_hash"]


def test_the_table_of_the_vault_has_units_and_defaults_and_survives_being_written(package, tmp_path):
    scene = load("tunnel.toml")
    assert scene.specimen.angle == np.pi and scene.specimen.thickness == pytest.approx(0.15, rel=1e-15)
    file = tmp_path / "written.toml"
    file.write_text(to_toml(scene), encoding="utf-8")
    assert load(file, {"name": "tunnel"}) == scene


@pytest.mark.parametrize(
    ("key", "value", "said"),
    [
        ("radius", "1 s", "s is a time; radius is a length"),
        ("radius", "-1 m", "radius must be in"),
        ("voussoirs", 1.5, "voussoirs is a whole number"),
        ("radios", "1 m", "unknown key; did you mean 'radius'?"),
        ("kind", "tunel", "'tunel' is not allowed; did you mean 'tunnel'? allowed: couplet, prism"),
    ],
)
def test_a_mistake_in_the_table_is_told_as_any_other(package, key, value, said):
    with pytest.raises(SceneError, match="specimen") as told:
        load("tunnel.toml", {f"specimen.{key}": value})
    assert said in str(told.value) and len(str(told.value).splitlines()) == 1


def test_a_parameter_that_is_missing_is_named_with_an_example(package):
    with pytest.raises(SceneError, match="specimen.radius: missing; radius is a length, for example '200 mm'"):
        load("couplet", {"specimen": {"kind": "tunnel", "thickness": "1 m", "width": "1 m"}})


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("radius: Length", "radius", "parameter 'radius' needs a kind of geometry"),
        ("radius: Length", "radius: complex", "parameter 'radius': .*complex.* is no kind of parameter"),
        ("width: Length", "mesh: Length", "parameter 'mesh' is a key of every specimen"),
        ("def tunnel(", "tunnel = 3\ndef bow(", "must name a function"),
        ("def tunnel(", "def bow(", "AttributeError"),
        ("import numpy", "import numbat", "No module named 'numbat'"),
    ],
)
def test_a_mistake_in_the_package_is_told_in_one_line_that_names_it(tmp_path, monkeypatch, old, new, said):
    with changed(tmp_path, old, new):
        with pytest.raises(SceneError, match=said) as told:
            load(tmp_path / "changed" / "tunnel.toml")
        assert "my-masonry 0.1" in str(told.value) and len(str(told.value).splitlines()) == 1
        load("couplet")


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("return Specimen(", "return dict(", "TypeError|not a geometry.blocks.Specimen"),
        ("    sets = {", "    1 / 0\n    sets = {", "ZeroDivisionError: division by zero"),
        ("np.array([count // 2])", "np.array([count])", "set 'crown' names blocks that do not exist"),
        ("section=width * thickness", "section=0.0", "it must be an area above 0"),
        ("inner[:-1], outer[:-1], outer[1:], inner[1:]", "inner[:-1], inner[1:], outer[1:], outer[:-1]", "look inward"),
    ],
)
def test_what_the_function_returns_is_looked_over(tmp_path, old, new, said):
    with changed(tmp_path, old, new), pytest.raises(GeometryError, match=said) as told:
        joined(load(tmp_path / "changed" / "tunnel.toml"))
    assert "specimen 'tunnel' of my-masonry 0.1" in str(told.value)


def test_blocks_that_overlap_are_refused(tmp_path):
    edit = "np.arange(-1, voussoirs + 2)", "1.2 * np.arange(-1, voussoirs + 2)"
    with changed(tmp_path, *edit), pytest.raises(GeometryError, match="overlap"):
        joined(load(tmp_path / "changed" / "tunnel.toml", {"specimen.angle": "355 deg"}))


def test_the_key_of_a_result_changes_with_the_source_of_its_specimen(package, tmp_path):
    before = Job("tunnel.toml").key()
    with changed(tmp_path, '"""A tunnel', '"""A round tunnel'):
        assert Job("tunnel.toml").key() != before

"""A result comes back as it was saved, its files are whole or absent, and nothing that is not finite is written."""

import csv
import json

import h5py
import numpy as np
import pytest

from masonry.errors import SceneError
from masonry.laboratory.result import load_result
from masonry.pictures import crack_picture as picture
from masonry.rows.columns import UNITS
from masonry.runtime.folder import claim
from masonry.runtime.folders.own_files import LIST
from tests.results.sample import sample, with_tets

FILES = {
    "summary.json",
    "curve.csv",
    "resultants.csv",
    "curve.png",
    "cracks.png",
    "fields.vtkhdf",
    "joints.vtkhdf",
    "history.h5",
    "scene.toml",
    "run.log",
}


def assert_same(a, b):
    for name, value in vars(a).items():
        other = getattr(b, name)
        if isinstance(value, np.ndarray):
            assert value.dtype == other.dtype, name
            np.testing.assert_array_equal(value, other, err_msg=name)
        else:
            assert value == other, name


@pytest.mark.parametrize("make", [sample, lambda: with_tets(sample())], ids=["faces", "tets"])
def test_a_result_comes_back_from_its_folder_bit_by_bit(tmp_path, make):
    saved = make()
    paths = saved.save(tmp_path / "deep" / "out")
    loaded = load_result(tmp_path / "deep" / "out")
    assert set(paths) == FILES and all(path.is_file() for path in paths.values())
    assert {path.name for path in (tmp_path / "deep" / "out").iterdir()} == {*FILES, LIST}
    assert loaded.summary == saved.summary and loaded.log == saved.log and loaded.scene_toml == saved.scene_toml
    assert loaded.joint_groups == saved.joint_groups and loaded.title == saved.title
    for name in UNITS:
        np.testing.assert_array_equal(loaded.history.rows[name], saved.history.rows[name])
    assert len(loaded.history.frames) == 3
    for one, other in zip(saved.history.frames, loaded.history.frames, strict=True):
        assert_same(one, other)
    assert_same(saved.specimen.blocks, loaded.specimen.blocks)
    assert_same(saved.joints, loaded.joints)
    np.testing.assert_array_equal(saved.specimen.sets["left plate"], loaded.specimen.sets["left plate"])
    assert (saved.mesh is None) == (loaded.mesh is None)
    if saved.mesh is not None:
        assert_same(saved.mesh, loaded.mesh)


def test_a_result_without_rows_frames_and_joints_is_saved_too(tmp_path):
    result = sample()
    result.history.rows, result.history.frames = {}, []
    result.save(tmp_path)
    assert load_result(tmp_path).history.frames == []


def test_every_column_of_the_curve_has_its_unit_and_its_full_precision(tmp_path):
    result = sample()
    result.save(tmp_path)
    with open(tmp_path / "curve.csv", newline="") as file:
        header, *lines = list(csv.reader(file))
    assert header[:2] == ["displacement [m]", "stress [Pa]"]
    assert sorted(header) == sorted(f"{name} [{unit}]" for name, unit in UNITS.items())
    for column, title in enumerate(header):
        written = np.array([float(line[column]) for line in lines])
        np.testing.assert_array_equal(written, result.history.rows[title.split(" [")[0]])


def test_every_row_of_the_history_file_has_its_unit(tmp_path):
    sample().save(tmp_path)
    with h5py.File(tmp_path / "history.h5") as file:
        assert {name: data.attrs["unit"] for name, data in file["rows"].items()} == UNITS


def test_a_failure_in_the_middle_leaves_no_file_and_no_rest(tmp_path, monkeypatch):
    monkeypatch.setattr("masonry.results.store.csv_text", lambda *rows: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        sample().save(tmp_path)
    assert list(tmp_path.iterdir()) == []


def test_a_picture_that_fails_costs_neither_the_numbers_nor_the_old_picture(tmp_path, monkeypatch):
    sample().save(tmp_path)
    old = (tmp_path / "cracks.png").read_bytes()
    monkeypatch.setattr(picture, "cracks_figure", lambda result: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        sample().save(tmp_path)
    assert (tmp_path / "cracks.png").read_bytes() == old
    assert load_result(tmp_path).summary["steps"] == 1000
    assert [path.name for path in tmp_path.iterdir() if path.name.startswith(".")] == [".masonry-files.json"]


def test_rows_and_frames_from_the_first_that_is_not_finite_are_dropped_and_logged(tmp_path):
    result = sample()
    result.history.rows["stress"][60] = np.nan
    result.history.rows["kinetic"][61:] = np.inf
    result.summary |= {"final_stress_pa": float("nan")}
    result.summary |= {"energy_j": {"kinetic": np.float64("inf")}}
    result.save(tmp_path)
    loaded = load_result(tmp_path)
    assert len(loaded.history.rows["stress"]) == 60
    assert [frame.step for frame in loaded.history.frames] == [0, 200]
    assert loaded.summary["final_stress_pa"] is None and loaded.summary["energy_j"]["kinetic"] is None
    log = (tmp_path / "run.log").read_text()
    assert "41 rows were dropped: from row 61 on, stress is not finite" in log
    assert "final_stress_pa" in log and "1 frames" in log
    assert len(result.history.rows["stress"]) == 101, "the result in memory is left as it was"


def test_the_summary_is_strict_json_with_numpy_numbers_as_numbers(tmp_path):
    result = sample()
    result.summary |= {"blocks": np.int64(18)}
    result.summary |= {"time_step_s": np.float64(1) / 3}
    result.save(tmp_path)
    summary = json.loads((tmp_path / "summary.json").read_text(), parse_constant=pytest.fail)
    assert summary["blocks"] == 18 and summary["time_step_s"] == 1 / 3


@pytest.mark.parametrize("name", ["summary.json", "history.h5"])
@pytest.mark.parametrize("damage", ["missing", "empty", "cut"])
def test_a_damaged_folder_is_refused_in_one_message(tmp_path, name, damage):
    sample().save(tmp_path)
    path = tmp_path / name
    content = path.read_bytes()
    path.unlink()
    if damage != "missing":
        path.write_bytes(b"" if damage == "empty" else content[: len(content) // 2])
    with pytest.raises(SceneError, match=name):
        load_result(tmp_path)


def test_a_history_file_without_a_part_is_refused(tmp_path):
    sample().save(tmp_path)
    with h5py.File(tmp_path / "history.h5", "a") as file:
        del file["joints/area"]
    with pytest.raises(SceneError, match="damaged"):
        load_result(tmp_path)
    with pytest.raises(SceneError, match="not a folder"):
        load_result(tmp_path / "nowhere")


def test_runs_of_one_scene_get_folders_of_their_own(tmp_path):
    names = [claim("my scenes/wall.toml", results=tmp_path / "results").name for _ in range(3)]
    assert names == ["wall-1", "wall-2", "wall-3"]
    assert claim("couplet", results=tmp_path / "results").name == "couplet-1"


def test_a_named_folder_is_refused_when_it_holds_something_unless_overwriting(tmp_path):
    assert claim("s", tmp_path / "new") == tmp_path / "new"
    (tmp_path / "new" / "thesis.tex").touch()
    with pytest.raises(SceneError, match="--overwrite"):
        claim("s", tmp_path / "new")
    assert claim("s", tmp_path / "new", overwrite=True) == tmp_path / "new"
    (tmp_path / "new" / "curve.csv").touch()
    with pytest.raises(SceneError, match="curve.csv' was not written by masonry"):
        claim("s", tmp_path / "new", overwrite=True)
    (tmp_path / "new" / "curve.csv").unlink()
    assert claim("s", tmp_path / "new", overwrite=True) == tmp_path / "new"
    with pytest.raises(SceneError, match="is a file"):
        claim("s", tmp_path / "new" / "thesis.tex", overwrite=True)
    with pytest.raises(SceneError, match="cannot write"):
        claim("s", tmp_path / "new" / "thesis.tex" / "out")

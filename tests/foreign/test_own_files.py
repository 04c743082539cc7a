"""What is not ours, is a link, or was changed since we wrote it is never replaced, whatever it is called."""

import json
from pathlib import Path

import pytest

from masonry.cli.main import main
from masonry.errors import SceneError
from masonry.runtime.folder import HOW_TO
from masonry.runtime.folders.own_files import LIST, NUMBERS, WRITTEN, ResultFiles, is_folder_of_runs, require_own
from masonry.runtime.lock import LOCK, sole
from masonry.sweeps.run_store import Store
from masonry.sweeps.work import RunEnd
from masonry.timeloop.checkpoint import Checkpoints
from tests.faults.samples import SHORT, resume, run
from tests.foreign.test_results_folders import are_whole, put
from tests.results.sample import sample

SWEEP = 'scene = "couplet"\n[settings]\n"settle.steps" = 100\n"drive.steps" = 600\n[grid]\nconfinement = ["0.1 MPa"]\n'


def commands(out: Path, *more: str) -> list[list[str]]:
    """Those that write into a folder of their own, told to write into this one."""
    (sweep := out.parent / "a.toml").write_text(SWEEP)
    return [
        ["run", "couplet", *SHORT, "--quiet", "--out", str(out), *more],
        ["limit", "arch-tilted", "--out", str(out), *more],
        ["modes", "arch-tilted", "--out", str(out), *more],
        ["sweep", str(sweep), "--quiet", "--workers", "0", "--out", str(out), *more],
        ["sensitivity", "couplet", *SHORT, "--only", "damping", "--quick", "--out", str(out), *more],
    ]


@pytest.mark.parametrize(
    "names", [WRITTEN, ("summary.json", "curve.csv"), ("sweep.toml", "sweep.csv"), ("limit.json",)]
)
def test_files_of_others_that_are_called_as_ours_stay_where_results_are_to_be_replaced(names, tmp_path, capsys):
    """A table of somebody's own is no sign that the rest is ours."""
    there = put(tmp_path / "out", *names, "runs/first/notes.txt")
    for name in ("summary.json", "limit.json", "modes.json", "sensitivity.json", "convergence.json"):
        if tmp_path / "out" / name in there:
            (tmp_path / "out" / name).write_text(text := json.dumps({"scene": "mine", "steps": 3, "accuracy": 0.9}))
            there[tmp_path / "out" / name] = text
    for words in commands(tmp_path / "out", "--overwrite"):
        assert main(words) == 2, words
        said = capsys.readouterr().err
        assert said.count("\n") == 1 and "was not written by masonry" in said
    assert are_whole(there) and len(list((tmp_path / "out").iterdir())) == len(names) + 1


def test_a_lock_of_another_program_stays_and_a_lock_of_ours_is_no_link(tmp_path, capsys):
    there = put(tmp_path / "out", ".lock")
    assert [run(tmp_path / "out"), run(tmp_path / "out", "--overwrite")] == [2, 0]
    for words in commands(tmp_path / "out", "--overwrite")[1:3]:
        assert main(words) == 0
    assert are_whole(there)
    there |= put(tmp_path, "thesis.txt") | put(tmp_path / "foreign", LOCK)
    (tmp_path / "linked").mkdir()
    (tmp_path / "linked" / LOCK).symlink_to(tmp_path / "thesis.txt")
    capsys.readouterr()
    for folder in ("foreign", "linked"):
        for words in commands(tmp_path / folder, "--overwrite"):
            assert main(words) == 2
            assert f"'{tmp_path / folder / LOCK}' is no lock of masonry" in capsys.readouterr().err
        with pytest.raises(SceneError, match="is no lock"), sole(tmp_path / folder, "tries"):
            pass
    assert are_whole(there)


def test_a_lock_that_an_earlier_version_left_is_in_nobodys_way(tmp_path):
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / ".lock").write_text("process 1 runs a scene into it (on node7, since 2026-03-01 10:12:00)")
    assert run(tmp_path / "out") == 0


def test_checkpoints_behind_a_link_are_neither_read_nor_deleted(tmp_path, capsys):
    """Whatever the folder behind it holds: here just what a run of ours would have left."""
    theirs = Checkpoints(tmp_path / "theirs")
    theirs.begin("name = 1\n", {"threads": 1})
    theirs.write({"a": 1})
    there = {path: path.read_bytes() for path in theirs.folder.iterdir()}
    left = put(theirs.folder, ".masonry-7-unfinished-a", "thesis.txt")
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "checkpoint").symlink_to(theirs.folder)
    for words in commands(tmp_path / "out"):
        assert main(words) == 2
    for words in commands(tmp_path / "out", "--overwrite"):
        assert main(words) == 2, words
    assert "is a link: move it" in capsys.readouterr().err
    assert resume(tmp_path / "out") == 2
    assert (tmp_path / "out" / "checkpoint").is_symlink() and are_whole(left)
    assert {path: path.read_bytes() for path in there} == there


def test_a_folder_called_checkpoint_is_ours_by_the_words_in_it(tmp_path, capsys):
    there = put(tmp_path / "out" / "checkpoint", HOW_TO, "scene.toml", "state-000001.npz")
    assert run(tmp_path / "out") == 2 and run(tmp_path / "out", "--overwrite") == 2
    assert "is no checkpoint of a run" in capsys.readouterr().err and are_whole(there)


@pytest.fixture
def results(tmp_path) -> Path:
    """A folder of results, with pictures."""
    sample().save(tmp_path / "results")
    return tmp_path / "results"


@pytest.mark.parametrize("form", ["png", "svg"])
def test_plot_replaces_the_pictures_that_it_drew_and_no_others(form, results, tmp_path, capsys):
    assert main(["plot", str(results), "--format", form]) == 0
    assert main(["plot", str(results), "--format", form]) == 0
    (results / f"cracks.{form}").rename(behind := tmp_path / f"cracks.{form}")
    (results / f"cracks.{form}").symlink_to(behind)
    (results / f"curve.{form}").write_text("mine")
    before = {path: path.read_bytes() for path in (behind, *results.iterdir())}
    assert main(["plot", str(results), "--format", form]) == 2
    assert f"'{results / f'curve.{form}'}' was not written by masonry" in capsys.readouterr().err
    (results / f"curve.{form}").unlink()
    assert main(["plot", str(results), "--format", form]) == 2
    assert f"'{results / f'cracks.{form}'}' was not written by masonry" in capsys.readouterr().err
    before.pop(results / f"curve.{form}")
    assert (results / f"cracks.{form}").is_symlink()
    assert {path: path.read_bytes() for path in (behind, *results.iterdir())} == before


def test_a_file_that_was_changed_since_it_was_written_stays(results):
    require_own(results)
    for name in ("curve.csv", "scene.toml", "history.h5"):
        content = (results / name).read_bytes()
        (results / name).write_bytes(content[:-1] + b"#")
        with pytest.raises(SceneError, match=f"{name}' was not written by masonry, or was changed since"):
            sample().save(results)
        with pytest.raises(SceneError, match=f"{name}' was not written"), ResultFiles(results) as files:
            files.text("limit.json", "{}")
            files.text(name, "")
        assert (results / name).read_bytes() == content[:-1] + b"#" and not (results / "limit.json").exists()
        (results / name).write_bytes(content)
    sample().save(results)


def test_results_of_an_earlier_version_which_kept_no_list_are_ours_by_their_tables(results):
    (results / LIST).unlink()
    require_own(results)
    sample().save_numbers(results)
    assert json.loads((results / LIST).read_text())["files"].keys() == set(NUMBERS[:8]), (
        "all are in the list from now on"
    )
    require_own(results)
    for name in (LIST, "summary.json"):
        (results / name).unlink()
    with pytest.raises(SceneError, match="curve.csv"):
        require_own(results)


def test_a_list_that_is_not_ours_stays_and_makes_nothing_ours(results, tmp_path):
    there = put(results, LIST)
    with pytest.raises(SceneError, match="is no list of masonry"):
        sample().save(results)
    assert are_whole(there)
    (results / LIST).unlink()
    (results / LIST).symlink_to(tmp_path / "list")
    with pytest.raises(SceneError, match="is no list of masonry"):
        sample().save(results)
    assert not (tmp_path / "list").exists()


def test_a_run_that_is_tried_again_leaves_what_else_lies_in_its_folder(tmp_path):
    key = "0123456789abcdef0123"
    store = Store(tmp_path)
    assert store.keep(key, RunEnd("ERROR", "no memory", 1.0))["status"] == "ERROR"
    there = put(tmp_path / "runs" / key, "notes.txt", "mine/a.png")
    files = {name: path.read_bytes() for name, path in sample().save_numbers(tmp_path / "made").items()}
    assert store.keep(key, RunEnd("OK", "", 1.0, files))["status"] == "OK"
    assert are_whole(there) and not (tmp_path / "runs" / key / "failure.json").exists()
    assert len(list((tmp_path / "runs").iterdir())) == 1
    assert store.keep(key, RunEnd("ERROR", "no memory", 1.0))["status"] == "ERROR" and are_whole(there)


def test_runs_behind_a_link_or_of_others_are_no_runs_of_a_sweep(tmp_path):
    there = put(tmp_path / "mine", "first/notes.txt", ".masonry-7-unfinished-a/b")
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "runs").symlink_to(tmp_path / "mine")
    with pytest.raises(SceneError, match="is a link"):
        Store(tmp_path / "out")
    assert are_whole(there)
    assert not is_folder_of_runs(tmp_path / "out" / "runs") and not is_folder_of_runs(tmp_path / "mine")
    (tmp_path / "ours" / ("a" * 20)).mkdir(parents=True)
    assert is_folder_of_runs(tmp_path / "ours")


def test_a_sweep_into_the_folder_of_its_own_file_is_refused(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    Path("sweep.toml").write_text(SWEEP)
    assert main(["sweep", "sweep.toml", "--out", ".", "--workers", "0", "--quiet"]) == 2
    assert "'sweep.toml' was not written by masonry" in capsys.readouterr().err
    assert [path.name for path in tmp_path.iterdir()] == ["sweep.toml"]

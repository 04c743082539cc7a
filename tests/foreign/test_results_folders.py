"""A folder that results go to may hold other things: they stay, whatever they are called."""

import os
from pathlib import Path

import pytest

from geometry.files.atomic import WholeFiles, is_unfinished, unfinished
from masonry.cli.main import main
from masonry.errors import SceneError
from masonry.movies.movie_file import write_movie
from masonry.runtime.folder import claimed, sweep_up
from masonry.runtime.folders.own_files import LIST, WRITTEN
from masonry.runtime.named_file import is_marked, require_free
from masonry.sweeps.run_store import Store
from masonry.timeloop.checkpoint import Checkpoints
from tests.faults.samples import run
from tests.results.sample import sample
from verification.html.cover import bound, require_ours
from verification.records import require_writable

FOREIGN = (".draft-unfinished-thesis/chapter.txt", ".7-unfinished-notes.txt", ".unfinished-symphony/score.txt")
"""Names that are much like those of files that are being written, and are not."""


def put(folder: Path, *names: str) -> dict[Path, str]:
    for name in names:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(name)
    return {folder / name: name for name in names}


def are_whole(files: dict[Path, str]) -> bool:
    return all(path.is_file() and path.read_bytes() == content.encode() for path, content in files.items())


def test_only_what_carries_our_name_counts_as_left_by_a_killed_process(tmp_path):
    there = put(tmp_path, *FOREIGN, *(f"runs/{name}" for name in FOREIGN), ".masonry-notes", ".masonry-x-unfinished-a")
    (tmp_path / unfinished("checkpoint")).mkdir()
    left = put(tmp_path, unfinished("curve.csv"), f"{unfinished('checkpoint')}/run.json", f"runs/{unfinished('key')}/a")
    sweep_up(tmp_path)
    Store(tmp_path)
    assert are_whole(there) and not any(path.exists() for path in left)


def test_a_link_to_a_folder_is_never_followed(tmp_path):
    there = put(tmp_path, "elsewhere/thesis.txt")
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / unfinished("x")).symlink_to(tmp_path / "elsewhere")
    sweep_up(tmp_path / "out")
    assert are_whole(there) and list((tmp_path / "out").iterdir()) == []


def test_a_file_is_called_unfinished_while_it_is_written(tmp_path):
    with WholeFiles(tmp_path) as files:
        files.text("a" * 200, "")
        assert [is_unfinished(path.name) for path in tmp_path.iterdir()] == [True]


@pytest.mark.parametrize("words", [[], ["--overwrite"]])
def test_a_folder_without_results_is_refused_and_stays_as_it_is(words, tmp_path, capsys):
    out = tmp_path / "out"
    there = put(out, *FOREIGN, "scene.toml", "curve.csv", "checkpoint/epoch-1.pt", "checkpoint/state-000001.npz")
    assert run(out, *words) == 2
    assert main(["limit", "arch-tilted", "--out", str(out), *words]) == 2
    assert are_whole(there) and len(list(out.rglob("*"))) == len(there) + 3
    assert ("was not written by masonry" if words else "is not empty") in capsys.readouterr().err


def test_an_empty_folder_of_the_user_that_is_called_checkpoint_stays_where_the_run_is_refused(tmp_path):
    put(tmp_path, "thesis.txt")
    (tmp_path / "checkpoint").mkdir()
    with pytest.raises(SceneError, match="not empty"), claimed("s", tmp_path):
        pass
    assert (tmp_path / "checkpoint").is_dir()


def test_checkpoints_go_and_what_others_put_beside_them_stays(tmp_path):
    kept = Checkpoints(tmp_path)
    kept.begin("name = 1\n", {"threads": 1})
    kept.write({"a": 1})
    there = put(tmp_path, "checkpoint/notes.txt", "checkpoint/old/state-000001.npz", "checkpoint/state-1.npz")
    kept.clear()
    assert are_whole(there) and kept.states() == [] and not kept.scene.exists()
    with pytest.raises(SceneError, match="is no checkpoint of a run"):
        kept.begin("name = 1\n", {"threads": 1})
    assert are_whole(there)


def test_a_run_that_replaces_another_leaves_what_else_is_in_the_folder(tmp_path):
    assert run(tmp_path / "out") == 0
    assert main(["limit", "arch-tilted", "--out", str(tmp_path / "limit")]) == 0
    made = {path.name for folder in ("out", "limit") for path in (tmp_path / folder).iterdir()}
    assert made <= {*WRITTEN, LIST}
    there = put(tmp_path / "out", *FOREIGN, "thesis.txt", "pictures/a.png")
    assert run(tmp_path / "out", "--overwrite") == 0
    assert are_whole(there)


def test_whether_a_folder_can_be_written_to_is_asked_without_touching_a_file(tmp_path):
    there = put(tmp_path, f".writable-{os.getpid()}")
    require_writable(tmp_path)
    assert are_whole(there)


@pytest.mark.parametrize(
    ("words", "name"), [(["paper", "--quick"], "paper.html"), (["verify", "incline"], "verify.html")]
)
def test_a_page_that_is_not_ours_is_never_replaced(words, name, tmp_path, capsys):
    there = put(tmp_path, name)
    assert main([*words, "--out", str(tmp_path)]) == 2
    assert are_whole(there) and list(tmp_path.iterdir()) == list(there)
    assert "is no page of masonry" in capsys.readouterr().err


@pytest.mark.parametrize("name", ["verify.html", "records.json"])
def test_a_link_in_the_place_of_a_page_or_of_records_stays(name, tmp_path, capsys):
    (tmp_path / "ours.html").write_text(bound("A title", "", []), encoding="utf-8")
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / name).symlink_to(tmp_path / "ours.html")
    assert main(["verify", "incline", "--out", str(tmp_path / "out")]) == 2
    assert "would be replaced: move it" in capsys.readouterr().err and (tmp_path / "out" / name).is_symlink()


def test_a_page_of_ours_is_replaced(tmp_path):
    (tmp_path / "page.html").write_text(bound("A title", "", []), encoding="utf-8")
    require_ours(tmp_path / "page.html")
    require_ours(tmp_path / "another.html")


@pytest.mark.parametrize(
    ("words", "name"),
    [
        (["export", "couplet", "--to"], "wall.obj"),
        (["picture", "couplet", "--geometry", "--out"], "wall.png"),
        (["picture", "couplet", "--geometry"], "couplet-geometry.png"),
        (["picture", "{run}", "--out"], "wall.png"),
        (["picture", "{run}"], "run/peak-front.png"),
        (["movie", "{run}", "--to"], "wall.gif"),
        (["movie", "{run}"], "run/movie.gif"),
        (["law", "linear", "--plot"], "wall.png"),
    ],
)
def test_a_file_that_is_not_ours_is_replaced_by_none_of_the_commands_that_write_one_unless_they_are_told_to(
    words, name, tmp_path, capsys, monkeypatch
):
    monkeypatch.chdir(tmp_path)
    if "{run}" in words:
        sample().save_numbers(tmp_path / "run")
    named = [name] if words[-1].startswith("--") and words[-1] != "--geometry" else []
    there, words = put(tmp_path, name), [*(word.format(run="run") for word in words), *named]
    assert main(words) == 2 and are_whole(there)
    assert f"'{name}' exists already; --overwrite replaces it" in capsys.readouterr().err
    assert main([*words, "--overwrite"]) == 0 and not are_whole(there)
    assert main(words) == (2 if words[0] == "export" else 0), "a picture of ours is drawn again"


def test_a_file_is_ours_by_its_mark_and_a_link_or_a_folder_never_is(tmp_path):
    write_movie(sample(), tmp_path / "ours.gif")
    (tmp_path / "cut.gif").write_bytes((tmp_path / "ours.gif").read_bytes()[:6])
    (tmp_path / "broken.gif").symlink_to(tmp_path / "nowhere.gif")
    (tmp_path / "folder.gif").mkdir()
    assert [is_marked(tmp_path / f"{name}.gif") for name in ("ours", "cut", "broken", "folder", "none")] == [
        True, False, False, False, False
    ]  # fmt: skip
    for name in ("cut", "broken"):
        with pytest.raises(SceneError, match="exists already"):
            require_free(tmp_path / f"{name}.gif", overwrite=False)

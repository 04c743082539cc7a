"""`masonry new` and `masonry show`: what they write, print and refuse."""

import pytest

import masonry
from masonry.cli.main import main
from masonry.scene.source import packaged
from masonry.starting.starting import IMPORT, NAMES


@pytest.fixture(autouse=True)
def empty_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize("task", NAMES)
def test_a_scene_is_written_and_the_last_lines_say_what_comes_next(task, empty_folder, capsys):
    assert main(["new", task, "--out", f"my {task}.toml"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == f"my {task}.toml" and lines[1] == f"next  masonry view 'my {task}.toml'"
    text = (empty_folder / f"my {task}.toml").read_text(encoding="utf-8")
    assert "$" not in text and text.endswith("\n") and text.count("\n") < 75
    assert all(step.strip().removeprefix("next  ") in text for step in lines[1:])
    assert len(text.split("[assumptions]")[1].splitlines()) > 3
    assert masonry.load(f"my {task}.toml").title in text.splitlines()[0]


def test_the_shell_and_python_write_the_same_file(empty_folder):
    assert main(["new", "bridge", "--spans", "8,6", "--axles", "90,90"]) == 0
    written = (empty_folder / "bridge.toml").read_text(encoding="utf-8")
    scene = masonry.new("bridge", "bridge.toml", overwrite=True, spans=[8, 6], axles=[90, 90])
    assert (empty_folder / "bridge.toml").read_text(encoding="utf-8") == written
    assert scene == masonry.load("bridge.toml")


def test_a_file_that_is_there_is_replaced_on_request_only(empty_folder, capsys):
    (empty_folder / "couplet.toml").write_text("mine")
    assert main(["new", "couplet"]) == 2
    assert "--overwrite" in capsys.readouterr().err and (empty_folder / "couplet.toml").read_text() == "mine"
    assert main(["new", "couplet", "--overwrite"]) == 0
    assert masonry.load("couplet.toml").specimen.kind == "couplet"


@pytest.mark.parametrize(
    ("words", "says"),
    [
        ("brigde", "did you mean 'bridge'?"),
        ("bridge --spans 0", "--spans: '0 m' is out of range; --spans must be in [0.2, 200] m; a bare number is in m"),
        ("bridge --spans=-8,6", "'-8 m' is out of range"),
        ("bridge --spans two", "'two' is not a number and a unit"),
        ("bridge --spans 8,,6", "'' is not a number and a unit"),
        ("bridge --spans 8kg", "kg is a mass"),
        ("bridge --spans 8000", "a bare number is in m"),
        ("bridge --spam 8", "did you mean '--spans'?"),
        ("bridge --spans 8,6 --rises 1,2,3", "--rises: give 1 value, or one for each of the 2 spans; here are 3"),
        ("bridge --spans 8 --rises 5", "--rises: 5 m over a span of 8 m; allowed: 0.16 to 4 m"),
        ("bridge --spans 8,6 --pier-width 0.3", "the rings that spring from pier 1 need"),
        ("bridge --spacings 2", "--spacings: a single axle has none"),
        ("bridge --friction nan", "'nan' is not a finite number"),
        ("bridge --out bridge.txt", "nearest: 'bridge.toml'"),
        ("bridge --out nowhere/bridge.toml", "cannot write 'nowhere/bridge.toml'"),
        ("arch --load wind", "known here: point, tilt"),
        ("arch --load tilt --at 1", "--at: a tilt has no place"),
        ("arch --at 4.5", "--at: 4.5 m; it must be less than the span"),
        ("arch --voussoirs 2.5", "is not a whole number"),
        ("arch --thickness 5", "--thickness: 5 m; it must be less than the span"),
        ("wall --length 0.1", "--unit-length: 240 mm; the wall is 0.1 m long"),
        ("wall --length 50 --height 50", "about 80000 units"),
        ("wall --pressure 7", "--pressure: 7 MPa; the joints crush at 6 MPa"),
        ("facade --thickness 2", "--length: 4 m; with these walls at least 6 m"),
        ("facade --door-width 3", "--door-width: 3 m; beside it half a stone is needed"),
        ("facade --door-height 2.9", "--door-width 0 leaves the door out"),
        ("house --width 1", "--width: 1 m; more than three walls, 1.2 m"),
        ("earthquake --soil F", "known here: A, B, C, D, E"),
        ("couplet --tension 5", "--tension: 5 MPa; a joint bears at most cohesion / friction"),
    ],
)
def test_what_cannot_be_is_said_in_one_line_and_nothing_is_written(words, says, empty_folder, capsys):
    assert main(["new", *words.split()]) == 2
    said = capsys.readouterr()
    assert said.out == "" and said.err.count("\n") == 1 and says in said.err, said.err
    assert not list(empty_folder.iterdir())


def test_without_a_task_all_are_listed_and_import_says_how_it_is_called(capsys):
    assert main(["new"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[2] for line in lines[:-1]] == [*NAMES, IMPORT]
    assert main(["new", "import", "my wall.step"]) == 0
    assert capsys.readouterr().out.startswith("masonry import 'my wall.step' --out 'my wall.toml'")


@pytest.mark.parametrize("name", ["couplet", "bridge"])
def test_show_prints_a_packaged_scene_as_its_file_is(name, capsys):
    assert main(["show", name]) == 0
    assert capsys.readouterr().out == packaged()[name].read_text(encoding="utf-8")


def test_show_prints_a_file_and_says_which_scene_it_stands_on(empty_folder, capsys):
    (empty_folder / "mine.toml").write_text('base = "couplet"  # and no more')
    assert main(["show", "mine.toml"]) == 0
    said = capsys.readouterr()
    assert said.out == 'base = "couplet"  # and no more\n' and "masonry show couplet" in said.err
    assert main(["show", "couplett"]) == 2
    assert "did you mean 'couplet'?" in capsys.readouterr().err

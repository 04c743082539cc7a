"""What commands do, as functions: the same files and numbers, and one SceneError for what is wrong."""

import signal
from pathlib import Path

import numpy as np
import pytest

import masonry
from masonry.cli.main import APART, main, parser
from masonry.errors import SceneError
from tests.faults.samples import ALWAYS, ended_after

ELSEWHERE = {
    **{"list": "scenes", "import": "import_blocks"},
    **dict.fromkeys(("plot", "picture", "movie", "spectrum"), "load_result"),
}
"""Functions of another name; what comes of the last one draws."""
FOR_PEOPLE = {"doctor", "paper", "show"}


def test_each_command_has_a_function():
    subcommands = next(action for action in parser()._actions if action.dest == "command").choices
    for name in {*subcommands, *APART} - FOR_PEOPLE:
        assert callable(getattr(masonry, ELSEWHERE.get(name, name), None)), name


@pytest.fixture
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture(scope="module")
def couplet():
    return masonry.run(masonry.load("couplet", {"drive.accuracy": "10 %", "solver.frames": 4}))


def test_blocks_go_out_as_the_command_writes_them(here):
    masonry.export({"base": "couplet"}, "own.obj")
    assert main(["export", "couplet", "--to", "other.obj"]) == 0
    assert Path("own.obj").read_bytes() == Path("other.obj").read_bytes()
    wrong = (("own.obj", False, "exists|already"), (5, False, "to = "), ("a.obj", 1, "overwrite = "))
    for to, overwrite, message in wrong:
        with pytest.raises(SceneError, match=message):
            masonry.export("couplet", to, overwrite)


def test_a_run_of_the_command_line_is_brought_to_its_end(here, monkeypatch):
    words = ["run", "couplet", "--set", "drive.displacement=0.01 mm", "--quiet", *ALWAYS, "--out"]
    assert main([*words, "whole"]) == 0
    with ended_after(10, signal.SIGINT, monkeypatch):
        assert main([*words, "parts"]) == 130
    result, whole = masonry.resume("parts"), masonry.load_result("whole")
    assert np.array_equal(result.history.rows["force"], whole.history.rows["force"])
    assert masonry.resume("parts").summary.steps == whole.summary.steps
    with pytest.raises(SceneError, match="is not a folder of results"):
        masonry.resume("nowhere")


def test_a_result_is_drawn_at_a_moment_and_moved(here, couplet, capsys):
    couplet.save("out")
    couplet.picture("own.png", step="last", view="iso", scale=10.0)
    assert main(["picture", "out", "--step", "last", "--view", "iso", "--scale", "10", "--out", "other.png"]) == 0
    assert Path("own.png").read_bytes() == Path("other.png").read_bytes()
    assert couplet.movie("own.gif").stat().st_size > 10_000
    Path("mine.gif").write_text("not made by the program")
    with pytest.raises(SceneError, match="mine.gif"):
        couplet.movie("mine.gif")
    with pytest.raises(SceneError, match="view 'top'"):
        couplet.picture(view="top")
    with pytest.raises(SceneError, match="no acceleration"):
        couplet.spectra()


def test_a_law_tells_what_the_command_prints(here, capsys):
    report = masonry.law("linear", {"cohesion": "0.6 MPa"}, plot="law.png")
    assert main(["law", "linear", "--set", "cohesion=0.6 MPa"]) == 0
    assert capsys.readouterr().out.strip() == repr(report).strip() and Path("law.png").stat().st_size > 10_000
    with pytest.raises(SceneError, match="did you mean 'linear'"):
        masonry.law("liner")
    with pytest.raises(SceneError, match="did you mean 'cohesion'"):
        masonry.law("linear", {"cohesoin": "1 MPa"})


def test_a_record_is_the_one_of_the_command(here):
    keys = {"spectrum": "eurocode-8-1", "soil": "B", "a_g": "0.2 g", "duration": "5 s", "seed": 1}
    masonry.record("own.csv", **keys)
    assert main(["record", "other.csv", *(f"{key}={value}" for key, value in keys.items())]) == 0
    assert Path("own.csv").read_bytes() == Path("other.csv").read_bytes()
    for words, message in (
        ({**keys, "sead": 1}, "did you mean 'seed'"),
        ({**keys, "components": 4}, "components = 4: 1, 2 or 3"),
        ({**keys, "to": "x.txt"}, "is a .csv file"),
    ):
        with pytest.raises(SceneError, match=message):
            masonry.record(**words)


def test_cases_are_verified_and_named(here):
    assert masonry.verify("incline", workers=0).holds
    with pytest.raises(SceneError, match="inclin"):
        masonry.verify("inclin")
    with pytest.raises(SceneError, match="full runs all cases"):
        masonry.verify("incline", full=True)
    with pytest.raises(SceneError, match="workers = -1"):
        masonry.verify("incline", workers=-1)

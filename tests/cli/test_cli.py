"""The command line: what it calls, what it says, and the exit code that tells a shell how it went."""

import json
import os
import subprocess
import sys
import types

import pytest

import masonry.laboratory
from geometry.blocks import GeometryError
from masonry import scene
from masonry.cli.main import APART, OF_VERIFICATION, main
from masonry.errors import SceneError, Stopped
from masonry.laboratory.text import Report
from masonry.runtime.processors import processors
from masonry.sweeps.error_bars import check_line
from tests.results.sample import sample

REPORT = Report(
    blocks=96,
    cells=[],
    scatter=[],
    contacts={"unit_unit": 500, "within_units": 188},
    contact_points=2752,
    tets=0,
    freedoms=576,
    time_step_s=1.25e-6,
    limited_by="contact group unit_unit, block 12",
    quality={"shortest edge": "12 mm, 0.5 h; block 3 (units, unit 1) at (100, 25, 25) mm", "no joint": "none"},
    masses=[],
    bars=[],
    slabs=[],
    quiet=[],
    settling="",
    meeting="",
    moved=[],
    ratios=[],
    steps=20000,
    steps_between=(8000, 40000),
    expected_seconds=130.0,
    seconds_between=(60.0, 240.0),
    left_out=["gravity", "a sentence that is long enough to be wrapped " * 4],
    compiled=[],
    warnings=["the drive is fast"],
)


@pytest.fixture
def laboratory(monkeypatch, tmp_path):
    """A laboratory that returns a made-up result; `calls` remembers how it was called."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(scene, "load", lambda name, overrides: (name, list(overrides)))
    monkeypatch.setattr(scene, "to_toml", lambda loaded: '[specimen]\nkind = "couplet"\n[contact]\n')
    fake = types.ModuleType("masonry.laboratory.laboratory")
    fake.calls = []

    def run(loaded, *, threads, progress, checkpointer):
        fake.calls.append((loaded, threads, progress))
        return sample()

    fake.run, fake.check = run, lambda loaded: REPORT
    monkeypatch.setattr(check_line, "error_bar_line", lambda loaded: "masonry run --error-bar says how far it is off")
    monkeypatch.setitem(sys.modules, "masonry.laboratory.laboratory", fake)
    monkeypatch.setattr(masonry.laboratory, "laboratory", fake, raising=False)
    return fake


def raising(error):
    def call(*_, **__):
        raise error

    return call


def test_a_run_is_written_to_the_next_free_folder_and_says_where_and_how_well(laboratory, tmp_path, capsys):
    assert main(["run", "couplet", "--set", "law=linear", "--set", "drive.steps=9", "--threads", "1"]) == 0
    assert main(["run", "couplet", "--quiet"]) == 0
    assert laboratory.calls[0][:2] == (("couplet", ["law=linear", "drive.steps=9"]), 1)
    assert laboratory.calls[0][2] is not None and laboratory.calls[1][1:] == (1, None)
    assert sorted(path.name for path in (tmp_path / "results").iterdir()) == ["couplet-1", "couplet-2"]
    said = capsys.readouterr().out
    for words in ("results/couplet-1/curve.png", "cracks.png", "summary.json", "0.19 MPa", "0.04 mm", "quasi-static"):
        assert words in said
    assert "couplet-2" not in said
    assert json.loads((tmp_path / "results/couplet-1/summary.json").read_text())["steps"] == 1000


@pytest.mark.parametrize("error", [SceneError, GeometryError])
def test_a_bad_scene_gives_one_message_exit_code_2_and_no_folder(laboratory, tmp_path, capsys, error):
    laboratory.run = raising(error("contact.unit_unit: GI is 1 N/m; it needs at least 2 N/m"))
    assert main(["run", "couplet"]) == 2
    assert main(["run", "couplet", "--out", "mine"]) == 2
    said = capsys.readouterr()
    assert said.err == 2 * "masonry: contact.unit_unit: GI is 1 N/m; it needs at least 2 N/m\n"
    assert said.out == "" and not (tmp_path / "mine").exists() and not list((tmp_path / "results").iterdir())


def test_a_programming_error_is_not_dressed_up_as_the_users(laboratory):
    laboratory.run = raising(ZeroDivisionError())
    with pytest.raises(ZeroDivisionError):
        main(["run", "couplet"])


def test_a_stopped_run_writes_what_it_has_and_exits_with_3(laboratory, tmp_path, capsys):
    stopped = Stopped("block 7 at step 1200: velocity is not finite")
    stopped.result = sample()
    laboratory.run = raising(stopped)
    assert main(["run", "couplet", "--quiet"]) == 3
    assert (tmp_path / "results/couplet-1/curve.csv").is_file()
    laboratory.run = raising(Stopped("block 7 at step 1200: velocity is not finite"))
    assert main(["run", "couplet", "--quiet"]) == 3
    assert not (tmp_path / "results/couplet-2").exists()
    said = capsys.readouterr().err.splitlines()
    assert said[0] == said[2] == "masonry: block 7 at step 1200: velocity is not finite"
    assert "results/couplet-1" in said[1]
    stopped.result.summary |= {"stopped": "velocity is not finite"}
    laboratory.run = raising(stopped)
    assert main(["run", "couplet"]) == 3
    out = " ".join(capsys.readouterr().out.split())
    assert "cracks.png" in out and "peak stress" in out and "was stopped, so this is only its first part" in out


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["run", "couplet", "--law", "linear"], "--set law=VALUE; see `masonry run --help`"),
        (["run", "couplet", "--overwrited"], "did you mean '--overwrite'?; see `masonry run --help`"),
        (["picture", "couplet", "--steps=3"], "did you mean '--step'?; see `masonry picture --help`"),
        (["check", "couplet", "--set", "cohesion=1 MPa"], "did you mean 'contact.unit_unit.cohesion'"),
        (["check", "couplet", "--set", "rate=1 mm/s"], "did you mean 'drive.rate'?"),
        (["check", "couplet", "--set", "density=1 kg/m^3"], "did you mean 'material.units.density'?"),
        (["check", "couplet", "--set", "width=1 mm"], "did you mean 'specimen.width'?"),
    ],
)
def test_a_word_that_is_not_known_names_the_place_where_it_belongs(words, said, capsys):
    assert main(words) == 2
    assert said in capsys.readouterr().err


def test_an_interrupted_run_writes_what_it_has_and_exits_with_130(laboratory, tmp_path, capsys):
    part = sample()
    part.summary |= {"interrupted": True}
    laboratory.run = lambda *_, **__: part
    assert main(["run", "couplet"]) == 130
    assert (tmp_path / "results/couplet-1/cracks.png").is_file()
    assert "interrupted, so this is only its first part" in " ".join(capsys.readouterr().out.split())
    laboratory.run = raising(KeyboardInterrupt())
    assert main(["run", "couplet"]) == 130
    assert not (tmp_path / "results/couplet-2").exists()


def test_results_are_never_mixed_into_a_folder_that_holds_something(laboratory, tmp_path, capsys):
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "notes.txt").touch()
    assert main(["run", "couplet", "--out", "mine"]) == 2
    assert laboratory.calls == [] and "--overwrite" in capsys.readouterr().err
    assert main(["run", "couplet", "--out", "mine", "--overwrite", "--quiet"]) == 0
    assert (tmp_path / "mine" / "notes.txt").exists() and (tmp_path / "mine" / "curve.csv").exists()


def test_a_disk_that_cannot_be_written_to_is_said_in_words(laboratory, tmp_path, monkeypatch, capsys):
    (tmp_path / "results").write_text("a file where the folder should be")
    assert main(["run", "couplet"]) == 2
    full = sample()
    monkeypatch.setattr(full, "save", raising(OSError(28, "No space left on device")), raising=False)
    laboratory.run = lambda *_, **__: full
    assert main(["run", "couplet", "--out", "mine", "--quiet"]) == 2
    said = capsys.readouterr().err.splitlines()
    assert "cannot write results to 'results'" in said[0] and "No space left on device" in said[-1]


@pytest.mark.parametrize(
    "words",
    [
        [],
        ["fly"],
        ["run"],
        ["run", "couplet", "--threads", "0"],
        ["run", "couplet", "--threads", str(processors() + 1)],
        ["run", "couplet", "--threads", "two"],
        ["check"],
        ["plot"],
        ["list", "--fast"],
    ],
)
def test_wrong_words_give_one_line_and_exit_code_2(words, capsys):
    assert main(words) == 2
    said = capsys.readouterr()
    assert said.out == "" and said.err.startswith("masonry: ") and said.err.count("\n") == 1


def test_what_a_message_repeats_can_neither_steer_the_terminal_nor_fill_it(capsys):
    assert main(["check", "couplet", "--set", 'drive.on="\x1b[2J\x07' + 5000 * "a" + '"']) == 2
    assert main(["picture", "couplet", "--geometry", "--out", "\x1b[31m/"]) == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 2 and len(said) < 2500 and said.replace("\n", "").isprintable()
    assert "\\x1b[2J" in said and "\\x1b[31m.png" in said


def test_check_prints_every_part_of_the_report_aligned(laboratory, capsys):
    assert main(["check", "couplet"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert all(len(line) <= 110 for line in lines)
    said = "\n".join(lines)
    for words in (
        "96",
        "unit_unit     500",
        "2752",
        "576",
        "1.25e-06 s, limited by contact group",
        "12 mm, 0.5 h",
        "2 min 10 s",
        "gravity",
        "the drive is fast",
        "masonry run --error-bar",
    ):
        assert words in said
    assert len({len(line) - len(line.split("  ", 1)[1].lstrip()) for line in lines if "  " in line}) == 1


def test_plot_draws_again_what_was_deleted_and_refuses_other_folders(tmp_path, capsys):
    sample().save(tmp_path / "out")
    (tmp_path / "out" / "curve.png").unlink()
    (tmp_path / "out" / "cracks.png").unlink()
    assert main(["plot", str(tmp_path / "out")]) == 0
    assert (tmp_path / "out" / "curve.png").is_file() and (tmp_path / "out" / "cracks.png").is_file()
    assert main(["plot", str(tmp_path)]) == 2
    assert "not a folder of results" in capsys.readouterr().err


def python(code, *arguments, **options):
    return subprocess.run([sys.executable, "-c", code, *arguments], capture_output=True, text=True, **options)


ANSWERED_AT_ONCE = ["list", "--help", "run --help", "--version", "run", "new", "new bridge --help", "show couplet"]
ANSWERED_AT_ONCE += [f"{command} --help" for command in APART if command not in OF_VERIFICATION]
MODULES_AT_ONCE = 110
"""That a command may load besides those of a bare Python: 94 for the list of scenes, 52 to 66 for others."""


@pytest.mark.parametrize("words", ANSWERED_AT_ONCE)
def test_commands_that_do_not_compute_import_nothing_heavy(words):
    code = (
        "import sys; bare = len(sys.modules)\n"
        "from masonry.cli.main import main; main(sys.argv[1:])\n"
        "heavy = {'numba', 'gmsh', 'scipy', 'matplotlib', 'h5py', 'rich', 'numpy', 'pydantic'} & set(sys.modules)\n"
        "count = len(sys.modules) - bare\n"
        f"sys.exit(f'imported {{heavy}}, {{count}} modules' if heavy or count > {MODULES_AT_ONCE} else 0)"
    )
    done = python(code, *words.split())
    assert done.returncode == 0, done.stderr


def test_plot_needs_neither_numba_nor_gmsh_nor_pyplot(tmp_path):
    sample().save(tmp_path)
    code = (
        "import sys; from masonry.cli.main import main; assert main(['plot', sys.argv[1]]) == 0;"
        "heavy = {'numba', 'gmsh', 'scipy', 'matplotlib.pyplot'} & set(sys.modules);"
        "sys.exit(f'imported {heavy}' if heavy else 0)"
    )
    done = python(code, str(tmp_path))
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("words", ["list", "--help"])
def test_a_reader_that_goes_away_is_no_error(words):
    read, write = os.pipe()
    os.close(read)
    done = subprocess.run(
        [sys.executable, "-m", "masonry", words], stdout=write, stderr=subprocess.PIPE, text=True, check=False
    )
    os.close(write)
    assert done.returncode == 0 and done.stderr == ""


def test_the_version_is_the_packages(capsys):
    assert main(["--version"]) == 0
    assert capsys.readouterr().out == f"masonry {masonry.__version__}\n"


@pytest.mark.parametrize("words", ["plot {}", "resume {}", "movie {}", "picture {}", "run couplet --out {}"])
def test_a_name_that_no_file_can_have_is_said_in_one_line(words, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(words.format("a" * 5000).split()) == 2
    assert capsys.readouterr().err.count("\n") == 1 and not list(tmp_path.iterdir())


def test_the_paper_is_run_in_the_clone_and_one_message_says_so(capsys, monkeypatch):
    monkeypatch.setitem(sys.modules, "verification.paper", None)
    monkeypatch.delitem(sys.modules, "verification.paper.command", raising=False)
    assert main(["paper"]) == 2
    assert "'paper' is a part of the clone of masonry-dem" in capsys.readouterr().err

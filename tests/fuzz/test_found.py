"""What bad input has found: each by its smallest input."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import h5py
import numpy as np
import pytest

from geometry.blocks import GeometryError
from geometry.files.blocks_h5 import load_blocks, save_blocks
from masonry.cli.main import main
from masonry.errors import Faults, SceneError, visible
from masonry.laboratory.result import load_result
from masonry.runtime.text_files import json_of
from masonry.sweeps.read import read
from masonry.timeloop.checkpoint import Checkpoints
from tests.fuzz import sound
from verification import records

SWEEP = 'scene = "couplet"\n[grid]\n"drive.steps" = [1]\n'


def said(capsys, *words) -> str:
    assert main(list(words)) == 2
    return capsys.readouterr().err


def test_a_newline_in_a_name_makes_no_line_of_its_own(tmp_path, capsys):
    (tmp_path / "a.toml").write_text('base = "couplet"\n"x\\nmasonry: all is well" = 1\n')
    assert said(capsys, "check", str(tmp_path / "a.toml")).count("\n") == 1
    assert said(capsys, "check", "couplet", "--set", "law=a\nmasonry: all is well").count("\n") == 1
    assert said(capsys, "no\nsuch").count("\n") == 1
    assert "\x1b" not in said(capsys, "check", "couplet", "\x1b[2J")


def test_a_name_with_codes_of_a_terminal_is_shown_as_codes(tmp_path, capsys):
    (tmp_path / "a.toml").write_text('base = "couplet"\n[[gauge]]\nname = "\\u001b[2J"\non = "top"\ndirection = "x"\n')
    main(["check", str(tmp_path / "a.toml")])
    both = capsys.readouterr()
    assert "\x1b" not in both.out + both.err
    assert visible("a\nb\x1b\u202e\udcff") == "a\\nb\\x1b\\u202e\\udcff"


def test_findings_stay_findings_when_they_are_met_elsewhere():
    import pickle

    findings = Faults(["a", "b\nc"]).within("x")
    assert findings.lines == ["x: a", "b\\nc"]
    assert pickle.loads(pickle.dumps(findings)).lines == findings.lines


def test_no_message_is_longer_than_a_screen(capsys):
    assert len(said(capsys, "check", "couplet", "--set", " ".join(["law=x"] + ["y" * 90] * 500))) < 2000
    assert len(said(capsys, "y" * 100_000)) < 2000


@pytest.mark.parametrize("content", ["[" * 100_000, '{"a":' * 100_000, "[1e999]", "[NaN]", "[1" + "0" * 50 + "]", ""])
def test_json_that_is_deep_or_not_finite_is_refused(tmp_path, content):
    (tmp_path / "a.json").write_text(content)
    with pytest.raises(SceneError):
        json_of(tmp_path / "a.json")


def test_what_is_no_plain_file_is_refused_and_not_waited_for(tmp_path):
    os.mkfifo(tmp_path / "pipe.json")
    for path in (tmp_path / "pipe.json", Path("/dev/zero"), Path("/proc/kmsg"), tmp_path, Path("x" * 5000)):
        for reader in (json_of, records.load, read):
            with pytest.raises(SceneError):
                reader(path)


@pytest.mark.skipif(not Path("/proc/kmsg").exists(), reason="needs a file that keeps its reader waiting")
def test_a_scene_that_keeps_its_reader_waiting_is_refused(capsys):
    assert said(capsys, "check", "/proc/kmsg")


@pytest.mark.parametrize("key", ["case", "version", "value", "seconds", "tolerance"])
def test_a_record_of_another_type_is_refused_by_name(tmp_path, key):
    record = {"case": "a", "version": "1", "value": 1.0, "tolerance": 0.1, "seconds": 1.0}
    (tmp_path / "r.json").write_text(json.dumps([record | {key: [1]}]))
    with pytest.raises(SceneError, match=f"record 1: {key}"):
        records.load(tmp_path / "r.json")


@pytest.mark.parametrize(
    "text",
    [
        SWEEP.replace("[1]", "{times = [1" + "0" * 400 + "]}"),
        SWEEP + '[latin_hypercube]\nsamples = 2\n"drive.accuracy" = {from = 1, to = 1' + "0" * 400 + "}\n",
        SWEEP
        + "[latin_hypercube]\nsamples = 100_000\n"
        + "".join(f'"a{n}" = {{from = 0, to = 1}}\n' for n in range(60)),
        SWEEP.replace("[1]", str(list(range(1000)))) + '"b" = [1, 2]\n"c" = ' + str(list(range(1000))),
        SWEEP + "".join(f'"a{n}" = {list(range(1000))}\n' for n in range(120)),
        "a." * 40_000 + "a = 1",
        "a = " + "[" * 5000,
    ],
)
def test_a_sweep_with_numbers_or_tables_beyond_bounds_is_refused(tmp_path, capsys, text):
    (tmp_path / "s.toml").write_text(text)
    begun = time.process_time()
    assert said(capsys, "sweep", str(tmp_path / "s.toml"), "--list")
    assert time.process_time() - begun < 10


def test_a_sweep_can_be_listed_and_nothing_is_written(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("s.toml").write_text(SWEEP.replace("[1]", "[1, 2]"))
    assert main(["sweep", "s.toml", "--list"]) == 0
    assert capsys.readouterr().out == "1  drive.steps = 1\n2  drive.steps = 2\n"
    assert os.listdir() == ["s.toml"]


def test_a_sweep_on_blocks_from_a_pipe_is_refused(tmp_path, capsys):
    os.mkfifo(tmp_path / "pipe.h5")
    (tmp_path / "a.toml").write_text('base = "couplet"\n[specimen]\nkind = "file"\npath = "pipe.h5"\n')
    (tmp_path / "s.toml").write_text(SWEEP.replace("couplet", "a.toml"))
    assert "is no file" in said(capsys, "check", str(tmp_path / "a.toml"))
    assert main(["sweep", str(tmp_path / "s.toml"), "--out", str(tmp_path / "out"), "--workers", "1"]) == 2
    assert "is no file" in capsys.readouterr().err


def test_an_array_in_the_place_of_a_group_is_not_searched(tmp_path):
    path = tmp_path / "a.blocks.h5"
    save_blocks(path, sound.small())
    with h5py.File(path, "r+") as file:
        del file["blocks"]
        file.create_dataset("blocks", shape=(10**12,), dtype="f8", chunks=(10,))
    with pytest.raises(GeometryError, match="holds none"):
        load_blocks(path)


def _results(tmp_path: Path) -> Path:
    for name, content in sound.results().items():
        (tmp_path / name).write_bytes(content)
    return tmp_path


def _replace(name, **words):
    def change(file):
        del file[name]
        file.create_dataset(name, **words)

    return change


def _link(name, link):
    def change(file):
        del file[name]
        file[name] = link

    return change


@pytest.mark.parametrize(
    "change",
    [
        _replace("rows/stress", shape=(10**12,), dtype="f8", chunks=(10,)),
        _replace("rows/stress", data=np.zeros(3)),
        _replace("rows/stress", data=np.full(101, np.nan)),
        _replace("rows/stress", data=np.full(101, 1e300)),
        _replace("joints/block_a", data=np.zeros(3, dtype=int)),
        _replace("frames/corners", data=np.zeros((2, 1, 3))),
        _replace("specimen/blocks/face_points", data=np.full(432, 10**9)),
        _replace("specimen", shape=(10**12,), dtype="f8", chunks=(10,)),
        _replace("log", data=np.zeros(60_000_000, dtype="u1"), chunks=(60_000_000,), compression="lzf"),
        _replace("joints/area", shape=(128,), dtype="f8", external=[("/etc/passwd", 0, 1024)]),
        _link("rows/stress", h5py.ExternalLink("/etc/passwd", "x")),
        _link("rows/stress", h5py.SoftLink("/")),
        _link("frames", h5py.SoftLink("/frames")),
        lambda file: file.attrs.clear(),
    ],
)
def test_a_history_whose_parts_do_not_fit_is_refused(tmp_path, change):
    folder = _results(tmp_path)
    load_result(folder)
    with h5py.File(folder / "history.h5", "r+") as file:
        change(file)
    with pytest.raises(SceneError, match="history.h5"):
        load_result(folder)


def test_a_tessellation_that_is_none_is_not_repeated(tmp_path, capsys):
    (tmp_path / "a.tess").write_text("root:$6$salt$hash:19000:0\n")
    assert "salt" not in said(capsys, "import", str(tmp_path / "a.tess"), "--out", str(tmp_path / "a.toml"))


def test_a_reader_whose_asker_was_killed_takes_its_folder_away_and_ends(tmp_path):
    code = (
        "import sys; sys.path.insert(0, sys.argv[1])\n"
        "from geometry.files.sandbox import guarded\n"
        "guarded('tests.geometry.files.bad_readers', 'sleep', sys.argv[2])\n"
    )
    (tmp_path / "a.step").write_text("x")
    house = str(Path(__file__).resolve().parents[2])
    inside = tmp_path / "tmp"
    inside.mkdir()
    words = [sys.executable, "-c", code, house, str(tmp_path / "a.step")]
    asker = subprocess.Popen(words, env={**os.environ, "TMPDIR": str(inside), "PYTHONPATH": house})
    _until(lambda: any(inside.iterdir()) and _readers(inside))
    os.kill(asker.pid, signal.SIGKILL)
    asker.wait()
    _until(lambda: not any(inside.iterdir()) and not _readers(inside))


def _readers(inside: Path) -> list[str]:
    """Processes that work in a folder below."""
    readers = []
    for entry in Path("/proc").iterdir():
        if entry.name.isdecimal():
            try:
                there = os.readlink(entry / "cwd")
            except OSError:
                continue
            if there.startswith(str(inside)):
                readers.append(entry.name)
    return readers


def _until(holds) -> None:
    end = time.monotonic() + 60
    while not holds():
        assert time.monotonic() < end
        time.sleep(0.05)


@pytest.mark.parametrize(
    "pairs",
    [
        ("contact.unit_unit.cohesion=1 MPa", "contact.unit_unit.friction_angle=45 deg", "contact=1"),
        ("specimen.divisions.0=2", "specimen=5"),
        ("support.1.fix=x", "support=[]"),
        ("traction.0.stress.z=1", "traction=0"),
    ],
)
def test_a_table_set_after_its_keys_takes_their_place(capsys, pairs):
    said(capsys, "check", "couplet", *(word for pair in pairs for word in ("--set", pair)))


def test_a_lock_that_leads_elsewhere_is_not_written_through(tmp_path, capsys):
    (tmp_path / "mine").write_text("mine")
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / ".masonry-lock").symlink_to(tmp_path / "mine")
    (tmp_path / "s.toml").write_text(SWEEP)
    said(capsys, "sweep", str(tmp_path / "s.toml"), "--out", str(tmp_path / "out"))
    assert (tmp_path / "mine").read_text() == "mine"


def test_a_name_that_no_file_can_have_is_refused(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert "no name of a file" in said(capsys, "export", "couplet", "--to", "\ud800.step")
    for name in ("a\0b", "\ud800"):
        assert "no folder can have this name" in said(capsys, "run", "couplet", "--out", name)
    assert os.listdir() == []


def test_a_run_whose_folder_has_a_name_that_is_no_text_says_how_to_go_on(tmp_path):
    place = Checkpoints(tmp_path / "a\udcffb")
    place.begin("", {})
    assert b"masonry resume " + os.fsencode(place.results) in (place.folder / "HOW-TO-GO-ON.txt").read_bytes()

"""A cache folder that holds other things keeps them, whatever a command does; old code of ours goes."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from masonry.jit import compiler

SHORT = ["--set", "settle.steps=100", "--set", "drive.steps=2000", "--set", "solver.rows=40"]
BOX = """
v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1
f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8
"""
SWEEP = """
scene = "couplet"
settings = {"settle.steps" = 100, "drive.steps" = 2000, "solver.rows" = 40}
grid = {"confinement" = ["0.1 MPa"]}
"""
COMMANDS = [
    *(["list"], ["law", "friction"], ["doctor", "--quick"], ["check", "couplet"], ["limit", "arch-tilted"]),
    *(["import", "box.obj", "--unit", "m", "--out", "box.toml"], ["export", "couplet", "--to", "couplet.obj"]),
    *(["run", "couplet", *SHORT, "--out", "out", "--quiet"], ["plot", "out"], ["picture", "out"]),
    *(["picture", "couplet", "--geometry"], ["sweep", "sweep.toml", "--quiet"], ["paper", "--list"]),
    *(
        ["sensitivity", "couplet", *SHORT, "--only", "damping", "--quick", "--workers", "1"],
        ["verify", "incline", "--workers", "0"],
        ["resume", "out"],
    ),
]
EACH = """
import json, sys
from masonry.cli.main import main
print("codes", json.dumps([main(words) for words in json.loads(sys.argv[1])]))
"""


def foreign(root: Path) -> dict[Path, bytes]:
    """Eight folders and eight files that are not ours, some with names like ours; what each file holds."""
    names = ["thesis", "0123456789abcdef", "fedcba9876543210-plain", "cells", ".git", "checkpoint", "runs", "a b"]
    paths = [root / name / "chapter.txt" for name in names] + [root / f"{name}.txt" for name in names]
    tagged = root / "0123456789abcdef" / compiler.MARKER  # the marker of another program
    held = {path: f"{path}".encode() for path in paths} | {tagged: compiler.OURS.split(b"\n")[0] + b"\n# By pip.\n"}
    for path, content in held.items():
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)
        os.utime(path.parent, (0, 0))
    return held


def lost(held: dict[Path, bytes]) -> list[Path]:
    """What is not as it was."""
    return [path for path, content in held.items() if not path.is_file() or path.read_bytes() != content]


@pytest.mark.parametrize("place", [".", "masonry-dem"])
def test_old_code_of_ours_goes_and_nothing_else(place, tmp_path, monkeypatch):
    held = foreign(tmp_path / place)
    monkeypatch.setenv("MASONRY_CACHE", str(tmp_path))
    monkeypatch.delenv("MASONRY_LANES", raising=False)  # without lanes the folder has another name
    own = tmp_path / "masonry-dem"
    for number in range(12):
        monkeypatch.setattr(compiler, "source_hash", lambda _, number=number: f"{number:016x}")
        step, rest = map(Path, compiler._folders())
        assert (step, rest) == (own / f"{number:016x}", own / "cells")
        (step / "code.nbc").write_bytes(b"code")
        os.utime(step, (number + 1, number + 1))
    assert lost(held) == []
    assert sorted(path.name for path in own.glob("00*")) == [f"{n:016x}" for n in range(12 - compiler.KEPT, 12)]


def test_a_folder_that_was_there_is_used_and_never_marked(tmp_path, monkeypatch):
    monkeypatch.setenv("MASONRY_CACHE", str(tmp_path))
    monkeypatch.delenv("MASONRY_LANES", raising=False)
    monkeypatch.setattr(compiler, "source_hash", lambda _: "a" * 16)
    there = tmp_path / "masonry-dem" / ("a" * 16)
    there.mkdir(parents=True)
    assert compiler._folders()[0] == str(there) and not (there / compiler.MARKER).exists()


def test_no_command_harms_what_lies_in_the_cache_folder(tmp_path):
    """The code that other tests compiled is there already, by links."""
    cache = tmp_path / "cache"
    held = foreign(cache) | foreign(cache / "masonry-dem" / "deep") | foreign(cache / "masonry-dem" / "threads")
    for folder in (compiler.STEP, compiler.REST):
        (cache / "masonry-dem" / Path(folder).name).symlink_to(folder)
    work = tmp_path / "work"
    work.mkdir()
    (work / "box.obj").write_text(BOX)
    (work / "sweep.toml").write_text(SWEEP)
    done = subprocess.run(
        [sys.executable, "-c", EACH, json.dumps(COMMANDS)],
        cwd=work,
        env=os.environ | {"MASONRY_CACHE": str(cache)},
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    codes = json.loads(done.stdout.rpartition("codes ")[2])
    assert codes == [0] * len(COMMANDS), done.stderr
    assert lost(held) == []

"""A cache folder that holds other things keeps them, whatever a command does; old code of ours goes."""

import ctypes
import json
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from geometry import jit_cache
from masonry.cli import installed
from masonry.jit import cache_folder, compiler

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
    tagged = root / "0123456789abcdef" / cache_folder.MARKER  # the marker of another program
    held = {path: f"{path}".encode() for path in paths} | {tagged: cache_folder.OURS.split(b"\n")[0] + b"\n# By pip.\n"}
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
        monkeypatch.setattr(cache_folder, "source_hash", lambda _, number=number: f"{number:016x}")
        step, rest = map(Path, cache_folder.cache_folders())
        assert (step, rest) == (own / f"{number:016x}", own / "cells")
        (step / "code.nbc").write_bytes(b"code")
        os.utime(step, (number + 1, number + 1))
    assert lost(held) == []
    assert sorted(path.name for path in own.glob("00*")) == [f"{n:016x}" for n in range(12 - cache_folder.KEPT, 12)]


def test_a_folder_that_was_there_is_used_and_never_marked(tmp_path, monkeypatch):
    monkeypatch.setenv("MASONRY_CACHE", str(tmp_path))
    monkeypatch.delenv("MASONRY_LANES", raising=False)
    monkeypatch.setattr(cache_folder, "source_hash", lambda _: "a" * 16)
    there = tmp_path / "masonry-dem" / ("a" * 16)
    there.mkdir(parents=True)
    assert cache_folder.cache_folders()[0] == there and not (there / cache_folder.MARKER).exists()


@pytest.mark.parametrize("below", ["", "cells", "a" * 16])
@pytest.mark.parametrize(("mode", "word"), [(0o775, "may write"), (0o757, "may write"), (0o700, "another user")])
def test_a_folder_that_another_user_may_have_written_to_is_not_read(below, mode, word, tmp_path, monkeypatch):
    """What is kept there is run: its index is a pickle."""
    monkeypatch.setenv("MASONRY_CACHE", str(tmp_path))
    monkeypatch.delenv("MASONRY_LANES", raising=False)
    monkeypatch.setattr(cache_folder, "source_hash", lambda _: "a" * 16)
    cache_folder.cache_folders()
    place = tmp_path / "masonry-dem" / below
    assert place.stat().st_mode & 0o777 == 0o700
    place.chmod(mode)
    if word == "another user":
        monkeypatch.setattr(cache_folder, "require_own", other_user_at(place))
    monkeypatch.setattr(compiler, "NOWHERE", [])
    assert compiler._folders() == ("", "")
    assert word in compiler.NOWHERE[0] and f"'{place}'" in compiler.NOWHERE[0]
    good, words = installed.cached_code()
    assert not good and words.startswith(compiler.NOWHERE[0])


def test_where_nothing_can_be_kept_a_function_is_compiled_all_the_same(monkeypatch):
    monkeypatch.setattr(jit_cache, "NOWHERE", ["it is forbidden"])
    function = jit_cache.compiled(lambda number: 2.0 * number)
    assert function(2.0) == 4.0 and type(function._cache).__name__ == "NullCache"


def other_user_at(place: Path) -> Callable[[Path], None]:
    """`require_own` for a user to whom all belongs but one folder."""
    ask, euid = cache_folder.require_own, os.geteuid

    def require_own(folder: Path) -> None:
        with pytest.MonkeyPatch.context() as patched:
            patched.setattr(os, "geteuid", lambda: euid() + (folder == place))
            ask(folder)

    return require_own


def test_a_user_without_a_home_has_no_cache(monkeypatch):
    for name in ("MASONRY_CACHE", "XDG_CACHE_HOME"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setattr(
        Path, "home", lambda: (_ for _ in ()).throw(RuntimeError("Could not determine home directory."))
    )
    with pytest.raises(OSError, match=r"^Could not determine home directory\.$"):
        cache_folder.cache_folders()


def without_rights() -> None:
    """Take from root, in a process that is about to begin a program, the right to write where it may not."""
    drop_from_bounding_set, dac_override = 24, 1
    ctypes.CDLL(None).prctl(drop_from_bounding_set, dac_override, 0, 0, 0)


def test_where_nothing_can_be_kept_commands_say_so_and_do_what_they_are_told(tmp_path):
    (home := tmp_path / "home").mkdir()
    home.chmod(0o500)
    words = [
        ["check", "couplet"],
        ["run", "couplet", "--set", "law=elastic", *SHORT, "--out", "out", "--quiet"],
        ["limit", "arch-tilted", "--json"],
    ]
    surroundings = {key: value for key, value in os.environ.items() if key not in ("MASONRY_CACHE", "XDG_CACHE_HOME")}
    done = subprocess.run(
        [sys.executable, "-c", EACH, json.dumps(words)],
        cwd=tmp_path,
        env=surroundings | {"HOME": str(home), "MPLCONFIGDIR": str(tmp_path)},
        capture_output=True,
        text=True,
        preexec_fn=without_rights,
    )
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout.rpartition("codes ")[2]) == [0, 0, 0], done.stderr
    said = done.stderr.splitlines()
    assert len(said) == 3 and "Traceback" not in done.stdout
    assert all("compiled code is not kept" in line and f"'{home}' cannot be written to" in line for line in said)
    assert "could not be kept" in (tmp_path / "out" / "run.log").read_text() and not list(home.iterdir())


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

"""Systems that know less than this one: the substitutes for what they lack, chosen here, and what they forbid."""

import ast
import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from geometry import GeometryError
from geometry.files import atomic, sandbox
from geometry.files.sandbox import guarded
from geometry.operating_system import CHOICE, SYSTEM, Plain
from masonry.errors import SceneError
from masonry.jit import cache_folder
from masonry.runtime import lock
from masonry.runtime.lock import LOCK, is_lock, sole

HOUSE = Path(__file__).resolve().parents[2]
PLAIN = Plain()


@pytest.mark.parametrize(
    "path",
    [
        *("C:/walls/results", "walls\\results", "../my wall.toml", "./.hidden", "consol.toml", "com.toml", "wall-1.5"),
        *("mur-pierré", "壁"),
    ],
)
def test_names_that_every_system_has(path):
    assert PLAIN.is_name(path) and SYSTEM.is_name(path)


@pytest.mark.parametrize(
    "path", ["con", "walls/AUX.toml", "lpt1", "wall: 2", "what?", "a|b", "wall.", "wall /x", 'a"b']
)
def test_names_that_windows_keeps_are_refused_there_only(path, monkeypatch, tmp_path):
    assert SYSTEM.is_name(path) and not PLAIN.is_name(path)
    monkeypatch.setattr(atomic, "SYSTEM", PLAIN)
    with pytest.raises(GeometryError, match="this is no name of a file"), atomic.whole_file(tmp_path / path):
        pytest.fail("a name that Windows keeps")


def test_a_file_that_another_program_has_open_for_a_moment_is_replaced_all_the_same(monkeypatch, tmp_path):
    refused = in_use(monkeypatch, 2)
    with atomic.WholeFiles(tmp_path) as files:
        files.text("curve.csv", "new")
    assert (tmp_path / "curve.csv").read_text() == "new" and not refused


def test_a_file_that_stays_open_in_another_program_is_named_and_stays(monkeypatch, tmp_path):
    (tmp_path / "curve.csv").write_text("old")
    in_use(monkeypatch, 99)
    with (
        pytest.raises(GeometryError, match=r"'curve\.csv' cannot be replaced; is it open in another program\?"),
        atomic.whole_file(tmp_path / "curve.csv") as path,
    ):
        path.write_text("new")
    assert [entry.name for entry in tmp_path.iterdir()] == ["curve.csv"]
    assert (tmp_path / "curve.csv").read_text() == "old"


def in_use(monkeypatch, times: int) -> list[int]:
    """Have a system refuse so many times to replace a file; what is left of them."""
    left, replace = list(range(times)), os.replace

    def refusing(path: Path, target: Path) -> None:
        if left:
            left.pop()
            raise PermissionError(13, "Access is denied", str(target))
        replace(path, target)

    monkeypatch.setattr(os, "replace", refusing)
    monkeypatch.setattr(atomic, "SYSTEM", PLAIN)
    return left


def test_a_lock_that_cannot_be_read_is_that_of_another_process(monkeypatch, tmp_path):
    with sole(tmp_path, "runs a scene into it"):
        monkeypatch.setattr(Path, "read_bytes", forbidden)
        monkeypatch.setattr(Path, "read_text", forbidden)
        assert not is_lock(tmp_path / LOCK)
        monkeypatch.setattr(lock, "SYSTEM", PLAIN)
        with pytest.raises(SceneError, match="is in use: another process writes to it"), sole(tmp_path, "runs as well"):
            pytest.fail("two at once")


def test_a_lock_goes_where_open_files_cannot_be_removed(monkeypatch, tmp_path):
    monkeypatch.setattr(lock, "SYSTEM", PLAIN)
    unlink = Path.unlink

    def unlink_closed(path: Path, missing_ok: bool = False) -> None:
        if any(os.path.samefile(f"/proc/self/fd/{fd}", path) for fd in open_files()):
            forbidden(path)
        unlink(path, missing_ok)

    monkeypatch.setattr(Path, "unlink", unlink_closed)
    with sole(tmp_path, "runs a scene into it"), pytest.raises(PermissionError):
        (tmp_path / LOCK).unlink()
    assert not any(tmp_path.iterdir())


def open_files() -> list[str]:
    return [fd for fd in os.listdir("/proc/self/fd") if os.path.exists(f"/proc/self/fd/{fd}")]


def forbidden(path: Path, *words: object, **named: object) -> None:
    raise PermissionError(13, "Permission denied", str(path))


def test_code_is_kept_where_a_system_does_not_tell_who_may_write(monkeypatch, tmp_path):
    tmp_path.chmod(0o777)
    with pytest.raises(OSError, match="other users may write"):
        cache_folder.require_own(tmp_path)
    monkeypatch.setattr(cache_folder, "SYSTEM", PLAIN)
    cache_folder.require_own(tmp_path)


def test_a_reader_that_loops_is_stopped_where_no_system_sees_to_it(monkeypatch, tmp_path):
    monkeypatch.setenv(CHOICE, "plain")
    monkeypatch.setattr(sandbox, "SYSTEM", PLAIN)
    monkeypatch.setattr(sandbox, "START", 1)
    monkeypatch.setattr(sandbox, "PATIENCE", 60)
    (tmp_path / "any.txt").write_text("x")
    with pytest.raises(GeometryError, match="more than 1 s of processor time"):
        guarded("tests.geometry.files.bad_readers", "loop", tmp_path / "any.txt")


def test_a_full_disk_is_no_reader_that_has_gone_and_a_closed_pipe_of_windows_is_one():
    for system in (PLAIN, SYSTEM):
        assert system.is_reader_gone(BrokenPipeError(32, "Broken pipe"))
        assert not system.is_reader_gone(OSError(28, "No space left on device"))
        assert not system.is_reader_gone(OSError(22, "Invalid argument", "a?.csv"))
    assert PLAIN.is_reader_gone(OSError(22, "Invalid argument"))


def test_a_run_leaves_the_same_numbers_on_a_system_that_knows_nothing(tmp_path):
    short = ("run", "couplet", "--set", "drive.accuracy=10 %", "--set", "confinement=0.13 MPa")
    plain, here = (made(tmp_path / system, system, *short) for system in ("plain", "linux"))
    assert plain == here
    again = masonry("plain", *short, "--out", str(tmp_path / "plain"))
    assert again.returncode == 2 and "is not empty" in again.stderr


def made(folder: Path, system: str, *words: str) -> tuple[list[str], str, dict[str, object]]:
    """Files of a run, its curve and its numbers but those of time and place."""
    done = masonry(system, *words, "--out", str(folder))
    assert done.returncode == 0, done.stderr
    numbers = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    timeless = {key: value for key, value in numbers.items() if "second" not in key and key != "run"}
    return sorted(path.name for path in folder.iterdir()), (folder / "curve.csv").read_text(), timeless


def masonry(system: str, *words: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "masonry", *words]
    return subprocess.run(command, env={**os.environ, CHOICE: system}, cwd=HOUSE, capture_output=True, text=True)


def test_every_text_file_is_read_and_written_in_an_encoding_that_is_named():
    folders = ("geometry", "masonry", "verification")
    files = [path for folder in folders for path in (HOUSE / folder).rglob("*.py")]
    unnamed = [f"{path.relative_to(HOUSE)}, line {line}" for path in files for line in without_encoding(path)]
    assert len(files) > 900 and not unnamed


def without_encoding(path: Path) -> list[int]:
    """Lines of a source in which text is read or written in whatever encoding a system has."""
    source = path.read_text(encoding="utf-8")
    if not any(f"{word}(" in source for word in ("open", "read_text", "write_text")):
        return []
    calls = [node for node in ast.walk(ast.parse(source)) if isinstance(node, ast.Call)]
    return [call.lineno for call in calls if opens_text(call) and not any(k.arg == "encoding" for k in call.keywords)]


def opens_text(call: ast.Call) -> bool:
    name = call.func.attr if isinstance(call.func, ast.Attribute) else getattr(call.func, "id", "")
    if name in ("read_text", "write_text"):
        return True
    modes = [word.value for word in call.args if isinstance(word, ast.Constant) and isinstance(word.value, str)]
    is_builtin = isinstance(call.func, ast.Name) and name == "open"
    return (is_builtin or (name == "open" and bool(modes))) and not any("b" in mode for mode in modes)


def test_a_process_ends_with_the_one_that_began_it_and_has_an_empty_standard_input():
    code = (
        "import sys, time; from geometry.child_python import end_with_parent; end_with_parent()\n"
        "print(repr(sys.stdin.read()), flush=True); time.sleep(600)"
    )
    child = subprocess.Popen([sys.executable, "-c", code], cwd=HOUSE, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    assert child.stdout.readline().strip() == b"''" and child.poll() is None
    child.stdin.close()
    assert child.wait(60) == 1
    child.stdout.close()

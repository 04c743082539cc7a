"""Compiled code is kept between runs: a second process compiles nothing, no edit of a source is served stale, and a
damaged file counts as absent."""

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

import pytest

from masonry.jit import sources

ROOT = Path(__file__).resolve().parents[2]
SHORT = ["law=elastic", "settle.steps=100", "drive.steps=600", "solver.rows=10"]
RUN = """
import json, sys
from numba.core import event
compiled, kept = [], []
class Listener(event.Listener):
    def on_start(self, what):
        dispatcher = what.data["dispatcher"]
        compiled.append(dispatcher.py_func.__qualname__)
        if type(dispatcher._cache).__name__ == "CheckedCache": kept.append(compiled[-1])
    def on_end(self, what): pass
event.register("numba:compile", Listener())
import masonry
assert masonry.__file__.startswith(sys.argv[1])
told = []
scene = masonry.load("couplet", sys.argv[2:])
result = masonry.run(scene, progress=lambda step, steps, note: told.append(f"{step} {note}"))
tools = "numba.np.arraymath" in sys.modules
rows = result.history.rows
print(json.dumps([compiled, [*rows["stress"], *rows["elastic_contacts"]], tools, kept, told]))
"""


class Ran(NamedTuple):
    """What a run compiled, its stresses and what its contacts store, whether it loaded what Numba compiles array
    functions with, what of it is kept, as it is not linked into other functions alone, and what its progress said."""

    compiled: list[str]
    numbers: list[float]
    tools: bool
    kept: list[str]
    told: list[str]


class Copy:
    """A copy of the package with a cache of its own."""

    def __init__(self, root: Path) -> None:
        self.root = root
        for package in ("geometry", "masonry"):
            shutil.copytree(ROOT / package, root / package, ignore=shutil.ignore_patterns("__pycache__"))

    def run(self, cache: Path | None = None) -> Ran:
        """Run a short scene in a process of its own, with its own cache or another one."""
        surroundings = os.environ | {"PYTHONPATH": str(self.root), "MASONRY_CACHE": str(cache or self.root / "cache")}
        done = subprocess.run(
            [sys.executable, "-c", RUN, str(self.root), *SHORT],
            cwd=self.root,
            env=surroundings,
            capture_output=True,
            text=True,
        )
        assert done.returncode == 0, done.stderr
        return Ran(*json.loads(done.stdout))

    def edit(self, file: str, pattern: str, by: str) -> None:
        """Change the first place in a file that fits a pattern."""
        path = self.root / file
        text, count = re.subn(pattern, by, path.read_text(encoding="utf-8"), count=1)
        assert count == 1, f"{file} no longer holds {pattern}: name another place whose edit changes a run"
        path.write_text(text, encoding="utf-8")


@pytest.fixture(scope="module")
def used(tmp_path_factory) -> tuple[Copy, Ran]:
    """A copy that ran once, and what it found."""
    copy = Copy(tmp_path_factory.mktemp("package"))
    first = copy.run()
    assert "_kick" in first.compiled and first.tools
    return copy, first


def test_a_second_process_compiles_nothing_whatever_was_edited_that_is_not_compiled(used):
    copy, first = used
    for file in ("masonry/model/model.py", "masonry/laboratory/laboratory.py", "geometry/joints/find.py"):
        copy.edit(file, r"\Z", "# a remark\n")
    again = copy.run()
    assert again == Ran([], first.numbers, tools=False, kept=[], told=again.told)
    assert not any("compiling" in note for note in again.told) and any(note.startswith("700 ") for note in again.told)


def test_compiling_is_told_once_before_the_first_step(used):
    (told,) = [note for note in used[1].told if "compiling" in note]
    assert told.startswith("0 compiling the step for rigid blocks, law elastic (once for all such scenes")


def test_a_cache_with_damaged_files_is_one_without_them(used, tmp_path):
    copy, first = used
    shutil.copytree(copy.root / "cache", tmp_path, dirs_exist_ok=True)
    files = [path for kind in ("nbi", "nbc") for path in tmp_path.rglob(f"*.{kind}")]
    assert len(files) > 4
    for number, path in enumerate(files):
        content = bytearray(path.read_bytes())
        content[len(content) // 2] ^= 255
        path.write_bytes([bytes(content), content[: len(content) // 2], b""][number % 3])
    anew = copy.run(tmp_path)
    assert anew.numbers == first.numbers and "_kick" in anew.compiled
    written = {path: path.stat().st_mtime_ns for path in files}
    again = copy.run(tmp_path)
    assert again.numbers == first.numbers and again.compiled == []
    assert {path: path.stat().st_mtime_ns for path in files} == written


def test_the_key_of_the_cache_changes_with_a_byte_in_any_room_that_is_compiled_into_a_step(tmp_path, monkeypatch):
    """The rooms are all folders where a function is compiled into others, whatever COMPILED says."""
    root = Copy(tmp_path).root
    monkeypatch.setattr(sources, "__file__", str(root / "masonry/jit/sources.py"))
    compiled = re.compile(r"^from masonry\.jit\.(compiler import .*\b(inner|inlined|jit)\b|extending)", re.M)
    files = [file for file in sorted(root.rglob("*.py")) if compiled.search(file.read_text(encoding="utf-8"))]
    rooms = {file.parent: file for file in files}
    assert {"detection", "kernels", "kinematics", "laws", "patches", "simd"} <= {room.name for room in rooms}
    keys = {sources.source_hash.__wrapped__(sources.COMPILED)}
    for count, file in enumerate(rooms.values(), start=2):
        file.write_bytes(file.read_bytes() + b"\n")
        keys.add(sources.source_hash.__wrapped__(sources.COMPILED))
        assert len(keys) == count, f"an edit of {file} is not seen: add its folder to COMPILED"


EDITS = {
    "law": ("masonry/laws/elastic.py", r"0\.5 \* tau_squared", "0.499 * tau_squared"),
    "kernel": ("masonry/kernels/step.py", r"\] = shared\[SPEED\]", "] = 0.999 * shared[SPEED]"),
    "kinematics": ("masonry/kinematics/rigid.py", r"\+ dt \* take", "+ 0.999 * dt * take"),
}


@pytest.mark.parametrize("kind", ["law", *(pytest.param(kind, marks=pytest.mark.slow) for kind in list(EDITS)[1:])])
def test_an_edit_of_a_law_a_kernel_or_a_kinematics_changes_the_next_run(used, kind):
    copy, first = used
    file = EDITS[kind][0]
    before = (copy.root / file).read_text(encoding="utf-8")
    copy.edit(*EDITS[kind])
    edited = copy.run()
    (copy.root / file).write_text(before, encoding="utf-8")
    assert edited.compiled
    assert edited.numbers != first.numbers

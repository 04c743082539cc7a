"""Standard output and error closed or full, a cache on a full disk: the run is done all the same."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.faults.samples import SHORT, disk

BUFFERED = {name: value for name, value in os.environ.items() if name != "PYTHONUNBUFFERED"}
"""As in a shell: what could not be written stays in a buffer, and Python tries it again as it ends."""

SCENE = [sys.executable, "-m", "masonry", "run", "couplet", *SHORT]


def shell(words: list[str], after: str, **more) -> subprocess.CompletedProcess:
    """A command from a shell, with what stands after it there."""
    quoted = " ".join(f"'{word}'" for word in words)
    return subprocess.run(["bash", "-c", f"{quoted} {after}"], capture_output=True, text=True, env=BUFFERED, **more)


@pytest.mark.parametrize("after", [">&-", "2>&-", "2>/dev/full", ">&- 2>&-"])
def test_a_run_needs_nobody_to_talk_to(after, tmp_path):
    done = shell([*SCENE, "--out", str(tmp_path / "out")], after)
    assert done.returncode == 0 and "Traceback" not in done.stdout + done.stderr
    assert json.loads((tmp_path / "out" / "summary.json").read_text())["steps"] > 2000


@pytest.mark.parametrize("command", [["list"], ["law", "linear"]])
def test_output_that_cannot_be_written_is_said_in_one_line(command):
    done = shell([sys.executable, "-m", "masonry", *command], ">/dev/full")
    assert done.returncode == 2 and done.stderr.count("\n") == 1 and "No space left" in done.stderr


def test_a_mistake_keeps_its_exit_code_where_nobody_hears_it():
    assert shell([sys.executable, "-m", "masonry", "check", "nix"], "2>/dev/full").returncode == 2


RUN = """
import sys
import masonry
from geometry.jit_cache import NOT_KEPT
result = masonry.run(masonry.load("couplet", ["law=elastic", "settle.steps=100", "drive.steps=600", "solver.rows=10"]))
said = any("could not be kept" in line for line in result.log)
print(result.history.rows["stress"].tolist(), len(NOT_KEPT) > 0, said)
"""


def stresses(cache: Path) -> list[str]:
    """What a short run in a process of its own finds, whether something could not be kept, and whether it says so."""
    done = subprocess.run(
        [sys.executable, "-c", RUN], env=os.environ | {"MASONRY_CACHE": str(cache)}, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    return done.stdout.split("] ")


@pytest.fixture(scope="module")
def used(tmp_path_factory) -> tuple[Path, list[str]]:
    """A cache that a run has filled, and what the run found."""
    cache = tmp_path_factory.mktemp("cache")
    return cache, stresses(cache)


@pytest.mark.slow
def test_a_cache_on_a_full_disk_is_gone_without_and_the_log_says_so(used, tmp_path):
    whole = used[1]
    with disk(tmp_path / "small", "100k") as small:
        stress = stresses(small)
    assert stress[0] == whole[0]
    assert (whole[1].split(), stress[1].split()) == (["False", "False"], ["True", "True"])

"""Settings of other programs in the environment, which are none of ours, and a title as long as a book."""

import os
import subprocess
import sys

import pytest

from masonry.pictures.style import LONGEST_TITLE, plain
from tests.faults.samples import SHORT


def masonry(*words: str, **settings: str) -> subprocess.CompletedProcess:
    """A command with some variables of the environment."""
    return subprocess.run(
        [sys.executable, "-m", "masonry", *words], env=os.environ | settings, capture_output=True, text=True
    )


def test_pictures_are_drawn_whatever_backend_is_set_for_notebooks(tmp_path):
    done = masonry("run", "couplet", *SHORT, "--quiet", "--out", str(tmp_path), MPLBACKEND="nonsense")
    assert done.returncode == 0 and not done.stderr
    assert (tmp_path / "curve.png").is_file() and (tmp_path / "cracks.png").is_file()


def test_a_threading_layer_that_does_not_exist_is_said_in_one_line(tmp_path):
    out = tmp_path / "out"
    done = masonry("run", "couplet", *SHORT, "--threads", "2", "--quiet", "--out", str(out), NUMBA_THREADING_LAYER="no")
    assert done.returncode == 2 and done.stderr.count("\n") == 1 and "NUMBA_THREADING_LAYER" in done.stderr
    assert not out.exists()


@pytest.mark.parametrize("command", ["verify", "paper"])
def test_commands_need_no_docstrings(command):
    done = masonry(command, "--list", PYTHONOPTIMIZE="2")
    assert done.returncode == 0 and "couplet" in done.stdout


def test_a_title_as_long_as_a_book_is_cut_where_it_is_drawn():
    title = plain("word " * 100_000)
    assert len(title) == LONGEST_TITLE and title.endswith("...")

"""Processes that need the same compiled code at once: one compiles it, the others wait and load it."""

import json
import os
import subprocess
import sys

import pytest

from tests.cli.test_cache import RUN

CELLS = ("law=elastic", "settle.steps=100", "drive.steps=600", "solver.rows=10", "specimen.cells.per_unit=3")


@pytest.mark.slow
def test_of_two_processes_that_start_together_no_function_is_compiled_by_both(tmp_path):
    """Neither of the step nor of the cells, which are two rounds of it."""
    surroundings = os.environ | {"MASONRY_CACHE": str(tmp_path)}
    command = [sys.executable, "-c", RUN, "", *CELLS]
    both = [subprocess.Popen(command, env=surroundings, stdout=subprocess.PIPE, text=True) for _ in range(2)]
    one, other = (set(json.loads(process.communicate(timeout=300)[0])[0]) for process in both)
    assert "advance" in one | other and len(one | other) > 30
    assert not one & other

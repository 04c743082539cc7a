"""Many processes that need the same step at once: one compiles it, the others wait and load it."""

import json
import os
import subprocess
import sys

from tests.cli.test_cache import RUN, SHORT

SCENES = {"step": SHORT, "cells": [*SHORT, "specimen.cells.per_unit=3"]}


def test_of_two_processes_that_start_together_one_compiles_the_step_and_the_cells(tmp_path):
    """Cells are drawn by other compiled functions than the step; both are asked for by the second scene."""
    surroundings = os.environ | {"MASONRY_CACHE": str(tmp_path / "cache")}
    command = [sys.executable, "-c", RUN, "", *SCENES["cells"]]
    both = [subprocess.Popen(command, env=surroundings, stdout=subprocess.PIPE, text=True) for _ in range(2)]
    compiled = [json.loads(process.communicate(timeout=300)[0])[0] for process in both]
    assert "advance" in compiled[0] + compiled[1]
    assert sorted(map(len, compiled))[0] == 0, f"both compiled: {sorted(set(compiled[0]) & set(compiled[1]))[:5]}"

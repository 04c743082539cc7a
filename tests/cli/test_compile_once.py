"""Processes that need the same compiled code at once: one compiles it, the others wait and load it."""

import json
import os
import subprocess
import sys

import pytest

from masonry.assembly.assemble import assemble
from masonry.laboratory.summary.provenance import PROCESSOR, provenance_of
from masonry.scene import load, to_toml
from masonry.timeloop.compiled_step import compile_for
from tests.cli.test_cache import RUN

CELLS = ("law=elastic", "settle.steps=100", "drive.steps=600", "solver.rows=10", "specimen.cells.per_unit=3")


@pytest.mark.slow
def test_of_two_processes_that_start_together_no_part_is_compiled_by_both(tmp_path):
    """Neither of the step nor of the cells, which are two rounds of it. What Python calls besides is small: each
    compiles that for itself."""
    surroundings = os.environ | {"MASONRY_CACHE": str(tmp_path)}
    command = [sys.executable, "-c", RUN, "", *CELLS]
    both = [subprocess.Popen(command, env=surroundings, stdout=subprocess.PIPE, text=True) for _ in range(2)]
    one, other = (set(json.loads(process.communicate(timeout=300)[0])[3]) for process in both)
    assert "_kick" in one | other and len(one | other) > 5
    assert not {name for name in one & other if name.startswith("_")}


def test_what_is_compiled_for_one_processor_is_not_there_for_another():
    """Machines that share a cache: the first one of each kind compiles, while the others wait, and says so. The other
    one here is so old that nobody compiles for it."""
    scene = load("couplet")
    here = provenance_of(to_toml(scene))[PROCESSOR]
    compile_for(assemble(scene).model, 1)
    assert json.loads(asked(os.environ)) == [True, here]
    for features in ("", "+sse4.1"):
        other = os.environ | {"NUMBA_CPU_NAME": "penryn", "NUMBA_CPU_FEATURES": features}
        assert json.loads(asked(other)) == [False, f"{here.split()[0]} penryn {features}".strip()]


IS_IT_THERE = """
import json
from masonry.assembly.assemble import assemble
from masonry.laboratory.summary.provenance import PROCESSOR, provenance_of
from masonry.scene import load, to_toml
from masonry.timeloop.compiled_step import is_compiled
scene = load("couplet")
print(json.dumps([is_compiled(assemble(scene).model, 1), provenance_of(to_toml(scene))[PROCESSOR]]))
"""


def asked(surroundings) -> str:
    command = [sys.executable, "-c", IS_IT_THERE]
    return subprocess.run(command, env=surroundings, capture_output=True, text=True, timeout=300, check=True).stdout

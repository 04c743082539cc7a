"""Start-up: what a user waits for before the first step, each in processes of its own.

Gates are ratios to what any program of this kind must pay: a bare process that imports numpy and numba and finds one
trivial function in its cache, with Numba's own cache, which loads the tools of compiling as well; and the time in which
Numba compiles one hand-written loop. They compare processor time, which other work on the machine disturbs less.
What a user waits by the clock is shown beside it, and is no gate: it is a matter of what else the machine does.
"""

import os
import subprocess
import sys
import time
from collections.abc import Callable

import numpy as np
import pytest

from verification.reference_step.interleaved import require

ROUNDS = 9
WORST = "wallette-mode-2-218"
"""The shipped scene that compiles longest: cells, two laws, dead loads."""
BARE = "import sys; sys.path.insert(0, sys.argv[1]); import bare"
BARE_MODULE = """
import numba
import numpy as np

@numba.njit(cache=True)
def total(values):
    s = 0.0
    for v in values:
        s += v
    return s

total(np.zeros(3))
"""
FIRST_STEP = """
import numpy as np
from masonry import scene; from masonry.laboratory import laboratory; from masonry.timeloop import compiled_step
from masonry.configuration.chunk import Chunk
assembly = laboratory.assemble(scene.load("couplet", ["drive.steps=1000"]))
compiled_step.compile_for(assembly.model, 1)
chunk = Chunk(assembly.plan.dead_load[:2], assembly.plan.speed[:2], row=False)
compiled_step.advance_model(assembly.model, chunk, 1, 0, 1, np.zeros(1))
"""
COLD = """
import sys, time
import numba, numpy as np
from masonry import scene; from masonry.laboratory import laboratory; from masonry.timeloop import compiled_step
from masonry.assembly.assemble import assemble

def loop(force, u, sides, stiffness):
    for c in range(len(sides)):
        a, b = sides[c, 0], sides[c, 1]
        for k in range(3):
            force[c, k] = stiffness * (u[b, k] - u[a, k])

arrays = np.zeros((4, 3)), np.zeros((4, 3)), np.zeros((4, 2), dtype=np.int64), 1.0
numba.njit(loop)(*arrays)  # what every first compile pays once
reference = []
for _ in range(5):
    begun = time.process_time()
    numba.njit(loop)(*arrays)
    reference.append(time.process_time() - begun)
loaded = scene.load(sys.argv[1])
begun, cpu = time.perf_counter(), time.process_time()
assembly = assemble(loaded)
compiled_step.compile_for(assembly.model, 1)
print(time.perf_counter() - begun, time.process_time() - cpu, min(reference))
"""


def process(code: str, *words: str, cache, **more) -> str:
    """What a process of its own prints, with a cache of its own, for bytecode too, which some machines keep nowhere."""
    own = {"MASONRY_CACHE": f"{cache}", "PYTHONPYCACHEPREFIX": f"{cache}-bytecode", "PYTHONDONTWRITEBYTECODE": ""}
    done = subprocess.run(
        [sys.executable, *(["-c", code] if code else ["-m", "masonry"]), *words],
        env=os.environ | own | {"NUMBA_NUM_THREADS": "1"},
        capture_output=True,
        text=True,
        **more,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def clocks(work: Callable[[], object]) -> tuple[float, float]:
    """Seconds, and seconds of processor, that the processes of a work take."""
    begun, before = time.perf_counter(), os.times()
    work()
    after = os.times()
    return time.perf_counter() - begun, sum(after[2:4]) - sum(before[2:4])


@pytest.fixture(scope="module")
def cold(tmp_path_factory):
    """Seconds, seconds of processor, and those of the reference loop: from nothing to a compiled step, by scene."""
    found = {}
    for name in ("couplet", WORST):
        folder = tmp_path_factory.mktemp(name)
        found[name] = folder, np.array(process(COLD, name, cache=folder).split(), dtype=float)
    return found


def test_a_scene_that_was_never_run_is_compiled_in_time(cold, figure):
    for name, (_, (seconds, busy, reference)) in cold.items():
        figure(f"cold compile, {name}", float(seconds), "s", reach=30.0)
        figure(f"cold compile, {name}, processor time", float(busy), "s", reach=30.0)
        require(busy / reference, 500.0, f"compiling {name}, over one hand-written loop")


def test_a_second_run_starts_at_once(cold, figure, tmp_path):
    cache = cold["couplet"][0]
    (tmp_path / "bare.py").write_text(BARE_MODULE, encoding="utf-8")
    run = ("run", "couplet", "--quiet", "--overwrite", "--out", str(tmp_path / "out"))
    works = {
        "bare process: numba, and one function from its cache": lambda: process(BARE, str(tmp_path), cache=cache),
        "warm start to the first step, couplet": lambda: process(FIRST_STEP, cache=cache),
        "masonry --help": lambda: process("", "--help", cache=cache),
        "import masonry": lambda: process("import masonry", cache=cache),
        "whole second run, couplet": lambda: process("", *run, cache=cache),
    }
    taken = np.array([[clocks(work) for work in works.values()] for _ in range(ROUNDS + 1)])[1:]
    (wall, busy), upper = taken.min(axis=0).T, np.quantile(taken[..., 0], 0.75, axis=0)
    for k, (name, reach) in enumerate(zip(works, (None, 1.5, 0.3, None, 2.5), strict=True)):
        figure(name, float(wall[k]), "s", reach=reach, spread=float(upper[k] / wall[k] - 1))
        figure(f"{name}, processor time", float(busy[k]), "s")
    require(busy[1] / busy[0], 1.2, "to the first step, over a bare process with numba")  # [1.12]
    require(busy[2] / busy[0], 0.15, "masonry --help, over a bare process with numba")  # [0.05]
    require(busy[3] / busy[0], 0.15, "import masonry, over a bare process with numba")
    require(busy[4] / busy[0], 3.2, "a whole second run, over a bare process with numba")  # [2.3; 2.7 with other work]

"""What a step needs besides time: no memory of its own, arrays hardly larger than by hand, and a bearable compile."""

import json
import os
import subprocess
import sys
import tracemalloc
from pathlib import Path

import pytest
from numba.core.runtime import _nrt_python, rtsys

from masonry import scene
from masonry.assembly.assemble import assemble
from verification.reference_step import models, specimens
from verification.reference_step.interleaved import require
from verification.reference_step.reference import ReferenceStep


def shipped():
    """A scene with all that the wallettes have."""
    return assemble(scene.load("wallette-mode-1")).model


def tets():
    """Bricks of tets."""
    return models.model_of(*specimens.bricks((4, 1, 4), (2, 2, 2)), kind="tets")


def allocations(model, steps: int, threads: int) -> int:
    """How often the compiled code asks for memory in one call of `steps` steps."""
    take = models.stepping(model, steps, threads)
    take()
    _nrt_python.memsys_enable_stats()
    before = rtsys.get_allocation_stats().alloc
    take()
    return rtsys.get_allocation_stats().alloc - before


@pytest.mark.parametrize(("made", "threads"), [(shipped, 1), (tets, 1), (tets, 2)])
def test_a_step_allocates_nothing(made, threads):
    model = made()
    few, many = (allocations(model, steps, threads) for steps in (10, 1000))
    assert few == many, f"10 steps make {few} allocations, 1000 steps make {many}: a step must make none"


MEMORY = {
    "rigid block": (lambda: (*specimens.wall(40, 40), None), "rigid", lambda model: model.blocks.count),
    "tet": (lambda: specimens.bricks((6, 6, 6), (4, 4, 5)), "tets", lambda model: len(model.layout.mesh.tets)),
}


@pytest.mark.parametrize("item", MEMORY)
def test_the_arrays_of_a_step_are_hardly_larger_than_by_hand(figure, item):
    make, kind, count = MEMORY[item]
    blocks, joints, mesh = make()
    tracemalloc.start()
    model = models.model_of(blocks, joints, mesh, kind=kind)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    ours, by_hand, items = models.step_bytes(model), ReferenceStep(model).size(), count(model)
    figure(f"arrays of a step, per {item}", ours / items, "bytes")
    figure("  by hand", by_hand / items, "bytes")
    figure(f"whole model, per {item}", models.size_of(model) / items, "bytes")
    figure(f"most while a model is built, per {item}", peak / items, "bytes")
    require(ours / by_hand, 1.2, f"memory of a step per {item}")
    require(peak / by_hand, 8.0, f"memory while a model is built, per {item}")


COMPILE = """
import json, time
from verification.reference_step import specimens, models
from verification.reference_step.reference import ReferenceStep
model = models.model_of(*specimens.wall(4, 4))
pairs = models.model_of(*specimens.bricks((2, 1, 1), (1, 1, 1)), kind="tets")
ReferenceStep(pairs, "elastic", damped=False, booked=False).stepping(1)()  # what the compiler does only once
taken = []
for work in (ReferenceStep(model).stepping(1), models.stepping(model, 1)):
    begun = time.process_time()
    work()
    taken.append(time.process_time() - begun)
print(json.dumps(taken))
"""


def test_a_step_compiles_in_a_small_multiple_of_the_time_by_hand(figure, tmp_path):
    environment = {**os.environ, "MASONRY_CACHE": str(tmp_path)}
    command, root = [sys.executable, "-c", COMPILE], Path(__file__).parents[1]
    said = subprocess.run(command, cwd=root, env=environment, capture_output=True, text=True, check=True).stdout
    by_hand, ours = json.loads(said.splitlines()[-1])
    figure("compile of a step of rigid blocks, nothing cached", ours, "s")
    figure("  by hand", by_hand, "s")
    require(ours / by_hand, 8.0, "compile of a step")  # [6.2: the law for lanes and for the rest, one by one]

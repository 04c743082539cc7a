"""The largest walls: 50,000 rigid blocks for 1,000 steps, a million tets, and dry walls of 100 to 50,000 bricks that
fall 1 mm on a floor, in large displacement: `python -m benchmarks.giants`.

Each in a process of its own, on one thread, whose largest resident memory is read at its end; a million tets must fit
in 8 GB, and what falls in 4 GB. Seconds are of the processor. A step is compared with that of a small scene of the same
kind, which lies in the cache, in turn with it; and the bytes that it must move with what the machine moves in a triad
(a = b + 3 c, McCalpin 1995) at the same time. What is more than that scene costs is memory, where the share is near 1.
Too long for `make bench`: some minutes, and up to 3 GB.
"""

import math
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import numpy as np

from benchmarks.growing import Fall, Wall, items, stepper
from masonry.assembly.assemble import Assembly, assemble
from masonry.jit.compiler import jit
from masonry.laboratory.laboratory import result_of
from masonry.model.model import Model
from masonry.scene import Scene
from masonry.timeloop import timeloop
from masonry.timeloop.timeloop import Outcome


class Giant(NamedTuple):
    """A scene, a small one of the same kind, and the bytes that the large one may hold in memory."""

    scene: Scene
    small: Scene
    memory: float


GIANTS = {
    "rigid": Giant(Wall(56, 56).scene("drive.steps=1000", "solver.rows=10"), Wall(7, 6).scene(), 8e9),
    "tets": Giant(
        Wall(100, 52, mesh="fan").scene("drive.steps=100", "solver.rows=10"), Wall(7, 6, mesh="fan").scene(), 8e9
    ),
    **{
        f"falling-{n * m}": Giant(Fall(n, m).scene(), Fall(10, 10).scene(), 4e9)
        for n, m in ((10, 10), (25, 40), (100, 100), (200, 250))
    },
}
ROUNDS = 12
PASSES = {
    **{"u": 2, "force": 2, "arm": 2, "q": 2, "v": 3, "work": 2, "inner": 2},
    **{"dissipated": 0, "bounds": 0, "load": 0, "change": 0, "guess": 0},
}
"""How often a step in small displacement reads or writes each array, where that is not once: points are displaced,
contacts sweep them, and blocks gather forces, each in a pass of its own. What nothing damages is not written."""
TRIAD = 8_000_000
"""Numbers in each of three arrays, more than caches hold."""
HEAD = (
    f"{'':14}{'blocks':>8}{'items':>9}{'set-up':>9}{'run':>9}{'step':>9}{'of small':>10}{'bytes':>7}{'moved':>10}"
    f"{'of triad':>10}{'output':>9}{'memory':>9}"
)


class Step(NamedTuple):
    """ns per item and step, of a small scene, bytes per item, and GB/s of a triad; nan where that is not known."""

    cost: float
    small: float
    bytes: float = math.nan
    triad: float = math.nan


def seconds_of(work: Callable[[], object]) -> float:
    """Seconds of processor of one call."""
    begun = time.process_time()
    work()
    return time.process_time() - begun


def bytes_of_step(model: Model) -> float:
    """Bytes that a step in small displacement must move, caches left out."""
    passes: dict[int, tuple[int, float]] = {}

    def collect(value: object, name: str) -> None:
        if isinstance(value, np.ndarray) and value.size:
            size = max(value.nbytes, len(value) * abs(value.strides[0]))
            passes[value.ctypes.data] = PASSES.get(name, 1), size
        elif isinstance(value, tuple):
            for field, part in zip(getattr(value, "_fields", (name,) * len(value)), value, strict=True):
                collect(part, field)

    collect((model.groups, model.contacts, model.bodies), "")
    return sum(number * size for number, size in passes.values())


@jit
def triad(a, b, c):
    """a = b + 3 c."""
    for k in range(len(a)):
        a[k] = b[k] + 3.0 * c[k]


def stepped(large: Assembly, scene: Scene) -> Step:
    """Steps of a large model, of a small one, and triads, in turn."""
    small = assemble(scene)
    arrays = [np.ones(TRIAD) for _ in range(3)]
    (take_large, steps), (take_small, steps_of_small) = stepper(large), stepper(small)
    works = [take_large, take_small, lambda: triad(*arrays)]
    for work in works:
        work()
    taken = np.array([[seconds_of(work) for work in works] for _ in range(ROUNDS)]).min(axis=0)
    return Step(
        1e9 * taken[0] / steps / items(large),
        1e9 * taken[1] / steps_of_small / items(small),
        bytes_of_step(large.model) / items(large),
        3 * 8 * TRIAD / taken[2] / 1e9,
    )


def cost_of_run(outcome: Outcome, assembly: Assembly) -> float:
    """ns of processor per item and step, rows included."""
    return 1e9 * outcome.seconds_run.processor / outcome.steps / items(assembly)


def advanced(assembly: Assembly) -> Outcome:
    """The whole run."""
    return timeloop.run(assembly.model, assembly.plan, assembly.recording)


def line(name: str, assembly: Assembly, whole: tuple[float, float, float, float], step: Step) -> str:
    """Of the table; whole: seconds of set-up, ns per item and step of the run, seconds of output, bytes of memory."""
    set_up, of_run, output, memory = whole
    words = f"{name:14}{assembly.specimen.blocks.count:8}{items(assembly):9}{set_up:7.1f} s{of_run:6.1f} ns"
    words += f"{step.cost:6.1f} ns{step.cost / step.small:10.2f}"
    if math.isnan(step.bytes):
        words += f"{'-':>7}{'-':>10}{'-':>10}"
    else:
        moved = step.bytes / step.cost
        words += f"{step.bytes:7.0f}{moved:5.1f} GB/s{moved / step.triad:10.2f}"
    return f"{words}{output:7.1f} s{memory / 1e9:6.2f} GB"


def run(name: str) -> None:
    """Set up, step, and write the results of one giant; prints its line of the table."""
    giant = GIANTS[name]
    advanced(assemble(giant.small))  # so that all is compiled and loaded
    begun = time.process_time()
    assembly = assemble(giant.scene)
    set_up = time.process_time() - begun
    outcome = advanced(assembly)
    with tempfile.TemporaryDirectory() as folder:
        output = seconds_of(lambda: result_of(assembly, outcome).save(Path(folder)))
    memory = 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    whole = cost_of_run(outcome, assembly)
    if assembly.model.large is None:
        step = stepped(assembly, giant.small)
    else:
        small = assemble(giant.small)
        step = Step(whole, cost_of_run(advanced(small), small))
    print(line(name, assembly, (set_up, whole, output, memory), step), flush=True)
    if outcome.stopped or memory > giant.memory:
        sys.exit(outcome.stopped or f"{name}: {memory / 1e9:.2f} GB are more than {giant.memory / 1e9:g} GB")


if __name__ == "__main__":
    if len(sys.argv) == 2 and sys.argv[1] in GIANTS:
        run(sys.argv[1])
    elif len(sys.argv) > 1:
        sys.exit(f"usage: python -m benchmarks.giants [{' | '.join(GIANTS)}]")
    else:
        print(HEAD, flush=True)
        codes = [subprocess.run([sys.executable, "-m", "benchmarks.giants", name]).returncode for name in GIANTS]
        sys.exit(max(codes))

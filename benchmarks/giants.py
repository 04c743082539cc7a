"""The largest walls: 50,000 rigid blocks for 1,000 steps, a million tets, and dry walls of 100 to 50,000 bricks that
fall 1 mm on a floor, in large displacement: `python -m benchmarks.giants`.

Each in a process of its own, whose largest resident memory is read at its end; a million tets must fit in 8 GB, and
what falls in 4 GB. Too long for `make bench`: some minutes, and up to 3 GB.
"""

import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from benchmarks.growing import Fall, Wall, items
from masonry.assembly.assemble import assemble
from masonry.laboratory.laboratory import result_of
from masonry.timeloop import timeloop

GIANTS = {
    "rigid": (Wall(56, 56).scene("drive.steps=1000", "solver.rows=10"), 8e9),
    "tets": (Wall(100, 52, mesh="fan").scene("drive.steps=100", "solver.rows=10"), 8e9),
    **{f"falling-{n * m}": (Fall(n, m).scene(), 4e9) for n, m in ((10, 10), (25, 40), (100, 100), (200, 250))},
}
"""The scene, and the bytes that it may hold in memory."""


def run(name: str) -> None:
    """Set up, step, and write the results of one giant; prints the seconds of each and the memory."""
    scene, most = GIANTS[name]
    begun = time.perf_counter()
    assembly = assemble(scene)
    setup = time.perf_counter() - begun
    outcome = timeloop.run(assembly.model, assembly.plan, assembly.recording)
    begun = time.perf_counter()
    with tempfile.TemporaryDirectory() as folder:
        result_of(assembly, outcome).save(Path(folder))
    output = time.perf_counter() - begun
    memory = 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    number = items(assembly)
    wall = outcome.seconds_run.wall
    print(
        f"{name}: {assembly.specimen.blocks.count} blocks, {number} items: set-up {setup:.1f} s, {outcome.steps} steps "
        f"{wall:.1f} s ({1e9 * wall / outcome.steps / number:.1f} ns per item and step, "
        f"rows included), output {output:.1f} s, largest memory {memory / 1e9:.2f} GB"
    )
    if outcome.stopped or memory > most:
        sys.exit(outcome.stopped or f"{name}: {memory / 1e9:.2f} GB are more than {most / 1e9:g} GB")


if __name__ == "__main__":
    if len(sys.argv) == 2 and sys.argv[1] in GIANTS:
        run(sys.argv[1])
    elif len(sys.argv) > 1:
        sys.exit(f"usage: python -m benchmarks.giants [{' | '.join(GIANTS)}]")
    else:
        codes = [subprocess.run([sys.executable, "-m", "benchmarks.giants", name]).returncode for name in GIANTS]
        sys.exit(max(codes))

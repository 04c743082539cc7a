"""Akantu, Yade and PyBullet beside ours: `python -m benchmarks.peers --akantu PYTHON --yade COMMAND --pybullet PYTHON`.

PYTHON is one that has `akantu` (pip install akantu), or `pybullet` (pip install pybullet); COMMAND starts Yade (apt-get
install yade). One that is absent is X a dry wall is tilted, by ours and by PyBullet: see tilted_wall.py.

The items are alike, not the same. A tet is linear elastic everywhere. Figures of ours and of Yade are whole steps,
over tets, contact points, bonds (of two spheres) or pairs of blocks that touch; a cohesive integration point of
Akantu is a step with such elements less one without, on the same nodes. Nor is the damage the same: in these rounds
half of Akantu's points soften and few of ours do, and Yade's bonds start whole and hardly move. Yade finds the
overlap of each pair of polyhedra at each step, we where it has moved: our wall that stands looks at none, and looks
are a row of their own.
"""

import argparse
import shutil
import sys
import time
from collections.abc import Callable
from functools import partial

import numpy as np

from benchmarks.peers import tilted_wall
from benchmarks.peers.worker import Absent, Worker
from benchmarks.test_detection import CALLS, brick_pair, clipping
from masonry import scene
from masonry.assembly.assemble import assemble
from masonry.configuration.chunk import Chunk
from masonry.timeloop import compiled_step
from verification.reference_step import models
from verification.scene_runs import assembled

ROUNDS = 15


def stepper(name: str, overrides: list[str], steps: int) -> tuple[Callable[[], None], int, int]:
    """A call that takes some steps of a scene with a drive at a rate; its contact points and its tets."""
    assembly = assemble(scene.load(name, overrides))
    compiled_step.compile_for(assembly.model, 1)
    chunk = Chunk(np.zeros(steps + 1), np.full(steps + 1, 1e-3), row=False)
    drive_force = np.zeros(steps)
    tets = 0 if assembly.mesh is None else len(assembly.mesh.tets)
    return (
        lambda: compiled_step.advance_model(assembly.model, chunk, 1, 0, steps, drive_force),
        len(assembly.model.group),
        tets,
    )


def ours() -> dict[str, tuple[Callable[[], None], float]]:
    """Our rows: a call, and steps times items in it."""
    bricks, looks = (
        assembled("dry-wall", {"displacements": "large"}).model,
        clipping(brick_pair(), np.array([[0, 1]]), True),
    )
    models.stepping(bricks, 3000)()
    pairs = bricks.large.near.pairs
    touching = int((pairs.slot[: pairs.number[0]] >= 0).sum())
    contacts, count, _ = stepper("wallette-mode-1", ["drive.rate=1 mm/s"], 200)
    blocks, _, tets = stepper("couplet", ["drive.steps=100", "kinematics=tets", "specimen.mesh_size=8 mm"], 100)
    return {
        f"masonry, whole step per tet, {tets} tets": (blocks, 100.0 * tets),
        f"masonry, whole step per contact point, {count} between rigid blocks": (contacts, 200.0 * count),
        f"masonry, whole step per pair of bricks that stand, {touching} pairs": (
            models.stepping(bricks, 20),
            20.0 * touching,
        ),
        "masonry, one look at a pair of bricks": (looks, float(CALLS)),
    }


def peers(words: argparse.Namespace) -> tuple[dict[str, Worker], list[str]]:
    """Workers that run, and a sentence on each that does not."""
    wanted = {f"akantu {kind}": ([words.akantu], "worker_akantu.py", kind) for kind in ("tets", "loose", "cohesive")}
    wanted |= {
        f"yade {kind}": ([words.yade, "-j1", "-x", "-n"], "worker_yade.py", kind)
        for kind in ("cohfrict", "jcfpm", "polyhedra")
    }
    found, absent = {}, []
    for name, how in wanted.items():
        try:
            found[name] = Worker(*how)
        except Absent as error:
            absent.append(f"{name}: left out, {error}")
    return found, absent


def main() -> None:
    parser = argparse.ArgumentParser(prog="python -m benchmarks.peers", description="Other programs beside ours.")
    parser.add_argument("--akantu", default=sys.executable, metavar="PYTHON", help="a Python that has akantu")
    parser.add_argument("--yade", default=shutil.which("yade") or "yade", metavar="COMMAND", help="starts Yade")
    parser.add_argument("--pybullet", default=sys.executable, metavar="PYTHON", help="a Python that has pybullet")
    words = parser.parse_args()
    print_steps(words)
    tilted_wall.print_table(words.pybullet)


def processor_seconds(work: Callable[[], None]) -> float:
    """Seconds of processor of one call: on a crowded machine those of a clock say little."""
    begun = time.process_time()
    work()
    return time.process_time() - begun


def print_steps(words: argparse.Namespace) -> None:
    """A line of each kind of step: what it costs by the item."""
    found, absent = peers(words)
    rows = ours()
    steps = {name: 20 if name.startswith("akantu") else 300 for name in found} | {"yade polyhedra": 10}
    try:
        works = [partial(processor_seconds, work) for work, _ in rows.values()]
        works += [partial(worker.seconds, steps[name]) for name, worker in found.items()]
        times = np.array([[work() for work in works] for _ in range(ROUNDS)]).min(axis=0)
    finally:
        for worker in found.values():
            worker.close()
    for (name, (_, items)), seconds in zip(rows.items(), times, strict=False):
        print(f"{1e9 * seconds / items:8.1f} ns  {name}")
    step = {name: seconds / steps[name] for name, seconds in zip(found, times[len(rows) :], strict=True)}
    for name, worker in found.items():
        says = worker.says
        version = f"{name} {says['version']}"
        if name == "akantu tets":
            print(f"{1e9 * step[name] / says['tets']:8.1f} ns  {version}, whole step per tet, {says['tets']} tets")
        elif name == "akantu cohesive" and "akantu loose" in step:
            extra = (step[name] - step["akantu loose"]) / says["points"]
            print(f"{1e9 * extra:8.1f} ns  {version}, step with less step without, per point of {says['points']}")
        for item in ("bonds", "pairs"):
            if item in says:
                print(f"{1e9 * step[name] / says[item]:8.1f} ns  {version}, whole step, over {says[item]} {item}")
    print("\n".join(absent), flush=True)


if __name__ == "__main__":
    main()

"""A dry wall on ground that is tilted until it falls: how wrong the tangent is, and the seconds of processor for it.

The wall is that of Ferris and Tin-Loi, `wall-tilted`, of whose bricks PyBullet has the boxes, masses and coefficient of
friction. What is right is told by limit analysis without dilation. Where the ground is tilted in real time a wall is
said to fall once a brick has moved by MOVED: that is later than it begins to, so that the tangent should be too large
by a little, the less the slower.
"""

import json
import math
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import masonry
from benchmarks.peers.worker import Absent, Worker
from geometry.polyhedra.measures import bounds
from masonry.assembly.assemble import assemble

SCENE = "wall-tilted"
RATE, MOST, REST = 0.05, 0.8, 1.0
"""The tangent of the tilt by a second, where tilting ends, and seconds before it begins (of PyBullet; ours settles)."""
MOVED = 0.02
ACCURACIES = ("5 %", "0.5 %", "0.05 %")
FRACTIONS = (0.9, 0.45)
"""Of the proven bound of our time step."""
STEPS_AND_ITERATIONS = ((240, 50), (1000, 10), (1000, 50), (4000, 10))
"""Of PyBullet: steps by a second, and iterations of its solver in each. The first are its defaults."""


@dataclass(frozen=True)
class Fall:
    """With what settings at which tangent of the tilt the wall fell, and the seconds of processor that steps took."""

    settings: str
    tangent: float
    seconds: float


def where_it_waits(accuracy: str) -> Fall:
    """Ours, where the tilt waits for the wall to come to rest: the greatest tangent that it bears."""
    summary = masonry.run(masonry.load(SCENE, {"limit.accuracy": accuracy})).summary
    assert summary.collapse_load is not None
    seconds = summary.seconds_processor_run or math.nan
    return Fall(f"masonry, tilt that waits, to {accuracy}", summary.collapse_load.borne, seconds)


def in_real_time(fraction: float, place: list[float]) -> Fall:
    """Ours, tilted in real time in large displacement; place (3,) m: of the brick that moves most."""
    seconds, degrees = MOST / RATE, math.degrees(math.atan(MOST))
    gauge = {"name": "moved", "at": {axis: f"{x} m" for axis, x in zip("xyz", place, strict=True)}, "direction": "-x"}
    tilt = {"about": "y", "angle": f"{degrees} deg", "duration": f"{seconds} s"}
    stepping = {"masses": "real", "damping": 0, "duration": f"{seconds} s", "step_fraction": fraction, "rows": 4000}
    how = {"displacements": "large", "limit.accuracy": "none", "gravity.tilt": tilt, "gauge": [gauge]}
    result = masonry.run(masonry.load(SCENE, how | {f"solver.{key}": value for key, value in stepping.items()}))
    rows = result.history.rows
    moved = np.maximum.accumulate(np.abs(rows["moved"]))
    tangent = float(np.interp(MOVED, moved, np.tan(rows["tilt_of_gravity"])))
    name = f"masonry, tilt in real time, {result.summary.time_step_s:.1e} s a step"
    return Fall(name, tangent, result.summary.seconds_processor_run or math.nan)


def boxes() -> dict[str, list]:
    """The bricks of the scene as boxes: centres and sizes (N, 3) m, and which are held."""
    specimen = assemble(masonry.load(SCENE)).specimen
    blocks = specimen.blocks
    low, high = bounds(blocks)
    fixed = np.isin(np.arange(blocks.count), specimen.sets["bottom course"])
    return {"centres": (0.5 * (low + high)).tolist(), "sizes": (high - low).tolist(), "fixed": fixed.tolist()}


def of_pybullet(python: str, bricks: dict[str, list]) -> Iterator[Fall | str]:
    """PyBullet with each of its settings, or a sentence on why it does not run."""
    wall = bricks | {"friction": 0.65, "density": 2000.0, "gravity": 9.81, "moved": MOVED}
    wall |= {"rate": RATE, "most": MOST, "rest": REST}
    for steps, iterations in STEPS_AND_ITERATIONS:
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder, "wall.json")
            file.write_text(json.dumps(wall | {"steps_per_second": steps, "iterations": iterations}))
            try:
                worker = Worker([python], "worker_pybullet.py", str(file))
            except Absent as error:
                yield f"pybullet: left out, {error}"
                return
            says = worker.says
            worker.close()
        name = f"pybullet {says['version']}, {1 / steps:.1e} s a step, {iterations} iterations"
        yield Fall(name, says["tangent"], says["seconds"])


def print_table(python: str) -> None:
    """Run all, and print a line each."""
    right = masonry.limit(SCENE, dilation=False)
    assert right.factor is not None
    fastest = int(np.argmax(np.linalg.norm(right.velocity[:, :3], axis=1)))
    bricks = boxes()
    print(f"a dry wall of {len(bricks['fixed'])} bricks is tilted; it falls at a tangent of {right.factor:.4f}")

    def falls() -> Iterator[Fall | str]:
        yield from map(where_it_waits, ACCURACIES)
        for fraction in FRACTIONS:
            yield in_real_time(fraction, bricks["centres"][fastest])
        yield from of_pybullet(python, bricks)

    for fall in falls():
        if isinstance(fall, str):
            print(fall)
        else:
            error = 100 * (fall.tangent / right.factor - 1)
            print(f"{fall.tangent:8.4f} {error:+7.2f} % {fall.seconds:8.2f} s  {fall.settings}", flush=True)

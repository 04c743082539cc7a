"""Blocks that turn and fall as far as they like: stiff joints, fast impacts, slivers, and masses far apart."""

from math import cos, radians, sin

import numpy as np

from verification.fixtures.dry_blocks import DENSITY, G, box, leaning, restitution, slab
from verification.scene_runs import SceneRun
from verification.stability.cells import Exact, Grid, MapCell
from verification.stability.scenes import Knobs

SCENE, ZETA, SLOPE, FRICTION = "dry-block", 0.2, 25.0, 0.3
SOUND: tuple[str, ...] = ("OK", "WARNED")


def impacts(full: bool) -> Grid:
    """A block that falls flat: what it keeps of its speed depends on neither the speed nor the stiffness."""
    stiffness = (1e7, 1e9, 1e10, 1e11, 1e13) if full else (1e10, 1e13)
    cells = {}
    for speed in (0.01, 1.0, 10.0, 100.0) if full else (10.0,):
        for kn in stiffness:
            period = 2.0 * np.pi * np.sqrt(DENSITY * 0.1 / kn)
            knobs: Knobs = {
                "specimen.box": [slab(), box("block", (-0.05, -0.1, 0.02), (0.1, 0.2, 0.1), 1)],
                "contact.unit_unit": rules(kn, 0.6, ZETA),
                "gravity": None,
                "settle": None,
                "motion": [{"on": "block", "velocity": [0, 0, f"-{speed!r} m/s"]}],
                "solver.duration": f"{0.03 / speed + period:.17g} s",
                "solver.step_fraction": 0.1,
            }
            through = speed * period > 1.0  # it would enter the slab by more than its size
            cells[f"{speed:g}", f"{kn:.0e}"] = MapCell(SCENE, knobs, rebound, ("STOPPED",) if through else SOUND)
    note = "What enters the slab by more than 1 % of the block is told; by more than a half, it ends the run."
    return Grid("A block that hits a slab", "speed [m/s]", "kn [Pa/m]", cells, note=note)


def sizes(full: bool) -> Grid:
    """Blocks of all sizes and shapes that slide down a plane."""
    shapes = {
        "cube of 0.1 m": (0.1, 0.1),
        "cube of 0.1 mm": (1e-4, 1e-4),
        "cube of 100 m": (100.0, 100.0),
        "sliver 1:100": (0.1, 1e-3),
        "sliver 1:1000": (0.1, 1e-4),
    }
    cells = {}
    for name, (size, high) in shapes.items() if full else list(shapes.items())[1:4:2]:
        for kn in (1e9, 1e10, 1e13) if full else (1e10,):
            low = 20.0 * size
            knobs: Knobs = {
                "specimen.box": [
                    box("slab", (-low, -low, -size), (2.0 * low, 2.0 * low, size), 0),
                    box("block", (-0.5 * size, -0.5 * size, 0.0), (size, size, high), 1),
                ],
                "contact.unit_unit": rules(kn, FRICTION, 0.5),
                "solver.duration": f"{np.sqrt(2.0 * size / G):.17g} s",
                **leaning(SLOPE),
            }
            cells[name, f"{kn:.0e}"] = MapCell(SCENE, knobs, slid_by, SOUND)
    return Grid("A block that slides down a plane", "block", "kn [Pa/m]", cells)


def masses(full: bool) -> Grid:
    """A block on one of another mass that stands on the slab: what the slab bears."""
    cells = {}
    for ratio in (1e-4, 1e-2, 1.0, 1e2, 1e4) if full else (1e4,):
        for kn in (1e10, 1e13) if full else (1e10,):
            knobs: Knobs = {
                "specimen.box": [
                    slab(),
                    box("below", (-0.05, -0.05, 0.0), (0.1, 0.1, 0.1), 1),
                    {**box("block", (-0.05, -0.05, 0.1), (0.1, 0.1, 0.1), 2), "group": "other"},
                ],
                "material.other": {"density": f"{DENSITY * ratio!r} kg/m^3"},
                "contact": {"default": rules(kn, 0.6, 0.5)},
                "assumptions": {},
                "settle.steps": 20000,
                "solver.duration": f"{0.01 * max(1.0, np.sqrt(ratio)):.17g} s",  # the heavier, the longer it swings
            }
            cells[f"{ratio:g}", f"{kn:.0e}"] = MapCell(SCENE, knobs, borne, SOUND)
    return Grid("A block on another one", "mass over that of the block below", "kn [Pa/m]", cells)


def rules(kn: float, friction: float, zeta: float) -> Knobs:
    """Contact properties of blocks that meet."""
    return {
        "normal_stiffness": f"{kn!r} Pa/m",
        "shear_stiffness": f"{0.5 * kn!r} Pa/m",
        "tan_friction_angle": friction,
        "normal_dashpot": zeta,
    }


def rebound(one: SceneRun) -> dict[str, Exact]:
    """Speed after the impact over that before."""
    energy = one.rows["kinetic"]
    return {"restitution": Exact(float(np.sqrt(energy[-1] / energy[0])), restitution(ZETA))}


def slid_by(one: SceneRun) -> dict[str, Exact]:
    """Way along the plane."""
    pace = G * (sin(radians(SLOPE)) - FRICTION * cos(radians(SLOPE)))
    return {"way": Exact(float(one.rows["x"][-1]), 0.5 * pace * float(one.rows["time"][-1]) ** 2)}


def borne(one: SceneRun) -> dict[str, Exact]:
    """The slab bears both weights, and nothing has moved but by the springs."""
    volume, ratio = 1e-3, float(one.knobs["material.other"]["density"].split()[0]) / DENSITY
    end = one.summary["reactions"]["end"]["support.0"]["force_n"][2]
    slab_weight = DENSITY * G * 4.0 * 1.0 * 0.1
    return {"reaction": Exact(end - slab_weight, DENSITY * G * volume * (1.0 + ratio))}


GRIDS = (impacts, sizes, masses)

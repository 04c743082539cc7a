"""Blocks that do not touch, touch along an edge only, overlap, or share a face that is there twice."""

import numpy as np

from geometry.blocks import Blocks
from geometry.joints.find import find_joints
from geometry.polyhedra.construct import from_faces
from verification.fixtures.dry_blocks import box
from verification.scene_runs import SceneRun
from verification.stability.cells import Exact, Grid, MapCell
from verification.stability.references import sheared
from verification.stability.scenes import PAIR, Knobs

LOW, TOP = box("low", (0.0, 0.0, 0.0), (1.0,) * 3, 0), box("top", (0.0, 0.0, 1.0), (1.0,) * 3, 1)
HELD: list[Knobs] = [{"on": "low", "fix": "all"}, {"on": "top", "fix": ["y", "rotation"]}]
ALSO_HELD: list[Knobs] = [*HELD, {"on": "third", "fix": "all"}]
FAST: Knobs = {"drive.steps": 5000, "solver.rows": 200}


def third_blocks(full: bool) -> Grid:
    """A third block in odd places, and a face that is there twice."""
    beside, apart, far = (2.0, 0.0, 0.0), (0.0, 0.0, 2.0 + 1e-6), (1e5, 0.0, 0.0)
    into, edge, corner = (0.0, 0.0, 1.9), (1.0, 0.0, -1.0), (1.0, 1.0, -1.0)
    cells = {
        ("apart, held by nothing", ""): _third(beside, HELD, ("REFUSED",)),
        ("1 um apart, held by nothing", ""): _third(apart, HELD, ("REFUSED",)),
        ("apart, held", ""): _third(beside, ALSO_HELD, ("OK",)),
        ("100 km apart, held", ""): _third(far, ALSO_HELD, ("OK", "REFUSED")),
        ("one in the other", ""): _third(into, ALSO_HELD, ("REFUSED",)),
        ("along an edge: no area", ""): _third(edge, ALSO_HELD, ("OK",)),
        ("in a corner: no area", ""): _third(corner, ALSO_HELD, ("OK",)),
        ("a face that is there twice", ""): MapCell(PAIR, {}, _area, ("OK",), face_twice),
    }
    return Grid("Blocks that touch oddly", "third block, or face", "", cells)


def _third(origin: tuple[float, float, float], support: list[Knobs], must: tuple[str, ...]) -> MapCell:
    """The pair with a third cube of 1 m."""
    boxes = [LOW, TOP, box("third", origin, (1.0,) * 3, 2)]
    knobs = {**FAST, "specimen.box": boxes, "specimen.section": "1 m^2", "support": support}
    return MapCell(PAIR, knobs, sheared, must)


def face_twice() -> SceneRun:
    """Two cubes, the lower one with its upper face there twice: the joint must have the area of one face."""
    joints = find_joints(_stacked())
    summary = {"steps": 0, "energy_imbalance": 0.0, "reaction_mismatch_max": 0.0, "kinetic_over_internal_max": 0.0}
    rows = {"area": joints.area.copy(), "repeated": np.array([float(joints.repeated)])}
    return SceneRun(PAIR, {}, summary=summary, rows=rows, times=[0.0])


def _area(one: SceneRun) -> dict[str, Exact]:
    return {
        "area": Exact(float(one.rows["area"].sum()), 1.0),
        "faces dropped": Exact(float(one.rows["repeated"][0]), 1.0),
    }


def _stacked() -> Blocks:
    """Two unit cubes, faces counter-clockwise seen from outside."""

    def cube(z: float) -> list[np.ndarray]:
        corner = np.array([[x, y, z + h] for h in (0, 1) for y in (0, 1) for x in (0, 1)], dtype=float)
        order = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))
        return [corner[list(face)] for face in order]

    below = cube(0.0)
    return from_faces([[*below, below[1]], cube(1.0)], [0, 1], [0, 0], ["units"])


GRIDS = (third_blocks,)

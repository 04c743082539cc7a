"""What a run will take, before it is made: about how many steps, rows of its curve, and seconds of processor."""

from dataclasses import dataclass

import numpy as np

from geometry.polyhedra.box_pairs import overlapping_boxes
from masonry.assembly.assemble import Assembly
from masonry.assembly.schedule import FEWEST
from masonry.laboratory import machine_speed
from masonry.loading.loading import Expected
from masonry.model.large.meeting import Large

SMALL = {"step": 300.0, "contact": 9.5, "block": 22.0, "tet": 20.0, "node": 30.0}
LARGE = {"step": 1500.0, "contact": 7.5, "patch": 3.3, "block": 22.0, "tet": 20.0, "node": 30.0}
"""Nanoseconds of processor that each part of a step takes where MACHINE was measured, in small and in large
displacement: contacts that are swept, and those of patches. `python -m verification.studies.forecasts` compares."""
CHUNK, LOOK, ROW, ROW_OF_CONTACT, FRAME_OF_CONTACT = 7e4, 5e4, 2.5e5, 200.0, 3e3
"""The same of a chunk of steps, a look at a specimen whose load grows, a row of the curve, and for each contact in a
row and in a frame."""
SETTLING = 8
"""Times the fewest steps in which dead loads have come to rest at the latest, where the scene does not say when."""


@dataclass(frozen=True)
class Forecast:
    """Steps, and seconds of processor, without compiling: about, at least and at most."""

    steps: tuple[int, int, int]
    seconds: tuple[float, float, float]


def expected(assembly: Assembly) -> Expected:
    """All steps and rows of a fixed program; about how many there will be where the specimen paces its load."""
    return assembly.plan.expected(assembly.model, assembly.recording.rows, assembly.recording.axis)


def forecast(assembly: Assembly) -> Forecast:
    """What a run takes on this machine."""
    run, seconds = expected(assembly), machine_speed.ratio() * _usual_seconds(assembly)
    of_step = seconds / max(run.steps, 1)
    tried = latest = 0
    if assembly.scene.has_dead_loads and assembly.scene.settle is None:  # tried in 1, 2, 4, ... times the fewest
        tried, latest = FEWEST, (SETTLING - 1) * FEWEST
    fewest, most = run.least * run.steps, run.most * run.steps
    return Forecast(
        (run.steps, round(fewest), round(most) + latest),
        (seconds + of_step * tried, of_step * (fewest + tried), of_step * (most + 2 * tried + 3 * latest)),
    )


def _usual_seconds(assembly: Assembly) -> float:
    """Of stepping where MACHINE was measured, from the costs of its parts."""
    m, run, mesh = assembly.model, expected(assembly), assembly.mesh
    contacts, swept = len(m.group), int(np.isin(m.group, m.swept).sum())
    count = {
        "step": 1,
        "contact": swept,
        "patch": contacts - swept,
        "block": len(m.layout.members["rigid"]) + 2 * len(m.layout.members["affine"]),
        "tet": 0 if mesh is None else len(mesh.tets),
        "node": 0 if mesh is None else len(mesh.nodes),
    }
    step = sum(cost * count[part] for part, cost in (LARGE if assembly.scene.is_large else SMALL).items())
    rows = run.rows * (ROW + ROW_OF_CONTACT * contacts) + FRAME_OF_CONTACT * contacts * assembly.recording.frames
    return 1e-9 * (run.steps * step + CHUNK * run.chunks + LOOK * run.looks + rows)


def candidates(large: Large) -> int:
    """How many pairs of convex pieces lie so near to each other at the start that they are looked at: their boxes,
    wider by the skin on every side, overlap. Blocks that stand still, or that bonds hold, make none.
    """
    pieces, search = large.near.pieces, large.near.search
    corner = pieces.vertex + large.near.motion.centre[np.repeat(pieces.body, np.diff(pieces.vertex_start))]
    low = np.minimum.reduceat(corner, pieces.vertex_start[:-1]) - search.skin[0]
    high = np.maximum.reduceat(corner, pieces.vertex_start[:-1]) + search.skin[0]
    pair = pieces.body[overlapping_boxes(low, high)]
    block = pieces.block[pair]
    key = block.min(axis=1) * len(pieces.body) + block.max(axis=1)
    meets = (block[:, 0] != block[:, 1]) & search.moves[pair].any(axis=1)
    return int(np.count_nonzero(meets & ~np.isin(key, search.bonded[search.alive])))

"""Expected size of a run, before it is made: about how many steps, rows of its curve, and seconds of processor."""

from dataclasses import dataclass

import numpy as np

from geometry.blocks import Joints
from geometry.polyhedra.box_pairs import overlapping_boxes
from masonry.assembly.assemble import Assembly
from masonry.assembly.schedule import FEWEST
from masonry.laboratory import machine_speed
from masonry.loading.loading import Expected
from masonry.model.large.meeting import Large

SMALL = {"step": 300.0, "contact": 9.5, "patch": 0.0, "block": 22.0, "tet": 20.0, "node": 30.0}
LARGE = {"step": 650.0, "contact": 7.5, "patch": 43.0, "block": 22.0, "tet": 20.0, "node": 30.0}
"""Nanoseconds of processor that each part of a step takes where MACHINE was measured, in small and in large
displacement: contacts that are swept, and joints that are patches. `python -m verification.studies.forecasts`
compares."""
MOVING, FROM_MEMORY, MANY = 1.5, 30.0, 25000
"""Times as much a patch takes where blocks swing or fall, and are looked at again (1.1 to 2.2 were measured); what it
takes besides where all of them lie in memory, and how many lie there by half: those of ten thousand stay in the
processor's cache."""
CHUNK, LOOK, ROW, FRAME_OF_CONTACT = 7e4, 5e4, 2.5e5, 3e3
"""The same of a chunk of steps, a look at a specimen whose load grows, a row of the curve, and for each contact in a
frame."""
ROW_OF_CONTACT, ROW_OF_LARGE, CHUNK_OF_LARGE = 200.0, 400.0, 1.2e3
"""Besides: for each contact in a row, in small and in large displacement, and for each block in a chunk in large."""
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
    """Expected steps and seconds of a run on this machine."""
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
    contacts, swept = len(m.group), np.isin(m.group, m.swept)
    patches, blocks, is_large = patches_among(assembly.joints, ~swept), len(m.layout.kind), assembly.scene.is_large
    count = {
        "step": 1,
        "contact": int(swept.sum()),
        "patch": patches,
        "block": len(m.layout.members["rigid"]) + 2 * len(m.layout.members["affine"]),
        "tet": 0 if mesh is None else len(mesh.tets),
        "node": 0 if mesh is None else len(mesh.nodes),
    }
    costs = LARGE | {"patch": of_patch(patches, moves=not m.scaled)} if is_large else SMALL
    step = sum(cost * count[part] for part, cost in costs.items())
    row = ROW + (ROW_OF_LARGE if is_large else ROW_OF_CONTACT) * contacts
    chunk = CHUNK + CHUNK_OF_LARGE * blocks * is_large
    frames = FRAME_OF_CONTACT * contacts * assembly.recording.frames
    return 1e-9 * (run.steps * step + chunk * run.chunks + LOOK * run.looks + row * run.rows + frames)


def patches_among(joints: Joints, chosen: np.ndarray | slice = slice(None)) -> int:
    """How many pairs of blocks some of the contacts (C,) lie between."""
    return len(np.unique(np.column_stack([joints.block_a, joints.block_b])[chosen], axis=0))


def of_patch(count: int, moves: bool) -> float:
    """Nanoseconds of one of so many patches."""
    from_memory = FROM_MEMORY * count**2 / (count**2 + MANY**2)
    return (MOVING if moves else 1.0) * LARGE["patch"] + from_memory


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

"""What a run will take, before it is made: about how many steps, rows of its curve, and seconds."""

import numpy as np

from geometry.polyhedra.box_pairs import overlapping_boxes
from masonry.assembly.assemble import Assembly
from masonry.loading.loading import Expected
from masonry.model.large.meeting import Large

NANOSECONDS = {"contact": 13.0, "side": 4.0, "block": 60.0, "tet": 20.0, "node": 30.0, "step": 2000.0}
"""Rough cost of each part of a step on one 2.5 GHz core; `masonry check` says "about"."""
LOOK = 3e5
"""A look at a specimen whose load grows."""
ROW, ROW_OF_CONTACT = 2.5e5, 400.0
"""The same for a row of the curve, and for each contact in it."""


def expected(assembly: Assembly) -> Expected:
    """All steps and rows of a fixed program; about how many there will be where the specimen paces its load."""
    return assembly.plan.expected(assembly.model, assembly.recording.rows, assembly.recording.axis)


def expected_seconds(assembly: Assembly) -> float:
    """Rough stepping time from the parts' costs, without the compile."""
    m, run = assembly.model, expected(assembly)
    nodes = 0 if assembly.mesh is None else len(assembly.mesh.nodes)
    tets = 0 if assembly.mesh is None else len(assembly.mesh.tets)
    blocks = len(m.layout.members["rigid"]) + 2 * len(m.layout.members["affine"])
    each = {"contact": len(m.group), "side": 2 * len(m.group), "block": blocks, "tet": tets, "node": nodes, "step": 1}
    step = sum(NANOSECONDS[key] * count for key, count in each.items())
    return 1e-9 * (run.steps * step + LOOK * run.looks + run.rows * (ROW + ROW_OF_CONTACT * len(m.group)))


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

"""What a run will take, before it is made: about how many steps, rows of its curve, and seconds."""

import numpy as np

from geometry.polyhedra.box_pairs import overlapping_boxes
from masonry.assembly.assemble import Assembly
from masonry.loading.collapse.settings import FALLING, GROWING
from masonry.loading.drive.settings import SETTINGS
from masonry.loading.plans import Controlled, Growing
from masonry.model.large.meeting import Large

PRESCRIBED = 110
"""Increments of a way or a leg where the drive prescribes all that moves: few steps each, whatever the accuracy."""
TRAVEL, CRACKS = 9000, 220.0
"""Steps of a drive that goes one way, and over the accuracy besides. Measured, as what follows: walls and couplets of
the paper, with rigid blocks and others, at 0.1 to 5 %: from 0.4 times as many to 1.6 times in single cases."""
LEG, WIDER = 3000, 200.0
"""Steps of each leg of a drive that turns back; and over the accuracy, for coming to places where it has not been, as
far on one side as the farthest place of all."""
TRIALS, FEWEST_OF_TRIAL, ROWS_OF_TRIAL = 20, 2000, 5
"""Of a load that grows until it falls: trials, the steps of one at least, and rows of one, with the fall's."""
STEPS_OF_INCREMENT = 1500
"""The same of one that goes to and fro: 400 to 4,500 in single cases."""
STEPS_OF_BRANCH, ROWS_OF_BRANCH = 150_000, 200
"""Of a gauge that is led on behind the collapse: from 3,000 steps to a million in single cases."""
NANOSECONDS = {"contact": 13.0, "side": 4.0, "block": 60.0, "tet": 20.0, "node": 30.0, "step": 2000.0}
"""Rough cost of each part of a step on one 2.5 GHz core; `masonry check` says "about"."""
LOOK = 3e5
"""A look at a specimen whose load grows."""
ROW, ROW_OF_CONTACT = 2.5e5, 400.0
"""The same for a row of the curve, and for each contact in it."""


def expected_steps(assembly: Assembly) -> int:
    """All steps of a fixed program; about how many there will be of a drive that is paced by its error."""
    plan = assembly.plan
    if isinstance(plan, Growing):
        steps = STEPS_OF_INCREMENT if plan.reversals else max(plan.settle // 6, FEWEST_OF_TRIAL)
        return plan.settle + _trials(plan) * steps + _of_branch(plan)
    return plan.settle + round(_paced(assembly, plan)) if isinstance(plan, Controlled) else plan.steps


def expected_seconds(assembly: Assembly) -> float:
    """Rough stepping time from the parts' costs, without the compile."""
    m, steps = assembly.model, expected_steps(assembly)
    nodes = 0 if assembly.mesh is None else len(assembly.mesh.nodes)
    tets = 0 if assembly.mesh is None else len(assembly.mesh.tets)
    blocks = len(m.layout.members["rigid"]) + 2 * len(m.layout.members["affine"])
    each = {"contact": len(m.group), "side": 2 * len(m.group), "block": blocks, "tet": tets, "node": nodes, "step": 1}
    step = sum(NANOSECONDS[key] * count for key, count in each.items())
    looks = 0.0
    if isinstance(assembly.plan, Growing):
        behind = _of_branch(assembly.plan)
        looks = (steps - behind) / GROWING.look + behind / FALLING.longest
    return 1e-9 * (steps * step + LOOK * looks + expected_rows(assembly) * (ROW + ROW_OF_CONTACT * len(m.group)))


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
    return int(np.count_nonzero(meets & ~np.isin(key, search.bonded[search.held])))


def expected_rows(assembly: Assembly) -> int:
    """Rows of the curve: to an accuracy, each increment writes one."""
    plan, rows = assembly.plan, assembly.recording.rows
    if isinstance(plan, Growing):
        return ROWS_OF_TRIAL * _trials(plan) + (0 if plan.control is None else ROWS_OF_BRANCH)
    if not isinstance(plan, Controlled):
        return min(rows, plan.steps) + len(plan.marks)
    settling = min(max(1, rows // SETTINGS.settling_rows), plan.settle)
    return settling + round(
        _paced(assembly, plan) / (SETTINGS.few_steps if drive_prescribes_all(assembly) else SETTINGS.steps)
    )


def _trials(plan: Growing) -> int:
    """Trials of a load that grows until it falls, or the increments of one that goes to and fro."""
    if not plan.reversals:
        return TRIALS
    return round(plan.path / (GROWING.to_and_fro(plan.accuracy) * plan.span))


def _of_branch(plan: Growing) -> int:
    """Steps behind the collapse."""
    return 0 if plan.control is None else STEPS_OF_BRANCH


def _paced(assembly: Assembly, plan: Controlled) -> float:
    """Steps after the settling."""
    reversals = np.array(plan.reversals or (plan.displacement,))
    if drive_prescribes_all(assembly):
        return PRESCRIBED * SETTINGS.few_steps * len(reversals)
    if plan.reversals:
        reached = [np.maximum(side, 0.0).max() for side in (reversals, -reversals)]
        return LEG * len(reversals) + WIDER / plan.accuracy * sum(reached) / max(reached)
    deformable = any(len(assembly.model.layout.members[kind]) for kind in ("affine", "tets"))
    return TRAVEL + CRACKS / (plan.accuracy * (SETTINGS.deformable if deformable else 1.0))


def drive_prescribes_all(assembly: Assembly) -> bool:
    """Whether nothing is left to swing: blocks are free to shift across the drive at most, and no joint dilates."""
    model, drive = assembly.model, assembly.scene.drive
    if drive is None or any(joint.tan_dilation is not None for joint in model.groups.properties):
        return False
    across = [i for i in range(3) if i != drive.axis]
    swinging = {kind: np.array(mass > 0.0) for kind, mass in model.masses.items()}
    for kind in ("rigid", "affine"):
        swinging[kind][:, across] = False
    return not any(free.any() for free in swinging.values())

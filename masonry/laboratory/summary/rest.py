"""How far from rest the specimen is after the settling, and at the end."""

import numpy as np

from masonry.assembly.assemble import Assembly
from masonry.configuration.parts.loose_blocks import loose_blocks
from masonry.judgement.words import block_at
from masonry.monitors.settling import MovingAtEnd
from masonry.monitors.stability import smallest_block
from masonry.results.deformation import BlockCorners
from masonry.results.summary import Rest, Restless
from masonry.rows.columns import FACTOR, STORED_BY_ELEMENTS
from masonry.rows.rest_criterion import DOUBTED
from masonry.timeloop.run_outcome import Outcome

STORED = ("elastic_blocks", "elastic_contacts", *STORED_BY_ELEMENTS)
"""Columns of what a specimen stores."""
LOOSE = 1e-3
"""Of the smallest block: what has moved by less is not called loose."""


def rest(assembly: Assembly, outcome: Outcome) -> Rest:
    """Of all blocks together, and of the one that is farthest from rest, on its own scales; nothing where nothing need
    be at rest."""
    observed, loads = outcome.observed, assembly.recording.surroundings.loads
    settles = bool(loads) and (not assembly.scene.is_large or assembly.plan.settle > 0)
    return Rest(
        unbalanced_after_settling=float(observed["unbalanced"][-1]) if settles else None,
        kinetic_after_settling=float(observed["still_moving"][-1]) if settles else None,
        unrest_after_settling=_after_settling(assembly, outcome) if settles else None,
        moving_at_end=_at_end(assembly, outcome),
        came_loose=_came_loose(assembly, outcome),
        swing_too_wide=None if _rests(assembly, outcome) else _too_wide(observed.get("swing_in_a_step")),
    )


def _after_settling(assembly: Assembly, outcome: Outcome) -> Restless | None:
    """The most of any block, and the one that is farthest from rest; None where the sums over all are far from it."""
    unbalanced, kinetic, block = (
        float(outcome.observed[name][-1]) for name in ("of_a_block", "energy_of_a_block", "block")
    )
    if unbalanced < 0.0:
        return None
    return Restless(int(block), _place(assembly, int(block)), unbalanced, kinetic)


def _at_end(assembly: Assembly, outcome: Outcome) -> Restless | None:
    """The block that moves most."""
    moving = outcome.records.get(MovingAtEnd)
    return None if moving is None else Restless(moving.block, _place(assembly, moving.block), kinetic=moving.energy)


def _came_loose(assembly: Assembly, outcome: Outcome) -> str:
    """Blocks that no joint which bears anything, and no bar, joins to one that is held, once they moved by a thousandth
    of the smallest block; "" where there are none, and where it is no matter: a drive may be there to pull a joint
    apart, and the search of a collapse load ends so."""
    scene, model, frames = assembly.scene, assembly.model, outcome.history.frames
    if scene.is_large or scene.drive is not None or not frames or FACTOR in outcome.history.rows:
        return ""
    frame, shape = frames[-1], BlockCorners(assembly.specimen.blocks)
    movement = np.zeros(assembly.specimen.blocks.count)
    np.maximum.at(movement, shape.owner, np.linalg.norm(frame.corners[shape.corner], axis=1))
    bears = (frame.normal_stress != 0.0) | (frame.shear_stress != 0.0)
    loose = loose_blocks(model, bears) & (movement > LOOSE * smallest_block(model))
    if not loose.any():
        return ""
    block = int(np.argmax(np.where(loose, movement, 0.0)))
    others = f", and {int(loose.sum()) - 1} more" if loose.sum() > 1 else ""
    return f"{block_at({'block': block, 'at_m': _place(assembly, block)})} came loose{others}"


def _rests(assembly: Assembly, outcome: Outcome) -> bool:
    """Whether nothing acts but dead loads, and none of their swings since the settling is worth a word: what rounding
    leaves at rest swings as fast as steps allow."""
    scene, rows = assembly.scene, outcome.history.rows
    loads = [load for load in (*scene.traction, scene.gravity) if load is not None]
    if scene.motion or scene.ground or scene.quiet or any(load.paths for load in loads):
        return False
    since = rows["step"] >= assembly.plan.settle
    stored = sum(np.abs(rows[name][since]).max(initial=0.0) for name in STORED if name in rows)
    return float(rows["kinetic"][since].max(initial=0.0)) <= DOUBTED.energy * stored


def _too_wide(in_a_step: np.ndarray | None) -> float | None:
    """Share by which swings come out too wide that go so far in a step, (w dt)^2: a velocity that is given counts for
    the middle of a step."""
    return None if in_a_step is None else float(in_a_step[-1]) / 8.0


def _place(assembly: Assembly, block: int) -> list[float]:
    """m, where a block was made."""
    return list(assembly.model.layout.centroid[block].tolist())

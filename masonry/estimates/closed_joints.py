"""How far movements are off in a run, as joints that stay closed bend or twist too stiffly by their contact points.

By virtual work a movement is off by the work that the moments of closed joints lack, where their turn is that of a
stress spread over their area, over all that joints do by bending and sliding; of blocks that deform as much is added as
they store beside the contacts. A joint that is a small part of all that work is asked by the movement of its own
block. The peak counts, and the frame with the largest work before it.
"""

import numpy as np

from masonry.estimates.inspection import Inspection
from masonry.estimates.joint_loads import Look
from masonry.results.deformation import BlockCorners

HARDLY = 0.1
"""Of the movement of a block, what the turn of its joint makes of it: below that joints hardly bend."""


def may_turn_otherwise(inspection: Inspection) -> bool:
    """Whether points of joints, dry ones in large displacement apart, turn otherwise than their areas do."""
    faces = inspection.faces
    which = ~faces.dry if inspection.assembly.scene.is_large else np.ones(len(faces.patch), dtype=bool)
    return bool((faces.softness[which] != 0.0).any())


def strength_decides(inspection: Inspection) -> bool:
    """Whether the run is made for a load that is borne, that it reached."""
    limit = inspection.assembly.scene.limit
    return (limit is not None and limit.run_accuracy is not None) or inspection.gave_way


def movement_error(inspection: Inspection) -> float:
    """The share by which movements are too small, below 0 too large; 0 where joints hardly turn."""
    looks = [inspection.look(number) for number in range(inspection.peak + 1)]
    largest = int(np.argmax(np.nan_to_num([look.work.total for look in looks])))
    return max((error_in_frame(inspection, looks, number) for number in {largest, inspection.peak}), key=abs)


def error_in_frame(inspection: Inspection, looks: list[Look], number: int) -> float:
    """As `movement_error`, in one frame."""
    now, faces = looks[number], inspection.faces
    shear = inspection.shear(number)
    moment = now.moment + shear.twist[:, None] * faces.normal
    turn = np.einsum("jab,jb->ja", faces.softness, moment) * _closed(inspection, looks, number)[:, None]
    turned = now.turn + shear.turn[:, None] * faces.normal
    moves, adds = _beside_its_block(inspection, number, turned), _beside_its_block(inspection, number, turn)
    if not np.isfinite(adds).all() or moves.max(initial=0.0) < HARDLY:
        return 0.0
    more = np.einsum("ja,ja->j", moment, turn)
    of_all = float(more.sum()) / max(_work(inspection, now, number) + float(more.sum()), 1e-300)
    worst = int(np.argmax(adds))
    of_one = float(np.sign(more[worst]) * adds[worst])
    return max(of_all, of_one / max(1.0 + of_one, 1e-300), key=abs)


def corner_friction(inspection: Inspection) -> tuple[float, float]:
    """Shares of the work of joints at the peak: of friction in dry joints with points at their corners alone, and of
    twists."""
    faces, peak = inspection.faces, inspection.peak
    look, shear = inspection.look(peak), inspection.shear(peak)
    few = np.diff(faces.start) <= [sum(map(len, polygons)) for polygons in faces.polygons]
    rubs, twists = float(look.inelastic.sliding[faces.dry & few].sum()), float(np.abs(shear.twist * shear.turn).sum())
    work = max(look.work.total, 1e-300)
    return rubs / work, twists / work


def _closed(inspection: Inspection, looks: list[Look], number: int) -> np.ndarray:
    """(J,) which faces stayed whole or, if they are dry, are closed all over; in large displacement bonds alone."""
    assembly, faces = inspection.assembly, inspection.faces
    open_ = faces.sums((inspection.frames[number].opening > 0.0).astype(float)) > 0.0
    torn = np.any([look.torn for look in looks], axis=0)
    return np.asarray(np.where(faces.dry, ~open_ & (not assembly.scene.is_large), ~torn))


def _work(inspection: Inspection, now: Look, number: int) -> float:
    """Twice the J of joints in a frame, without pressing, and of blocks the part that belongs to it."""
    rows, step = inspection.outcome.standing_rows, inspection.frames[number].step
    row = max(int(np.searchsorted(rows["step"], step, side="right")) - 1, 0)
    blocks, contacts = float(rows["elastic_blocks"][row]), float(rows["elastic_contacts"][row])
    return now.work.total * (1.0 + max(blocks, 0.0) / max(contacts, 1e-300))


def _beside_its_block(inspection: Inspection, number: int, turn: np.ndarray) -> np.ndarray:
    """(J,) how far turns (J, 3) rad move the block beyond a joint, over how far it has moved."""
    joints, faces = inspection.assembly.joints, inspection.faces
    shape, corners = BlockCorners(inspection.assembly.specimen.blocks), inspection.frames[number].corners
    radius, moved = np.zeros((2, len(shape.centre)))
    np.maximum.at(radius, shape.owner, np.linalg.norm(shape.arm, axis=1))
    np.maximum.at(moved, shape.owner, np.linalg.norm(corners[shape.corner], axis=1))
    first = faces.order[faces.start[:-1]]
    sides = np.stack([joints.block_a[first], joints.block_b[first]])
    beyond = np.take_along_axis(sides, np.argmax(moved[sides], axis=0)[None], axis=0)[0]
    reach = np.linalg.norm(faces.middle - shape.centre[beyond], axis=1) + radius[beyond]
    return np.asarray(np.linalg.norm(turn, axis=1) * reach / np.maximum(moved[beyond], 1e-300))

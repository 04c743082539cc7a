"""Do joints that stay closed decide the answer, and bend or twist too stiffly by their contact points? With points at
the corners alone they do so three times as stiffly as by an even stress, by Gauss points once.

By virtual work a movement is off by the work that the moments of closed joints lack, where their turn is that of a
stress spread over their area, over all that joints do by bending and sliding; of blocks that deform as much is added as
they store beside the contacts. A joint that is a small part of all that work is asked by the movement of its own
block. The peak counts, and the frame with the largest work before it; the limit is the accuracy that was asked for.
Where a run is made for a strength, and joints gave way, few_points asks what these bear. Closed joints decide there too
how blocks press on each other, and with that what friction bears. What that makes of a strength is told by a rule: by
two points along each edge a facade was 1.2 % weaker than by four and 1.9 % weaker than by six, a house 0.9 % weaker and
0.4 % stronger, others 0.7 % weaker and 1.9 % stronger. Two estimates did not measure it: by virtual work of friction
with the pressures of elastic joints under the load that is borne, the facade is 1.1 % too strong, and it is too weak;
following the load without dilation with more points takes ten times as long as a run with them does.

Patches of large displacement lie at their corners where the scene chooses none. They decide where no block moved by
more than a thousandth of the smallest one: then joints hardly open.
"""

import numpy as np

from masonry.estimates.joint_faces import Look
from masonry.judgement.doubt import Doubt
from masonry.laboratory.remarks.bending_points import advice_for
from masonry.laboratory.remarks.edge_reach import is_dry, points_are_chosen
from masonry.laboratory.remarks.inspection import Inspection
from masonry.monitors.stability import smallest_block
from masonry.results.deformation import BlockCorners

STAYS = 1e-3
"""Of the smallest block."""
HARDLY = 0.1
"""Of the movement of a block, what the turn of its joint makes of it: below that joints hardly bend."""
CORNERS, RUBS, TWISTS = 0.02, 0.1, 1e-3
"""By what share a load may be off where joints have points at their corners alone; shares of the work of joints at the
peak, of friction and of twists, from which on that counts."""
GAVE_WAY = 0.01
"""Of the work of joints behind a peak, from which on what is not elastic made it one."""


def doubts(inspection: Inspection) -> list[Doubt]:
    """One at most."""
    if not inspection.frames:
        return []
    return _of_patches(inspection) or _of_points(inspection)


def _of_patches(inspection: Inspection) -> list[Doubt]:
    model, frames = inspection.assembly.model, inspection.frames
    if not inspection.assembly.scene.is_large or points_are_chosen(inspection.assembly):
        return []
    farthest = max(float(np.abs(frame.corners).max(initial=0.0)) for frame in frames)
    dry = any(is_dry(inspection.assembly, g) for g in range(len(model.group_names)))
    if farthest > STAYS * smallest_block(model) or not dry:
        return []
    sentence = (
        "no block moved by more than a thousandth of its size, so that dry joints decide that stay closed: with points "
        "at their corners alone they bend three times as stiffly as an even pressure does"
    )
    advice = 'take specimen.patch_points = "spread", or say "corners" where that does not matter'
    return [Doubt("closed_joints", None, None, sentence, advice)]


def _of_points(inspection: Inspection) -> list[Doubt]:
    which = np.ones(len(inspection.faces.patch), dtype=bool)
    if inspection.assembly.scene.is_large:
        which = ~_dry(inspection)
    if not (inspection.faces.softness[which] != 0.0).any():
        return []
    if _strength_decides(inspection):
        return _of_corners(inspection)
    looks = [inspection.look(number) for number in range(inspection.peak + 1)]
    works = np.nan_to_num([float((look.bends + look.slides).sum()) for look in looks])
    largest, limit = int(np.argmax(works)), inspection.accuracy
    off = max((_off(inspection, looks, number) for number in {largest, inspection.peak}), key=abs)
    if abs(off) <= limit:
        return []
    stiff, small = ("stiffly", "small") if off > 0.0 else ("softly", "large")
    sentence = (
        f"joints that stay closed bend or twist too {stiff} by their contact points: movements may be about "
        f"{100.0 * abs(off):.2g} % too {small}, and what is shared out by stiffness is off as well"
    )
    return [Doubt("closed_joints", off, limit, sentence, advice_for(inspection.assembly))]


def _of_corners(inspection: Inspection) -> list[Doubt]:
    """Of a strength in space that friction decides, in joints with points at their corners alone."""
    look, faces = inspection.look(inspection.peak), inspection.faces
    shear, work = inspection.shear(inspection.peak), max(float((look.bends + look.slides).sum()), 1e-300)
    few = np.diff(faces.start) <= [sum(map(len, polygons)) for polygons in faces.polygons]
    rubs = float(look.slid[_dry(inspection) & few].sum()) / work
    twists = float(np.abs(shear.twist * shear.turn).sum()) / work
    if inspection.assembly.scene.is_large or inspection.accuracy >= CORNERS or rubs < RUBS or twists < TWISTS:
        return []
    sentence = (
        "joints slide and twist on contact points at their corners alone, and which of these press follows from joints "
        f"that turn three times too stiffly: the {inspection.strength} may be about {100.0 * CORNERS:g} % off"
    )
    return [Doubt("closed_joints", CORNERS, inspection.accuracy, sentence, advice_for(inspection.assembly))]


def _strength_decides(inspection: Inspection) -> bool:
    """Whether the run is made for a load that is borne, that it reached."""
    scene, frames, peak = inspection.assembly.scene, inspection.frames, inspection.peak
    if scene.limit is not None and scene.limit.run_accuracy is not None:
        return True
    if scene.drive is None or peak + 1 >= len(frames):
        return False
    behind = inspection.look(peak + 1)
    lost, work = float((behind.bent + behind.slid).sum()), float((behind.bends + behind.slides).sum())
    return lost > GAVE_WAY * work


def _off(inspection: Inspection, looks: list[Look], number: int) -> float:
    """The share by which movements are too small in a frame; 0 where joints hardly turn."""
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


def _closed(inspection: Inspection, looks: list[Look], number: int) -> np.ndarray:
    """(J,) which faces stayed whole or, if they are dry, are closed all over; in large displacement bonds alone."""
    assembly, faces = inspection.assembly, inspection.faces
    open_ = faces.sums((inspection.frames[number].opening > 0.0).astype(float)) > 0.0
    torn = np.any([look.torn for look in looks], axis=0)
    return np.asarray(np.where(_dry(inspection), ~open_ & (not assembly.scene.is_large), ~torn))


def _dry(inspection: Inspection) -> np.ndarray:
    """(J,) which faces have no tension."""
    assembly = inspection.assembly
    of_group = [is_dry(assembly, g) for g in range(len(assembly.model.group_names))]
    return np.array(of_group, dtype=bool)[inspection.faces.group]


def _work(inspection: Inspection, now: Look, number: int) -> float:
    """Twice the J of joints in a frame, without pressing, and of blocks the part that belongs to it."""
    rows, step = inspection.outcome.standing_rows, inspection.frames[number].step
    row = max(int(np.searchsorted(rows["step"], step, side="right")) - 1, 0)
    blocks, contacts = float(rows["elastic_blocks"][row]), float(rows["elastic_contacts"][row])
    return float((now.bends + now.slides).sum()) * (1.0 + max(blocks, 0.0) / max(contacts, 1e-300))


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

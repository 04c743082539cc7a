"""Is every part of a specimen held? A part that a dead load can move as a whole would fall for ever."""

import numpy as np

from geometry.blocks import Joints, Specimen
from geometry.joints.find import connected
from masonry.errors import SceneError
from masonry.model.kinds import KIND
from masonry.model.layout import KINDS, Layout
from masonry.model.loads import Conditions

LOOSE = 1e-9
"""Share of the largest (squared) below which a motion counts as not held, and of the loads below which as idle."""


def require_held(specimen: Specimen, joints: Joints, layout: Layout, conditions: Conditions, loaded: bool) -> None:
    """Every connected part must be held by a support, against every motion in which a dead load does work.

    Raises SceneError naming a block of the part. `loaded`: whether there are dead loads at all.
    """
    part = _linked(connected(specimen.blocks, joints), conditions)
    size = float(np.ptp(layout.centroid, axis=0).max() + np.cbrt(layout.volume.max()))
    for p in np.unique(part):
        member = np.asarray(part == p)
        rows, load = _rigid_motions(layout, conditions, member, size)
        centre = layout.centroid.mean(axis=0)
        hung = np.concatenate([rows[:0], *(plan.restraints(member, centre, size) for plan in conditions.elements)])
        rows = np.concatenate([rows, hung])
        if len(rows) == 0:
            _refuse(
                specimen, layout, member, "are held by nothing; add a [[support]], or close the gap to the neighbours"
            )
        if not _supported(layout, conditions, member) and not len(hung):
            _refuse(specimen, layout, member, "are driven, but held by no [[support]]; add one, or close the gap to it")
        if not loaded:
            continue
        squares, vectors = np.linalg.eigh(rows.T @ rows)
        directions, is_fixed = vectors.T, squares > LOOSE * squares.max()
        work = np.abs(directions[~is_fixed] @ load)
        if np.any(work > LOOSE * max(np.abs(load).max(), 1e-300)):
            mode = directions[~is_fixed][int(np.argmax(work))]
            motion = f"along {'xyz'[int(np.argmax(np.abs(mode[:3])))]}"
            if np.abs(mode[3:]).max() > np.abs(mode[:3]).max():
                motion = f"from turning about {'xyz'[int(np.argmax(np.abs(mode[3:])))]}"
            _refuse(
                specimen, layout, member, f"are not held {motion}, where the dead loads push; add it to a [[support]]"
            )


def _supported(layout: Layout, conditions: Conditions, member: np.ndarray) -> bool:
    """Whether a support, and not only the drive, holds some dof of a part."""
    return any(
        bool((conditions.supported[kind] & member[layout.owner[kind]][:, None]).any())
        for kind in KINDS
        if layout.rows(kind)
    )


def _linked(part: np.ndarray, conditions: Conditions) -> np.ndarray:
    """(B,) the part of each block, where elements tie parts to each other as well."""
    for links in (plan.links() for plan in conditions.elements):
        for a, b in links[(links >= 0).all(axis=1)].tolist():
            part = np.asarray(np.where(part == part[b], part[a], part))
    return part


def _rigid_motions(
    layout: Layout, conditions: Conditions, member: np.ndarray, size: float
) -> tuple[np.ndarray, np.ndarray]:
    """(n, 6) what six rigid motions (turns of 1/size) do to the held dofs; (6,) work of the dead loads on them.

    Held turns and strains are taken times the size: all rows are then lengths, and the answer is the same in any unit.
    """
    rows, load = [np.zeros((0, 6))], np.zeros(6)
    for kind in KINDS:
        if layout.rows(kind) == 0:
            continue
        owner = layout.owner[kind]
        motion = _motion_of_rows(layout, kind, owner, size)
        motion[~member[owner]] = 0.0
        alike = motion.copy()
        alike[:, 3:] *= size
        rows.append(alike[conditions.prescribed[kind] & member[owner][:, None]])
        dead = conditions.load[kind]
        if dead is not None:
            load += np.einsum("ri,rim->m", dead, motion)
    return np.concatenate(rows), load


def _motion_of_rows(layout: Layout, kind: str, owner: np.ndarray, size: float) -> np.ndarray:
    """(rows, dofs, 6): each dof under a unit move along, and a turn of 1/size about, x, y and z.

    Turns are about the middle of the specimen, wherever that stands.
    """
    identity, arm = np.eye(3), layout.place[kind] - layout.centroid.mean(axis=0)
    moves = np.concatenate([np.broadcast_to(identity, (len(owner), 3, 3)), _cross(arm) / size], axis=2)
    turns = np.stack([KIND[kind].spin(layout.axes[owner], axis) for axis in identity], axis=2) / size
    beyond = np.concatenate([np.zeros(turns.shape), turns], axis=2)
    return np.concatenate([moves, beyond], axis=1)


def _cross(place: np.ndarray) -> np.ndarray:
    """(n, 3, 3): column m is e_m x place."""
    return np.cross(np.eye(3)[None, :, :], place[:, None, :]).transpose(0, 2, 1)


def _refuse(specimen: Specimen, layout: Layout, member: np.ndarray, why: str) -> None:
    block = int(np.flatnonzero(member)[0])
    blocks = specimen.blocks
    where = ", ".join(f"{x:.4g}" for x in layout.centroid[block])
    raise SceneError(
        f"block {block} (group '{blocks.groups[blocks.group[block]]}', unit {blocks.unit[block]}) at ({where}) m "
        f"and what it touches {why}"
    )

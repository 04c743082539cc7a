"""How far the strength of a run is off, as the few contact points of its joints bear another moment than many.

Each joint is held against one of many points (`joint_motions.py`) under the forces that it has at the peak, in bending
and in its plane. By virtual work, the strength is off by the sum over the joints of the error of what they bear times
their share of the work.
"""

from typing import NamedTuple

import numpy as np

from geometry.joints.point_density import Density
from masonry.detection.spread import rounds_of
from masonry.estimates.bearing_points import SPREAD, own_points, patch_points, points_of
from masonry.estimates.inspection import Inspection
from masonry.estimates.joint_faces import MOST, are_patches
from masonry.estimates.joint_loads import Look
from masonry.estimates.strength.joint_motions import Borne, bent, slid
from masonry.estimates.strength.mechanisms import bears_at_peak, borne_together

LITTLE, FIRST = 1e-4, 10
"""Share of the work below which no joint is looked at; those with the largest shares for which other numbers of points
are tried."""
ROWS = (3, 4, 5, 6, 8, 10, 12, 16, 20, 30)
"""Numbers of points along an edge, of which the least is proposed from which on all do."""
LIFTS = 0.05
"""Of the mean closing of a dry joint: a point that closes by less hardly bears, and is about to lift off."""
NOTHING = 1e-6
"""Times what many points bear: so much is counted of points that bear nothing."""
TURNS = 0.1
"""Fraction of the work behind the peak that is not elastic, from which on joints turn, and not only slide."""


class StrengthError(NamedTuple):
    """The strength over what it should be; the joint that matters most, with the load that its points bear over that of
    many, or that it carries; all joints that matter, each with the number of its face."""

    ratio: float
    joint: Borne
    borne: float
    bearing: list[tuple[int, Borne]]


def strength_error(inspection: Inspection) -> StrengthError | None:
    """None where no joint matters."""
    bearing = _that_matter(inspection)
    if not bearing:
        return None
    points = [own_points(inspection.assembly, inspection.faces, face) for face, _ in bearing]
    joints = [joint for _, joint in bearing]
    borne = np.array([joint.by(*places) for joint, places in zip(joints, points, strict=True)])
    carried = np.array([_carried(joint, ratio) for joint, ratio in zip(joints, borne, strict=True)])
    ratio = _off_together(joints, carried, points)
    shares = np.array([joint.shares.max() for joint in joints])
    errors = np.log(carried) * np.sign(ratio - 1.0)  # above 0 where a joint is off the way the strength is
    worst = int(np.argmax(shares * errors))
    return StrengthError(ratio, joints[worst], float((borne if joints[worst].gave else carried)[worst]), bearing)


def _that_matter(inspection: Inspection) -> list[tuple[int, Borne]]:
    """The joints that may matter, each in one way: that gave way, or whose load only few points can bear.

    What is dry bears the more the further it turns: each joint is asked up to a turn that all may have.
    """
    frames, assembly = inspection.frames, inspection.assembly
    if not frames or not (
        inspection.is_for_strength or inspection.faces.glued.any() or frames[-1].crushing is not None
    ):
        return []
    faces, peak = inspection.faces, inspection.peak
    looks = [inspection.look(number) for number in range(len(frames))]
    behind = min(peak + 1, len(looks) - 1) if assembly.scene.drive is not None else -1
    now, gave = looks[peak], _gave_way(inspection, looks)
    turn = np.max([np.linalg.norm(look.turn, axis=1) for look in looks], axis=0)
    bends, slides = _shares(gave, now, looks[behind])
    if not (np.isfinite(bends).all() and np.isfinite(slides).all() and np.isfinite(turn).all()):
        return []
    farthest = _farthest(inspection, looks, bends)
    matter: list[tuple[int, Borne]] = []
    for face in _largest(bends):
        turns = turn[face], farthest if gave[face] else np.inf
        one = bent(assembly, faces, now, face, bool(gave[face]), turns, bends[face])
        matter += [] if one is None else [(face, one)]
    for face in _largest(slides):
        one = slid(assembly, faces, now, inspection.shear(peak), frames[peak], face, slides[face])
        matter += [] if one is None else [(face, one)]
    return matter


def _farthest(inspection: Inspection, looks: list[Look], bends: np.ndarray) -> float:
    """rad, up to which a dry joint may turn: as far as that which turns most while a drive stays at its peak, if joints
    turn behind it; without end under a load that grows, or where joints but slide. bends (J, 2) shares of the work."""
    if bends[:, 1].sum() <= TURNS:
        return float(np.inf)
    at_peak = [float(np.linalg.norm(looks[number].turn, axis=1).max(initial=0.0)) for number in inspection.plateau]
    return max(at_peak, default=float(np.inf))


def _largest(shares: np.ndarray) -> list[int]:
    """The faces that have the largest shares (J, 2)."""
    most = shares.max(axis=1)
    return [int(face) for face in np.argsort(-most, kind="stable")[:MOST] if most[face] >= LITTLE]


def _gave_way(inspection: Inspection, looks: list[Look]) -> np.ndarray:
    """(J,) which faces tore at any time, or are open in part at the peak, or nearly so, where they have no tension, or
    crushed."""
    faces, frame = inspection.faces, inspection.frames[inspection.peak]
    torn = faces.glued & np.any([look.torn for look in looks], axis=0)
    even = np.maximum(-looks[inspection.peak].force / (faces.stiffness * faces.area), 0.0)[faces.of]
    gave = torn | (~faces.glued & (faces.sums((frame.opening > -LIFTS * even).astype(float)) > 0.0))
    return gave if frame.crushing is None else gave | (faces.sums((frame.crushing > 0.0).astype(float)) > 0.0)


def _shares(gave: np.ndarray, now: Look, later: Look) -> tuple[np.ndarray, np.ndarray]:
    """(J, 2) of the work of bending, and of sliding: of all at the peak, and of what is not elastic behind it, in
    joints that gave way.

    Joints that are whole do nothing of the second; in a specimen of one joint the first is diluted by its elasticity.
    """
    whole, lost = max(now.work.total, 1e-300), max(later.inelastic.total, 1e-300)
    bends = np.column_stack([now.work.bending / whole, np.where(gave, later.inelastic.bending / lost, 0.0)])
    return bends, np.column_stack([now.work.sliding / whole, later.inelastic.sliding / lost])


def _carried(one: Borne, borne: float) -> float:
    """Ratio of the load of a joint at the peak to that of a stress spread over it.

    That lies between what its points bear at most and the moment that they have then, as not all joints bear most at
    the same time; of a joint that is whole it is this moment.
    """
    if not one.gave:
        return one.carries
    return float(np.sqrt(borne * (one.carries if one.carries > 1.0 else min(borne, 1.0))))


def _off_together(joints: list[Borne], carried: np.ndarray, points: list[tuple[np.ndarray, np.ndarray]]) -> float:
    """The strength over what it should be: joints that bend open do so in one mechanism, the others each by itself."""
    bend = [k for k, (one, own) in enumerate(zip(joints, points, strict=True)) if bears_at_peak(one, own)]
    each = np.tile(carried[:, None], 2)
    if bend:
        each[bend] = borne_together([joints[k] for k in bend], [points[k] for k in bend])
    return _off(joints, each)


def _off(joints: list[Borne], carried: np.ndarray) -> float:
    """The strength over what it should be, by the one of the two reckonings by which it is further off; carried (J,),
    or (J, 2) for each of them."""
    carried = np.maximum(carried.reshape(len(joints), -1), NOTHING)
    off = 1.0 / (1.0 - ((1.0 - 1.0 / carried) * np.array([one.shares for one in joints])).sum(axis=0))
    return float(off[np.argmax(np.abs(np.log(off)))])


def bears_on_nodes(inspection: Inspection, error: StrengthError) -> bool:
    """Whether contact points of joints that matter are nodes of a mesh."""
    joints = inspection.assembly.joints
    contacts = np.concatenate([joint.contacts for _, joint in error.bearing])
    return bool((joints.node_a[contacts] >= 0).any() or (joints.node_b[contacts] >= 0).any())


def enough_points(inspection: Inspection, bears: list[tuple[int, Borne]], limit: float) -> str:
    """Key and value of a scene by which the same estimate is small enough."""
    assembly = inspection.assembly
    bears = sorted(bears, key=lambda pair: -float(pair[1].shares.max()))
    first, enough = [one for _, one in bears[:FIRST]], ROWS[-1]
    limit *= sum(one.shares.max() for one in first) / sum(one.shares.max() for _, one in bears)
    if are_patches(assembly, inspection.faces, bears[0][0]):
        return _of_patches(inspection, bears[:FIRST], limit)
    for rows in reversed(ROWS):
        density = Density(assembly.scene.contact_points, rows)
        points = [points_of(inspection.faces.polygons[face], density) for face, _ in bears[:FIRST]]
        borne = np.array([one.by(*these) for one, these in zip(first, points, strict=True)])
        if abs(_off(first, borne) - 1.0) > limit:
            break
        enough = rows
    return f"specimen.points_per_edge = {enough}{' or more' * (enough == ROWS[-1])}"


def _of_patches(inspection: Inspection, bears: list[tuple[int, Borne]], limit: float) -> str:
    """The simplest choice of patches that makes the estimate small enough."""
    choices = {'patch_points = "spread"': SPREAD} | {
        f"patch_points_per_edge = {along}": rounds_of(along) for along in ROWS if along % 2 == 0
    }
    patches = [(face, one) for face, one in bears if are_patches(inspection.assembly, inspection.faces, face)]

    def off(rounds: np.ndarray) -> float:
        points = [patch_points(inspection.faces, face, rounds) for face, _ in patches]
        borne = np.array([one.by(*these) for (_, one), these in zip(patches, points, strict=True)])
        return abs(_off([one for _, one in patches], borne) - 1.0)

    enough = (words for words, rounds in choices.items() if off(rounds) <= limit)
    return f"specimen.{next(enough, list(choices)[-1])}"

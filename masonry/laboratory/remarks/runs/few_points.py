"""Are the contact points of joints that bend, or slide and twist, too few? Few points bear another moment than many.

Each joint is held against one of many points (`estimates/joint_motions.py`) under the forces that it has at the peak,
in bending and in its plane. By virtual work, the strength is off by the sum over the joints of the error of what they
bear times their share of the work. The limit is the accuracy that the scene asks for, but no less than the 1.5 % of
this estimate.
"""

import numpy as np

from geometry.joints.point_density import Density
from masonry.detection.spread import rounds_of
from masonry.estimates.joint_faces import MOST, SPREAD, Look, are_patches, own_points, patch_points, points_of
from masonry.estimates.joint_motions import Borne, bent, slid
from masonry.estimates.mechanisms import bears_at_peak, borne_together
from masonry.judgement.doubt import Doubt
from masonry.laboratory.remarks.inspection import Inspection

LITTLE, FIRST = 1e-4, 10
"""Share of the work below which no joint is looked at; those with the largest shares for which other numbers of points
are tried."""
ROWS = (3, 4, 5, 6, 8, 10, 12, 16, 20, 30)
"""Numbers of points along an edge, of which the least is proposed from which on all do."""
LIFTS = 0.05
"""Of the mean closing of a dry joint: a point that closes by less hardly bears, and is about to lift off."""
TWICE = 1.5
"""Times a strength from which on its error is told as a factor."""
NOTHING = 1e-6
"""Times what many points bear: so much is counted of points that bear nothing."""


def doubts(inspection: Inspection) -> list[Doubt]:
    """One where the strength is off by more than the accuracy that was asked for."""
    limit, bears = inspection.accuracy, _that_matter(inspection)
    if not bears:
        return []
    points = [own_points(inspection.assembly, inspection.faces, face) for face, _ in bears]
    joints = [one for _, one in bears]
    own = np.array([one.by(*these) for one, these in zip(joints, points, strict=True)])
    carried = np.array([_carried(one, ratio) for one, ratio in zip(joints, own, strict=True)])
    off = _off_together(joints, carried, points)
    if abs(off - 1.0) <= limit:
        return []
    worst = int(np.argmax(np.array([one.shares.max() for one in joints]) * np.log(carried) * np.sign(off - 1.0)))
    moves, load = ("slide and twist", "load") if joints[worst].in_plane else ("bend", "moment")
    sentence = (
        f"the contact points of joints that {moves} are too few: a joint bears "
        f"{(own if joints[worst].gave else carried)[worst]:.3g} times the {load} that it would bear with many, and the "
        f"{inspection.strength} may be {_size(off)}"
    )
    return [Doubt("few_points", off - 1.0, limit, sentence, _advice(inspection, bears, limit))]


def _that_matter(inspection: Inspection) -> list[tuple[int, Borne]]:
    """The joints that may matter, each in one way: that gave way, or whose load only few points can bear."""
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
    matter: list[tuple[int, Borne]] = []
    for face in _largest(bends):
        one = bent(assembly, faces, now, face, bool(gave[face]), turn[face], bends[face])
        matter += [] if one is None else [(face, one)]
    for face in _largest(slides):
        one = slid(assembly, faces, now, inspection.shear(peak), frames[peak], face, slides[face])
        matter += [] if one is None else [(face, one)]
    return matter


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
    whole = max(float((now.bends + now.slides).sum()), 1e-300)
    lost = max(float((later.bent + later.slid).sum()), 1e-300)
    bends = np.column_stack([now.bends / whole, np.where(gave, later.bent / lost, 0.0)])
    return bends, np.column_stack([now.slides / whole, later.slid / lost])


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


def _size(off: float) -> str:
    if max(off, 1.0 / off) >= TWICE:
        return f"about {off:.2g} times what it should be"
    return f"about {100.0 * abs(off - 1.0):.2g} % too {'high' if off > 1.0 else 'low'}"


def _advice(inspection: Inspection, bears: list[tuple[int, Borne]], limit: float) -> str:
    """Advice that makes the same estimate small enough."""
    assembly, joints = inspection.assembly, inspection.assembly.joints
    if any((joints.node_a[one.contacts] >= 0).any() or (joints.node_b[one.contacts] >= 0).any() for _, one in bears):
        return "take a smaller specimen.mesh_size, as their contact points are the nodes of the mesh"
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
    return f"take specimen.points_per_edge = {enough}{' or more' * (enough == ROWS[-1])}"


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
    return f"take specimen.{next(enough, list(choices)[-1])}"

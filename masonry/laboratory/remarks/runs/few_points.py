"""Are the contact points of joints that bend too few? Each row of them tears at once, and few rows bear another moment
than many.

Each joint is held against one of many points (`joint_sections.py`) under the normal force that it has at the peak. By
virtual work, the strength is off by the sum over the joints of the error of their moment times their share of the work.
The limit is the accuracy that the scene asks for, but no less than the 1.5 % of this estimate.
"""

from typing import NamedTuple

import numpy as np

from geometry.joints.contact_points import contact_points
from geometry.joints.point_density import Density
from masonry.assembly.assemble import Assembly
from masonry.judgement.doubt import Doubt
from masonry.laboratory.remarks.inspection import Inspection
from masonry.laboratory.remarks.joint_faces import MOST, Faces, Look, corners_of, is_glued, law_of
from masonry.laboratory.remarks.joint_sections import Envelope, depth_of, envelope, of_points, spread, strength

LITTLE, FIRST = 1e-4, 10
"""Share of the work below which no joint is looked at; those with the largest shares for which other numbers of points
are tried."""
FURTHER = 10.0
"""Times the opening at which a joint tears, up to which one that is whole could open were there more points."""
TURNED = 1e-3
"""Times the same opening: a joint that has never opened further at one edge than at the other does not bend."""
ROWS = (3, 4, 5, 6, 8, 10, 12, 16, 20, 30)
"""Numbers of points along an edge, of which the least is proposed from which on all do."""
TWICE = 1.5
"""Times a strength from which on its error is told as a factor."""


class Bent(NamedTuple):
    """A joint that bends: its contacts, whether it tore; at the peak its normal force N, its moment N m and its shares
    (2,) of the work; its law, its largest turn rad, the direction towards which it opens, its middle m, and the moment
    that it bears as a stress spread over its area, N m."""

    contacts: np.ndarray
    torn: bool
    force: float
    moment: float
    shares: np.ndarray
    law: Envelope
    turn: float
    along: np.ndarray
    middle: np.ndarray
    bears: float

    def by(self, point: np.ndarray, area: np.ndarray) -> float:
        """The moment that it bears by points (n, 3) m with areas (n,) m2, over that of a stress spread over it."""
        section = of_points((point - self.middle) @ self.along, area)
        return strength(section, self.law, self.force, self.moment, self.turn) / self.bears


def doubts(inspection: Inspection) -> list[Doubt]:
    """One where the strength is off by more than the accuracy that was asked for."""
    assembly, joints, limit = inspection.assembly, inspection.assembly.joints, inspection.accuracy
    bent = _that_bend(inspection)
    if not bent:
        return []
    own = [one.contacts for one in bent]
    borne = np.array([one.by(joints.point[c], joints.area[c]) for one, c in zip(bent, own, strict=True)])
    carried = np.array([_carried(one, ratio) for one, ratio in zip(bent, borne, strict=True)])
    off = _off(bent, carried)
    if abs(off - 1.0) <= limit:
        return []
    worst = int(np.argmax(np.array([one.shares.max() for one in bent]) * np.log(carried) * np.sign(off - 1.0)))
    sentence = (
        "the contact points of joints that bend are too few: a joint bears "
        f"{(borne if bent[worst].torn else carried)[worst]:.3g} times the moment that it would bear with many, and the "
        f"{inspection.strength} may be {_size(off)}"
    )
    return [Doubt("few_points", off - 1.0, limit, sentence, _advice(assembly, bent, own, limit))]


def _that_bend(inspection: Inspection) -> list[Bent]:
    """The joints that may matter: those that tore at any time, and those whose moment only few points can bear."""
    frames, assembly = inspection.frames, inspection.assembly
    if not frames or not any(map(is_glued, assembly.model.groups.properties)):
        return []
    faces, peak = inspection.faces, inspection.peak
    looks = [inspection.look(number) for number in range(len(frames))]
    behind = min(peak + 1, len(looks) - 1) if assembly.scene.drive is not None else -1
    now, torn = looks[peak], faces.glued & np.any([look.torn for look in looks], axis=0)
    turn = np.max([np.linalg.norm(look.turn, axis=1) for look in looks], axis=0)
    shares = _shares(torn, now, looks[behind])
    if not (np.isfinite(shares).all() and np.isfinite(turn).all()):
        return []
    bent: list[Bent] = []
    for face in np.argsort(-shares.max(axis=1), kind="stable"):
        if len(bent) == MOST or shares[face].max() < LITTLE:
            break
        if faces.glued[face] and (one := _bent(assembly, faces, now, face, bool(torn[face]), turn[face], shares[face])):
            bent.append(one)
    return bent


def _shares(torn: np.ndarray, now: Look, later: Look) -> np.ndarray:
    """(J, 2) of the work: of all at the peak, and of what is not elastic behind it, in joints that tore.

    Joints that are whole do nothing of the second; in a specimen of one joint the first is diluted by its elasticity.
    """
    whole = now.bends / max(float((now.bends + now.slides).sum()), 1e-300)
    lost = later.bent / max(float((later.bent + later.slid).sum()), 1e-300)
    return np.column_stack([whole, np.where(torn, lost, 0.0)])


def _bent(
    assembly: Assembly, faces: Faces, now: Look, face: int, torn: bool, turn: float, shares: np.ndarray
) -> Bent | None:
    """A joint face at the peak; None where it never turned, or neither tore nor bears more than its elastic moment."""
    length = float(np.linalg.norm(now.turn[face]))
    if length == 0.0:
        return None
    normal, middle = faces.normal[face], faces.middle[face]
    along = now.turn[face] / length
    corners = corners_of(assembly.joints, faces.patch[face])
    parameters, joint = law_of(assembly, faces, face)
    limit = float(joint.tensile_strength or 0.0)
    force, moment = float(now.force[face]), abs(float(now.moment[face] @ along))
    depth, tears_at = depth_of(corners @ along), limit / faces.stiffness[face]
    if turn * depth <= TURNED * tears_at or (not torn and moment < depth / 6.0 * (limit * faces.area[face] - force)):
        return None
    many = spread(corners, along, np.cross(normal, along), middle)
    if not torn:
        turn = max(turn, FURTHER * tears_at / many.depth)
    law = envelope(parameters, joint, 2.0 * turn * many.depth)
    bears = strength(many, law, force, moment, turn)
    if bears <= 0.0 or (not torn and moment <= bears):
        return None
    return Bent(faces.contacts(face), torn, force, moment, shares, law, turn, along, middle, bears)


def _carried(one: Bent, borne: float) -> float:
    """What a joint carries at the peak over what it would, as a stress spread over it.

    That lies between what its points bear at most and the moment that they have then, as not all joints bear most at
    the same time; of a joint that is whole it is this moment.
    """
    has = one.moment / one.bears
    return float(np.sqrt(borne * (has if has > 1.0 else min(borne, 1.0)))) if one.torn else has


def _off(bent: list[Bent], carried: np.ndarray) -> float:
    """The strength over what it should be, by the one of the two reckonings by which it is further off."""
    off = 1.0 / (1.0 - (1.0 - 1.0 / carried) @ np.array([one.shares for one in bent]))
    return float(off[np.argmax(np.abs(np.log(off)))])


def _size(off: float) -> str:
    if max(off, 1.0 / off) >= TWICE:
        return f"about {off:.2g} times what it should be"
    return f"about {100.0 * abs(off - 1.0):.2g} % too {'high' if off > 1.0 else 'low'}"


def _advice(assembly: Assembly, bent: list[Bent], own: list[np.ndarray], limit: float) -> str:
    """What makes the same estimate small enough."""
    joints = assembly.joints
    if any((joints.node_a[c] >= 0).any() or (joints.node_b[c] >= 0).any() for c in own):
        return "take a smaller specimen.mesh_size, as their contact points are the nodes of the mesh"
    first, enough = bent[:FIRST], ROWS[-1]
    limit *= sum(one.shares.max() for one in first) / sum(one.shares.max() for one in bent)
    polygons = [corners_of(joints, joints.patch[c[0]]) for c in own[:FIRST]]
    for rows in reversed(ROWS):
        density = Density(assembly.scene.contact_points, rows)
        points = [contact_points(corners[None], np.array([len(corners)]), density)[1:] for corners in polygons]
        borne = np.array([one.by(*these) for one, these in zip(first, points, strict=True)])
        if abs(_off(first, borne) - 1.0) > limit:
            break
        enough = rows
    return f"take specimen.points_per_edge = {enough}{' or more' * (enough == ROWS[-1])}"

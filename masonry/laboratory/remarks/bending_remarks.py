"""What few contact points make of joints that bend: by how much the strength of the specimen is off, and how many do.

Each joint is held against one of many points (`joint_sections.py`) under the normal force that it has at the peak. By
virtual work, the strength is off by the sum over the joints of the error of their moment times their share of the work.
"""

from typing import Any, NamedTuple

import numpy as np

from geometry.blocks import Joints
from geometry.joints.contact_points import contact_points
from geometry.joints.point_density import Density
from masonry.assembly.assemble import Assembly
from masonry.laboratory.remarks.joint_faces import Faces, Look, faces_of, is_glued, look_at
from masonry.laboratory.remarks.joint_sections import Envelope, envelope, of_points, spread, strength
from masonry.laws.state import JointProperties
from masonry.rows.columns import FACTOR
from masonry.rows.peak import before_a_collapse
from masonry.timeloop.recording import Outcome

LEAST, WITHOUT = 0.015, 0.02
"""Error of the strength below which nothing is said, whatever accuracy is asked for; that from which on, if none is."""
MOST, LITTLE, FIRST = 50, 1e-4, 10
"""Joints that are looked at, those with the largest shares of the work; share below which none is; those of them for
which other numbers of points are tried."""
FURTHER = 10.0
"""Times the opening at which a joint tears, up to which one that is whole could open were there more points."""
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


def bent_remarks(assembly: Assembly, outcome: Outcome) -> list[str]:
    """One line where the contact points of joints that bend are so few that the strength is off by more than the
    accuracy that was asked for."""
    joints, asked = assembly.joints, accuracy(assembly)
    bent = _that_bend(assembly, outcome)
    if not bent:
        return []
    own = [one.contacts for one in bent]
    borne = np.array([one.by(joints.point[c], joints.area[c]) for one, c in zip(bent, own, strict=True)])
    carried = np.array([_carried(one, ratio) for one, ratio in zip(bent, borne, strict=True)])
    off = _off(bent, carried)
    if abs(off - 1.0) <= asked:
        return []
    worst = int(np.argmax(np.array([one.shares.max() for one in bent]) * np.log(carried) * np.sign(off - 1.0)))
    return [
        "joints that bend have few rows of contact points, of which each tears at once, and bear as much as "
        f"{(borne if bent[worst].torn else carried)[worst]:.3g} times the moment that they would with many: the "
        f"{number_of(assembly)} may be {_size(off)}; {_advice(assembly, bent, own, asked)}"
    ]


def _that_bend(assembly: Assembly, outcome: Outcome) -> list[Bent]:
    """The joints that may matter: those that tore at any time, and those whose moment only few points can bear."""
    frames, model = outcome.history.frames, assembly.model
    if not frames or not any(map(is_glued, model.groups.properties)):
        return []
    faces = faces_of(assembly)
    looks, peak = [look_at(assembly, faces, frame) for frame in frames], at_peak(assembly, outcome)
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
    """A joint face at the peak; None where it neither tore nor bears more than its elastic moment."""
    length = float(np.linalg.norm(now.turn[face]))
    if length == 0.0:
        return None
    normal, middle = faces.normal[face], faces.middle[face]
    along = now.turn[face] / length
    many = spread(corners_of(assembly.joints, faces.patch[face]), along, np.cross(normal, along), middle)
    parameters, joint = law_of(assembly, faces, face)
    limit = float(joint.tensile_strength or 0.0)
    force, moment = float(now.force[face]), abs(float(now.moment[face] @ along))
    if not torn and moment < faces.area[face] * many.depth / 6.0 * (limit - force / faces.area[face]):
        return None
    if not torn:
        turn = max(turn, FURTHER * limit / (faces.stiffness[face] * many.depth))
    law = envelope(parameters, joint, 2.0 * turn * many.depth)
    bears = strength(many, law, force, moment, turn)
    if bears <= 0.0 or (not torn and moment <= bears):
        return None
    return Bent(faces.contacts(face), torn, force, moment, shares, law, turn, along, middle, bears)


def law_of(assembly: Assembly, faces: Faces, face: int) -> tuple[Any, JointProperties]:
    """Parameters and properties of a face: those of one of its contacts, where they scatter."""
    groups, group = assembly.model.groups, faces.group[face]
    contact = faces.contacts(face)[0] - groups.bounds[group]
    return _of(groups[0][group], contact), _of(groups[1][group], contact)


def _of(fields: Any, contact: int) -> Any:
    """The same NamedTuple with numbers of one contact of its group, where they scatter."""
    return type(fields)(*(value if np.ndim(value) == 0 else value[contact] for value in fields))


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


def number_of(assembly: Assembly) -> str:
    """The number that is off."""
    return "peak" if assembly.scene.drive is not None else "load that is borne"


def _size(off: float) -> str:
    if max(off, 1.0 / off) >= TWICE:
        return f"about {off:.2g} times what it should be"
    return f"about {100.0 * abs(off - 1.0):.2g} % too {'high' if off > 1.0 else 'low'}"


def _advice(assembly: Assembly, bent: list[Bent], own: list[np.ndarray], asked: float) -> str:
    """What makes the same estimate small enough."""
    joints = assembly.joints
    if any((joints.node_a[c] >= 0).any() or (joints.node_b[c] >= 0).any() for c in own):
        return "take a smaller specimen.mesh_size, as their contact points are the nodes of the mesh"
    first, enough = bent[:FIRST], ROWS[-1]
    asked *= sum(one.shares.max() for one in first) / sum(one.shares.max() for one in bent)
    polygons = [corners_of(joints, joints.patch[c[0]]) for c in own[:FIRST]]
    for rows in reversed(ROWS):
        density = Density(assembly.scene.contact_points, rows)
        points = [contact_points(corners[None], np.array([len(corners)]), density)[1:] for corners in polygons]
        borne = np.array([one.by(*these) for one, these in zip(first, points, strict=True)])
        if abs(_off(first, borne) - 1.0) > asked:
            break
        enough = rows
    return f"take specimen.points_per_edge = {enough}{' or more' * (enough == ROWS[-1])}"


def corners_of(joints: Joints, patch: int) -> np.ndarray:
    """(K, 3) m of the polygon of a joint face."""
    return joints.patch_points[joints.patch_start[patch] : joints.patch_start[patch + 1]]


def accuracy(assembly: Assembly) -> float:
    """The accuracy that the scene asks for, but no less than that of the estimate."""
    drive, limit = assembly.scene.drive, assembly.scene.limit
    wanted = drive.accuracy if drive is not None else None if limit is None else limit.accuracy
    return max(WITHOUT if wanted is None else wanted, LEAST)


def at_peak(assembly: Assembly, outcome: Outcome) -> int:
    """Number of the frame of the peak; without a drive, of the last one before anything fell."""
    steps, fallen = [frame.step for frame in outcome.history.frames], outcome.found.get("collapse")
    rows = before_a_collapse(outcome.history.rows, None if fallen is None else fallen[1])
    if assembly.scene.drive is not None and "peak" in outcome.standing:
        step = outcome.standing["peak"].step
    elif FACTOR in rows:
        borne = rows[FACTOR] <= outcome.loading.borne
        step = int(rows["step"][np.argmax(np.where(borne, rows[FACTOR], -np.inf))])
    else:
        step = int(rows["step"][-1])
    return max(int(np.searchsorted(steps, step, side="right")) - 1, 0)

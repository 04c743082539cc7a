"""Joints with one row of contact points: they bear no moment about it, and turn there as hinges do.

By virtual work, the strength of a specimen is too low by at most the moments that these joints would bear, as stresses
spread over them, times their turns, over the work of all joints with them: those that bear moments turn less.
"""

from typing import NamedTuple

import numpy as np

from masonry.assembly.assemble import Assembly
from masonry.configuration.energy import present
from masonry.laboratory.remarks.bending_remarks import MOST, accuracy, at_peak, corners_of, law_of, number_of
from masonry.laboratory.remarks.contact_remarks import is_dry
from masonry.laboratory.remarks.joint_faces import Faces, Look, faces_of, look_at
from masonry.laboratory.remarks.joint_sections import Section, envelope, plane, spread, strength
from masonry.results.deformation import Corners, Deformation
from masonry.rows.history import Frame
from masonry.timeloop.recording import Outcome

SLIVER = 1e-3
"""Depth of a joint over the root of its area, below which it bears no moment whatever its points are."""
FEELS = 1e-3
"""Of the tensile strength, or of the pressure: a joint turns if the stress at its edge would change by more."""
MOST_OF_IT = 0.95
"""Share of the work from which on it is not told how much the strength is off."""
ENOUGH = 4
"""Points along an edge that are proposed; a run with them says whether these do."""
ABOUT = 1e-6
"""Cosine from which on an axis is not at right angles to another."""


class Hinges(NamedTuple):
    """The H joint faces that have one row of contact points, or one point.

    face  (H,) their places among all faces
    bare  (H, 3, 3) onto the directions in the face along which they have points at one place only
    dry   (H,) whether they have no tension
    """

    face: np.ndarray
    bare: np.ndarray
    dry: np.ndarray


def hinges_of(assembly: Assembly, faces: Faces) -> Hinges:
    """All of a specimen, but dry joints in large displacement: their points are those of patches."""
    model = assembly.model
    dry = np.array([is_dry(assembly, group) for group in range(len(model.group_names))], dtype=bool)[faces.group]
    second = faces.sums(assembly.joints.area[:, None, None] * faces.arm[:, :, None] * faces.arm[:, None, :])
    flat = np.eye(3) - faces.normal[:, :, None] * faces.normal[:, None, :]
    bare = flat - faces.inverse @ second
    face = np.flatnonzero((~dry | (model.large is None)) & (np.trace(bare, axis1=1, axis2=2) > 0.5))
    wide = np.zeros(len(face), dtype=bool)
    for number, k in enumerate(face):
        across = (corners_of(assembly.joints, faces.patch[k]) - faces.middle[k]) @ bare[k]
        wide[number] = np.linalg.norm(np.ptp(across, axis=0)) > SLIVER * faces.area[k] ** 0.5
    return Hinges(face[wide], bare[face[wide]], dry[face[wide]])


def hinge_remarks(assembly: Assembly) -> list[str]:
    """One line for each contact group with such joints between blocks that may turn about them; of dry ones
    `rocking_remarks` says so."""
    model = assembly.model
    faces = faces_of(assembly)
    hinges = hinges_of(assembly, faces)
    first = faces.order[faces.start[hinges.face]]
    turns, count = _may_turn(assembly), np.zeros(len(model.group_names), dtype=int)
    for face, bare, dry, contact in zip(*hinges, first, strict=True):
        about = np.cross(faces.normal[face], bare.T)  # (3, 3), of which each row is an axis
        joined = assembly.joints.block_a[contact], assembly.joints.block_b[contact]
        if not dry and any((np.abs(turns[block] @ about.T) > ABOUT).any() for block in joined):
            count[faces.group[face]] += 1
    return [
        f"contact.{name}: {number} joint{'s have' if number > 1 else ' has'} one row of contact points, and bear"
        f"{'s' if number == 1 else ''} no moment where blocks turn about it: {_advice(assembly)}"
        for name, number in zip(model.group_names, count, strict=True)
        if number
    ]


def _may_turn(assembly: Assembly) -> np.ndarray:
    """(B, 3, 3): the rows are axes about which each block is free to turn; 0 where it is not."""
    model, free = assembly.model, np.zeros((assembly.specimen.blocks.count, 3, 3))
    for kind, body in present(model):
        if kind == "tets":
            free[model.layout.members[kind]] = np.eye(3)
        elif kind == "rigid":
            axes = getattr(body, "axes", None) if model.large is None else None
            turns = (body.dt_over_mass[:, 3:] > 0.0)[:, :, None]
            free[model.layout.members[kind]] = turns * (np.eye(3) if axes is None else np.swapaxes(axes, 1, 2))
        else:
            turns = np.any(body.dt_over_mass[:, 3:] > 0.0, axis=1)
            free[model.layout.members[kind]] = turns[:, None, None] * np.eye(3)
    return free


def hinged_remarks(assembly: Assembly, outcome: Outcome) -> list[str]:
    """One line where, at the peak or right behind it, what such joints would have borne is more of the work than the
    accuracy that was asked for; of a run that was stopped, which often shows no more, that they may turn."""
    frames = outcome.history.frames
    if not frames:
        return []
    faces = faces_of(assembly)
    hinges = hinges_of(assembly, faces)
    if not len(hinges.face):
        return []
    shape, peak = Corners(assembly.specimen.blocks), at_peak(assembly, outcome)
    lacks = [_lacks(assembly, faces, hinges, frame, Deformation(shape, frame)) for frame in frames[peak : peak + 2]]
    share = max(lacks)
    if share <= accuracy(assembly):
        return hinge_remarks(assembly) if outcome.stopped else []
    much = "far too low" if share > MOST_OF_IT else f"too low by up to {100.0 * share:.2g} %"
    return [
        "joints have one row of contact points, turned about it, and bear no moment there, as a hinge: the "
        f"{number_of(assembly)} may be {much}; {_advice(assembly)}"
    ]


def _advice(assembly: Assembly) -> str:
    """The key that the scene has taken for the number of points."""
    specimen = assembly.scene.specimen
    if specimen.points_per_face is not None:
        return f"take specimen.points_per_face = {ENOUGH**2} or more"
    if specimen.contact_spacing is not None:
        return f"take a specimen.contact_spacing of 1/{ENOUGH} of the edges, or less"
    return f"take specimen.points_per_edge = {ENOUGH} or more"


def _lacks(assembly: Assembly, faces: Faces, hinges: Hinges, frame: Frame, field: Deformation) -> float:
    """Of the work that all joints would do in a frame: the part of moments that are not borne."""
    joints, look = assembly.joints, look_at(assembly, faces, frame)
    first = faces.order[faces.start[hinges.face]]
    a, b = (field.gradient[block[first]] for block in (joints.block_a, joints.block_b))
    seen_from_a = np.linalg.solve(np.eye(3) + a, b - a)
    turn = np.einsum("hij,hkj,hk->hi", hinges.bare, seen_from_a, faces.normal[hinges.face])
    opening = faces.sums(joints.area * frame.opening)[hinges.face] / faces.area[hinges.face]
    angle = np.linalg.norm(turn, axis=1)
    if not np.isfinite(angle).all():
        return 1.0
    lacks = 0.0
    for rank, k in enumerate(np.argsort(-angle * faces.area[hinges.face] ** 1.5, kind="stable")):
        if angle[k] > 0.0:
            at = hinges.face[k], turn[k], float(opening[k])
            of_face = _dry_moment if hinges.dry[k] else _moment
            lacks += angle[k] * of_face(assembly, faces, look, *at, rank < MOST)
    return lacks / max(lacks + float((look.bends + look.slides).sum()), 1e-300)


def _across(assembly: Assembly, faces: Faces, face: int, turn: np.ndarray) -> Section:
    """The whole area of a face in strips across the direction in which it opens by a turn (3,)."""
    along, normal = turn / np.linalg.norm(turn), faces.normal[face]
    return spread(corners_of(assembly.joints, faces.patch[face]), along, np.cross(normal, along), faces.middle[face])


def _dry_moment(
    assembly: Assembly, faces: Faces, look: Look, face: int, turn: np.ndarray, opening: float, closely: bool
) -> float:
    """As `_moment`, of a face without tension: at most its pressing force at its edge."""
    many, angle, stiffness = _across(assembly, faces, face, turn), float(np.linalg.norm(turn)), faces.stiffness[face]
    pressed = max(-float(look.force[face]), 0.0)
    if 0.5 * angle * many.depth * stiffness < FEELS * pressed / faces.area[face]:
        return 0.0
    stress = np.minimum(stiffness * (opening + angle * many.place), 0.0)
    return min(max(float(stress @ (many.area * many.place)), 0.0), 0.5 * pressed * many.depth)


def _moment(
    assembly: Assembly, faces: Faces, look: Look, face: int, turn: np.ndarray, opening: float, closely: bool
) -> float:
    """N m that a face would bear at its turn (3,) and mean opening (m), under its normal force; 0 if hardly turned."""
    many, angle = _across(assembly, faces, face, turn), float(np.linalg.norm(turn))
    if not faces.glued[face]:  # it is elastic whatever it bears
        return float(faces.stiffness[face] * angle * (many.area @ many.place**2))
    law = envelope(*law_of(assembly, faces, face), 2.0 * (abs(opening) + angle * many.depth))
    if 0.5 * angle * many.depth < FEELS * law.limit:
        return 0.0
    force, area = float(look.force[face]), float(faces.area[face])
    borne = max(plane(many, law, opening, angle), 0.0)
    elastic = area * many.depth / 6.0 * (law.stress[1] - force / area)
    if borne <= elastic:
        return borne
    return min(borne, strength(many, law, force, 0.0, angle) if closely else max(elastic, 0.0))

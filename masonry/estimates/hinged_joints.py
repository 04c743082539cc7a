"""Joints with one row of contact points: they bear no moment about it, and turn there as hinges do.

By virtual work, the strength of a specimen is too low by at most the moments that these joints would bear, as stresses
spread over them, times their turns, over the work of all joints with them: those that bear moments turn less.
"""

from typing import NamedTuple

import numpy as np

from geometry.joints.faces.strips import Section, spread
from masonry.assembly.assemble import Assembly
from masonry.configuration.parts.parts import parts_of
from masonry.estimates.inspection import Inspection
from masonry.estimates.joint_faces import MOST, Faces, corners_of, law_of
from masonry.estimates.joint_loads import Look
from masonry.estimates.strength.joint_sections import envelope, plane, strength
from masonry.results.deformation import BlockCorners, Deformation

SLIVER = 1e-3
"""Depth of a joint over the root of its area, below which it bears no moment whatever its points are."""
ABOUT = 1e-6
"""Cosine from which on an axis is not at right angles to another."""
FEELS = 1e-3
"""Of the tensile strength, or of the pressure: a joint turns if the stress at its edge would change by more."""


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
    second = faces.sums(assembly.joints.area[:, None, None] * faces.arm[:, :, None] * faces.arm[:, None, :])
    flat = np.eye(3) - faces.normal[:, :, None] * faces.normal[:, None, :]
    bare = flat - faces.inverse @ second
    face = np.flatnonzero((~faces.dry | (not assembly.scene.is_large)) & (np.trace(bare, axis1=1, axis2=2) > 0.5))
    wide = np.zeros(len(face), dtype=bool)
    for number, k in enumerate(face):
        across = (corners_of(faces, int(k)) - faces.middle[k]) @ bare[k]
        wide[number] = np.linalg.norm(np.ptp(across, axis=0)) > SLIVER * faces.area[k] ** 0.5
    return Hinges(face[wide], bare[face[wide]], faces.dry[face[wide]])


def free_to_turn(assembly: Assembly, faces: Faces, hinges: Hinges) -> np.ndarray:
    """(G,) how many such joints of each contact group lie between blocks that may turn about them; dry ones apart."""
    first = faces.order[faces.start[hinges.face]]
    turns, count = axes_of_turns(assembly), np.zeros(len(assembly.model.group_names), dtype=int)
    for face, bare, dry, contact in zip(*hinges, first, strict=True):
        about = np.cross(faces.normal[face], bare.T)  # (3, 3), of which each row is an axis
        joined = assembly.joints.block_a[contact], assembly.joints.block_b[contact]
        if not dry and any((np.abs(turns[block] @ about.T) > ABOUT).any() for block in joined):
            count[faces.group[face]] += 1
    return count


def axes_of_turns(assembly: Assembly) -> np.ndarray:
    """(B, 3, 3): the rows are axes about which each block is free to turn; 0 where it is not."""
    model, free = assembly.model, np.zeros((assembly.specimen.blocks.count, 3, 3))
    for part in parts_of(model):
        free[part.blocks] = part.turns_about()
    return free


def lacking_moments(inspection: Inspection, hinges: Hinges) -> float:
    """Of the work that all joints would do: the part of moments that are not borne, at the peak or right behind it."""
    frames, peak = inspection.frames, inspection.peak
    shape = BlockCorners(inspection.assembly.specimen.blocks)
    near = range(peak, min(peak + 2, len(frames)))
    return max(lacking_in_frame(inspection, hinges, number, Deformation(shape, frames[number])) for number in near)


def lacking_in_frame(inspection: Inspection, hinges: Hinges, number: int, field: Deformation) -> float:
    """As `lacking_moments`, in one frame."""
    assembly, faces, frame = inspection.assembly, inspection.faces, inspection.frames[number]
    joints, look = assembly.joints, inspection.look(number)
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
    return lacks / max(lacks + look.work.total, 1e-300)


def _across(assembly: Assembly, faces: Faces, face: int, turn: np.ndarray) -> Section:
    """The whole area of a face in strips across the direction in which it opens by a turn (3,)."""
    along, normal = turn / np.linalg.norm(turn), faces.normal[face]
    return spread(faces.polygons[face], along, np.cross(normal, along), faces.middle[face])


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

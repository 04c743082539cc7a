"""Do joints with one row of contact points make the strength too low? They bear no moment about it, as a hinge.

By virtual work, the strength of a specimen is too low by at most the moments that these joints would bear, as stresses
spread over them, times their turns, over the work of all joints with them: those that bear moments turn less. The limit
of that share is the accuracy that the scene asks for. A run that was stopped often shows no more than that they may
turn.
"""

import numpy as np

from masonry.assembly.assemble import Assembly
from masonry.estimates.joint_faces import MOST, Faces, Look, law_of
from masonry.estimates.joint_sections import Section, envelope, plane, spread, strength
from masonry.judgement.doubt import Doubt
from masonry.laboratory.remarks.hinges import Hinges, free_hinges, hinges_of, more_points
from masonry.laboratory.remarks.inspection import Inspection
from masonry.results.deformation import BlockCorners, Deformation

FEELS = 1e-3
"""Of the tensile strength, or of the pressure: a joint turns if the stress at its edge would change by more."""
MOST_OF_IT = 0.95
"""Share of the work from which on it is not told how much the strength is off."""


def doubts(inspection: Inspection) -> list[Doubt]:
    """One of what was not borne at the peak or right behind it; of a run that was stopped, of each group that may
    turn."""
    assembly, frames = inspection.assembly, inspection.frames
    if not frames:
        return []
    hinges = hinges_of(assembly, inspection.faces)
    if not len(hinges.face):
        return []
    shape, peak = BlockCorners(assembly.specimen.blocks), inspection.peak
    near = range(peak, min(peak + 2, len(frames)))
    lacks = [_lacks(inspection, hinges, number, Deformation(shape, frames[number])) for number in near]
    share, limit = max(lacks), inspection.accuracy
    if share <= limit:
        return free_hinges(assembly, inspection.faces, hinges) if inspection.outcome.stopped else []
    much = "far too low" if share > MOST_OF_IT else f"too low by up to {100.0 * share:.2g} %"
    sentence = (
        "joints with one row of contact points turned about it and bear no moment there, as a hinge: the "
        f"{inspection.strength} may be {much}"
    )
    return [Doubt("hinges", share, limit, sentence, more_points(assembly))]


def _lacks(inspection: Inspection, hinges: Hinges, number: int, field: Deformation) -> float:
    """Of the work that all joints would do in a frame: the part of moments that are not borne."""
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
    return lacks / max(lacks + float((look.bends + look.slides).sum()), 1e-300)


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

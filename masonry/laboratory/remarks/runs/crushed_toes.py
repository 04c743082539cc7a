"""Are the contact points too few at joints whose edge crushes? The moment of such a joint depends on where its stress
block ends, and few rows of points bear another moment than many.

By hand, under the normal force N that the joint has at the peak: a block of its compressive strength, as wide as bears
N, at the edge that is pressed; by its points, filled from that edge on, and by strips. The limit is 3 % of the moment,
of the joint that is farthest off; six Gauss points along an edge are within 4 %, ten within 1.5 %
(docs/choose-settings.md). A joint that bears a tenth of the largest moment or less is not asked: head joints touch at a
corner, where three points are off by a fifth, and walls bear the same with many. Nor is one whose edge crushed by far
less than it closes elastically: its stress is still a wedge, which few points bear well, and no block.

Patches of large displacement have ten points along an edge where blocks may crush. A scene that gives them fewer than
six is told so whatever happened: with two, which stand for a quarter of a face each, a toe may never come to its
strength.
"""

import numpy as np

from masonry.assembly.contact_pairs import points_along
from masonry.judgement.doubt import Doubt
from masonry.laboratory.remarks.inspection import Inspection
from masonry.laboratory.remarks.joint_faces import MOST, corners_of, law_of
from masonry.laboratory.remarks.joint_sections import Section, of_points, spread
from masonry.scene import Scene

OFF = 0.03
"""Of the moment of a joint."""
SMALL = 0.1
"""Of the largest moment of a joint."""
WEDGE = 0.1
"""Of the closing at which a joint presses by its strength: what crushed by less is no stress block yet."""
EVEN = 0.9
"""Of the largest plastic closing in a joint: where all points closed by more, it does not bend."""

FEWEST = 6
"""Points along an edge of a patch that may crush."""


def doubts(inspection: Inspection) -> list[Doubt]:
    """One at most."""
    return _of_patches(inspection.assembly.scene) or _of_joints(inspection)


def _of_patches(scene: Scene) -> list[Doubt]:
    if not scene.is_large or all(contact.crushing is None for contact in scene.contact.values()):
        return []
    along = points_along(scene, True)
    if along >= FEWEST or any(map(scene.is_meshed, scene.material)):  # each triangle of a mesh is a patch
        return []
    sentence = (
        f"patches of blocks that may crush have {along} points along each edge: these see a toe late, or never, "
        "and what it bears may be off by a third"
    )
    advice = "take specimen.patch_points_per_edge = 10, the default"
    return [Doubt("crushed_toes", 1.0 / along, 1.0 / FEWEST, sentence, advice)]


def _of_joints(inspection: Inspection) -> list[Doubt]:
    model = inspection.assembly.model
    crushed = model.state.crushed
    if crushed is None or not inspection.frames or not crushed[:, 0].any():
        return []
    off = _errors(inspection, crushed[:, 0])
    worst = max(off, key=abs, default=0.0)
    if abs(worst) <= OFF:
        return []
    sentence = (
        f"the contact points of joints whose edge crushes are too few: a joint bears {100 * abs(worst):.2g} % "
        f"{'more' if worst > 0.0 else 'less'} moment than it would with many"
    )
    return [
        Doubt("crushed_toes", worst, OFF, sentence, "take more specimen.points_per_edge along edges that bend: 6 to 10")
    ]


def _errors(inspection: Inspection, closing: np.ndarray) -> list[float]:
    """The moment of the stress block by points over that by strips, less one, of the joints that were crushed most."""
    assembly, faces, look = inspection.assembly, inspection.faces, inspection.look(inspection.peak)
    joints, errors = assembly.joints, []
    small = SMALL * float(np.linalg.norm(look.moment, axis=1).max(initial=0.0))
    most = np.maximum.reduceat(closing[faces.order], faces.start[:-1])
    for face in np.argsort(-most, kind="stable")[:MOST]:
        own, length = faces.contacts(face), float(np.linalg.norm(look.moment[face]))
        joint, force = law_of(assembly, faces, face)[1], -float(look.force[face])
        strength = joint.compressive_strength
        if strength is None or length <= small or force <= 0.0:
            continue
        if most[face] <= WEDGE * float(strength) / float(joint.normal_stiffness):
            continue
        share = force / (float(strength) * faces.area[face])
        if closing[own].min() > EVEN * most[face] or share >= 1.0:
            continue
        along, middle = look.moment[face] / length, faces.middle[face]
        points = of_points((joints.point[own] - middle) @ along, joints.area[own])
        corners = corners_of(joints, faces.patch[face])
        strips = spread(corners, along, np.cross(faces.normal[face], along), middle)
        errors.append(_moment_of_block(points, share) / _moment_of_block(strips, share) - 1.0)
    return errors


def _moment_of_block(section: Section, share: float) -> float:
    """m2, over the strength: of a stress block on a share of the area, from the edge with the lowest place on."""
    order = np.argsort(section.place)
    place, area = section.place[order], section.area[order]
    before = np.cumsum(area) - area
    filled = np.clip(share * area.sum() - before, 0.0, area)
    return float(-(filled @ (place - (area @ place) / area.sum())))

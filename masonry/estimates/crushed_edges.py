"""How far off the energy is that crushing took in joints that crush at an edge.

Such a joint turns about the place where its crushed part ends, and closes by the more the farther from it. With points
that place lies at one of them: the moment hardly changes by it, what the edge closed by does. By hand, under the normal
force of the joint where the drive is farthest, from a fifth less to a quarter more: the energy of the crushed part by
its points and by strips, both elastic up to the strength, at the turn that the joint has. It is as often too large as
too small, so joints add up by their squares. What crushed evenly is known.
"""

import numpy as np

from geometry.joints.faces.strips import Section, of_points, spread
from masonry.assembly.assemble import Assembly
from masonry.assembly.contact_pairs import points_along
from masonry.detection.spread import rounds_of
from masonry.estimates.bearing_points import patch_points
from masonry.estimates.inspection import Inspection
from masonry.estimates.joint_faces import MOST, Faces, law_of

EVEN = 0.9
"""Of the largest plastic closing in a joint: where its mean is more, the joint does not bend."""
NOTHING = 1e-9
"""Of area times depth: a volume that is crushed (m3, over strength and turn) below counts as none."""
EVENLY = np.linspace(0.0, 1.0, 801)
"""Where strips begin and end: so many as make nothing of their own beside forty points."""
SHARES = np.linspace(0.8, 1.25, 16)
"""Of the normal force of a joint."""


def crushing_error(inspection: Inspection, closing: np.ndarray) -> float:
    """Of the energy that crushing took in all joints, as a share."""
    assembly, faces, frames = inspection.assembly, inspection.faces, inspection.frames
    drive = np.abs([frame.displacement for frame in frames])
    look = inspection.look(int(np.flatnonzero(drive == drive.max())[-1]))
    most = np.maximum.reduceat(closing[faces.order], faces.start[:-1])
    volume, squares = faces.sums(closing * assembly.joints.area), 0.0
    for face in np.argsort(-volume, kind="stable")[:MOST]:
        force, turn = -float(look.force[face]), float(np.linalg.norm(look.turn[face]))
        contact = assembly.scene.contact_of(assembly.model.group_names[faces.group[face]])
        drawn = law_of(assembly, faces, face)[1].compressive_strength
        bears = contact.compressive_strength if drawn is None else drawn  # patches have that of the scene
        if force <= 0.0 or turn <= 0.0 or contact.crushing is None or bears is None:
            continue
        if volume[face] > EVEN * faces.area[face] * most[face]:
            continue
        strain = turn * float(faces.stiffness[face])
        points, strips = _sections(assembly, faces, face, look.turn[face] / turn)
        share = min(force / (bears * faces.area[face]), 1.0 / SHARES[-1] - 1e-9)
        had, by_hand = (
            np.array([_crushed(section, bears / strain, share * s) for s in SHARES]) for section in (points, strips)
        )
        crushes = by_hand > NOTHING * faces.area[face] * strips.depth
        ratio = np.where(crushes, had / np.where(crushes, by_hand, 1.0) - 1.0, 0.0)
        squares += (volume[face] * float(np.sqrt(np.mean(ratio**2)))) ** 2
    return float(np.sqrt(squares) / max(volume.sum(), 1e-300))


def _sections(assembly: Assembly, faces: Faces, face: int, along: np.ndarray) -> tuple[Section, Section]:
    """The points of a joint, or of the patch in its place, and strips; across the axis about which it turns."""
    joints, middle, scene, own = assembly.joints, faces.middle[face], assembly.scene, faces.contacts(face)
    strips = spread(faces.polygons[face], along, np.cross(faces.normal[face], along), middle, EVENLY)
    if not scene.is_large or assembly.model.alive[own].all():
        return of_points((joints.point[own] - middle) @ along, joints.area[own]), strips
    point, area = patch_points(faces, face, rounds_of(points_along(scene, True)))
    return of_points((point - middle) @ along, area), strips


def _crushed(section: Section, elastic: float, share: float) -> float:
    """m3, over strength and turn: volume that is crushed at the edge with the lowest place, where a section bears a
    share of its strength and presses by the strength `elastic` (m) from where it opens."""
    place, low, high = section.place, section.place.min(), section.place.max() + elastic
    area = section.area / section.area.sum()
    for _ in range(60):
        opens = 0.5 * (low + high)
        low, high = (opens, high) if area @ np.clip((opens - place) / elastic, 0.0, 1.0) < share else (low, opens)
    return float(section.area @ np.maximum(high - elastic - place, 0.0))

"""How near to their edges the contact points of joints without tension reach, about which these rock.

A joint rocked where it was open on one side and pressed on the other in a frame: open by a thousandth of the largest
movement of any contact. One whose edge crushed does not rock about a point: it turns about the end of what is crushed.
"""

import numpy as np

from geometry.joints.faces.whole_faces import reach_along
from masonry.assembly.assemble import Assembly
from masonry.estimates.hinged_joints import axes_of_turns
from masonry.estimates.inspection import Inspection
from masonry.estimates.joint_faces import Faces, corners_of

TOE = 0.1
"""Of the closing at which a joint presses by its strength: what closed for good by more is a crushed edge."""
LIFTED = 1e-3
"""Share of the largest opening or closing of all contacts from which on one is open."""
FREE = 1e-6
"""Of a unit vector: a part of an axis across the normal of a joint below bends it by nothing."""


def reach_of(faces: Faces, face: int, along: np.ndarray) -> float:
    """Of the points of a face from its middle, over its corners, where it opens along directions (D, 3)."""
    return reach_along(faces.arm[faces.contacts(face)], corners_of(faces, face) - faces.middle[face], along)


def reach_where_rocked(inspection: Inspection) -> np.ndarray:
    """(J,) of each face towards the edges about which it rocked in a run; infinite where it did not."""
    faces = inspection.faces
    reach, toes = np.full(len(faces.area), np.inf), _any(faces, _crushed(inspection))
    for number, frame in enumerate(inspection.frames):
        apart = frame.opening > LIFTED * float(np.abs(frame.opening).max(initial=0.0))
        turn = inspection.look(number).turn
        rocked = _any(faces, frame.normal_stress < 0.0) & _any(faces, apart) & ~toes & np.isfinite(turn).all(axis=1)
        for face in np.flatnonzero(rocked):
            reach[face] = min(reach[face], reach_of(faces, int(face), turn[face][None]))
    return reach


def reach_where_free(assembly: Assembly, faces: Faces) -> np.ndarray:
    """(J,) of each dry face towards the edges about which it may turn; infinite where it may not."""
    joints, turns = assembly.joints, axes_of_turns(assembly)
    first, reach = faces.order[faces.start[:-1]], np.full(len(faces.area), np.inf)
    for face in np.flatnonzero(faces.dry):
        for block in (joints.block_a[first[face]], joints.block_b[first[face]]):
            along = _openings(faces, int(face), turns[block])
            reach[face] = min(reach[face], reach_of(faces, int(face), along))
    return reach


def _crushed(inspection: Inspection) -> np.ndarray:
    """(C,) which contacts closed for good by a tenth of what they close elastically at their strength."""
    model, frames = inspection.assembly.model, inspection.frames
    crushed = np.zeros(len(model.group), dtype=bool)
    closing = frames[-1].crushing if frames else None
    if closing is None:
        return crushed
    groups = model.groups
    for joint, first, end in zip(groups.properties, groups.bounds[:-1], groups.bounds[1:], strict=True):
        if joint.compressive_strength is not None:
            elastic = np.asarray(joint.compressive_strength) / np.asarray(joint.normal_stiffness)
            crushed[first:end] = closing[first:end] > TOE * elastic
    return crushed


def _any(faces: Faces, contacts: np.ndarray) -> np.ndarray:
    """(J,) which faces have such contacts (C,)."""
    return np.asarray(faces.sums(contacts.astype(float)) > 0.0)


def _openings(faces: Faces, face: int, axes: np.ndarray) -> np.ndarray:
    """(D, 3) the directions along which a face may open as a block turns about axes (3, 3): across each of its edges,
    where it may turn about both axes in its plane."""
    normal = faces.normal[face]
    across = np.cross(normal, axes)
    _, sizes, directions = np.linalg.svd(across)
    free = directions[sizes > FREE]
    if len(free) < 2:
        return np.concatenate([free, -free])
    edges = np.concatenate([np.roll(corners, -1, axis=0) - corners for corners in faces.polygons[face]])
    along = np.cross(normal, edges)
    return np.concatenate([along, -along])

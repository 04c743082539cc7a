"""Did joints without tension rock about points within their edges? Such a block has too short a lever arm.

A joint rocked where it was open on one side and pressed on the other in a frame: open by a thousandth of the largest
movement of any contact. One whose edge crushed does not rock about a point: it turns about the end of what is crushed.
Of a run that is made for a strength few_points says what that makes of it.
"""

import numpy as np

from masonry.estimates.joint_faces import Faces
from masonry.judgement.doubt import Doubt
from masonry.laboratory.remarks.edge_reach import reach_along, rocking
from masonry.laboratory.remarks.inspection import Inspection

TOE = 0.1
"""Of the closing at which a joint presses by its strength: what closed for good by more is a crushed edge."""
LIFTED = 1e-3
"""Share of the largest opening or closing of all contacts from which on one is open."""


def doubts(inspection: Inspection) -> list[Doubt]:
    """One for each contact group."""
    if inspection.is_for_strength:
        return []
    faces = inspection.faces
    reach, toes = np.full(len(faces.area), np.inf), _any(faces, _crushed(inspection))
    for number, frame in enumerate(inspection.frames):
        apart = frame.opening > LIFTED * float(np.abs(frame.opening).max(initial=0.0))
        turn = inspection.look(number).turn
        rocked = _any(faces, frame.normal_stress < 0.0) & _any(faces, apart) & ~toes & np.isfinite(turn).all(axis=1)
        for face in np.flatnonzero(rocked):
            reach[face] = min(reach[face], reach_along(faces, int(face), turn[face][None]))
    return rocking(inspection.assembly, faces, reach, "opened on one side and turn")


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

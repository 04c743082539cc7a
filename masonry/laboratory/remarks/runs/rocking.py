"""Did joints without tension rock about points within their edges? Such a block has too short a lever arm.

A joint rocked where it was open on one side and pressed on the other in a frame: open by a thousandth of the largest
movement of any contact.
"""

import numpy as np

from masonry.judgement.doubt import Doubt
from masonry.laboratory.remarks.edge_reach import rocking
from masonry.laboratory.remarks.inspection import Inspection

LIFTED = 1e-3
"""Share of the largest opening or closing of all contacts from which on one is open."""


def doubts(inspection: Inspection) -> list[Doubt]:
    """One for each contact group."""
    patch = inspection.assembly.joints.patch
    rocked = np.zeros(len(patch), dtype=bool)
    for frame in inspection.frames:
        pressed = frame.normal_stress < 0.0
        apart = frame.opening > LIFTED * float(np.abs(frame.opening).max(initial=0.0))
        rocked |= _in_joints_of(patch, pressed, apart)
    return rocking(inspection.assembly, rocked, "opened on one side and turn")


def _in_joints_of(patch: np.ndarray, some: np.ndarray, others: np.ndarray) -> np.ndarray:
    """(C,) which contacts lie in joint faces that have points of both kinds."""
    return np.isin(patch, patch[some]) & np.isin(patch, patch[others])

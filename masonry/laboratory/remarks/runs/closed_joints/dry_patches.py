"""Do dry joints decide that hardly open, on patches with points at their corners alone? Patches of large displacement
lie there where the scene chooses none, and bend three times as stiffly as an even pressure does.

They decide where no block moved by more than a thousandth of the smallest one: then joints hardly open.
"""

import numpy as np

from masonry.estimates.inspection import Inspection
from masonry.estimates.joint_faces import dry_groups
from masonry.judgement.doubt import POINTS, Doubt
from masonry.laboratory.remarks.bending_points import SPREAD, points_are_chosen
from masonry.monitors.stability import smallest_block

STAYS = 1e-3
"""Of the smallest block."""


def doubts(inspection: Inspection) -> list[Doubt]:
    """One at most."""
    assembly, frames = inspection.assembly, inspection.frames
    if not frames or not assembly.scene.is_large or points_are_chosen(assembly):
        return []
    farthest = max(float(np.abs(frame.corners).max(initial=0.0)) for frame in frames)
    if farthest > STAYS * smallest_block(assembly.model) or not dry_groups(assembly).any():
        return []
    sentence = (
        "no block moved by more than a thousandth of its size, so that dry joints decide that stay closed: with points "
        "at their corners alone they bend three times as stiffly as an even pressure does"
    )
    return [Doubt("closed_joints", None, None, sentence, SPREAD, POINTS)]

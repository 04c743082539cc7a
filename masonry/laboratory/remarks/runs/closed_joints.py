"""Do dry joints that stay closed decide the answer? With contact points at their corners alone they bend three times as
stiffly as an even pressure does; large displacement takes such points where the scene chooses none.

They decide where no block moved by more than a thousandth of the smallest one: then joints hardly open.
"""

import numpy as np

from masonry.judgement.doubt import Doubt
from masonry.laboratory.remarks.edge_reach import is_dry, points_are_chosen
from masonry.laboratory.remarks.inspection import Inspection
from masonry.monitors.stability import smallest_block

STAYS = 1e-3
"""Of the smallest block."""


def doubts(inspection: Inspection) -> list[Doubt]:
    """One at most."""
    model, frames = inspection.assembly.model, inspection.frames
    if not inspection.assembly.scene.is_large or points_are_chosen(inspection.assembly):
        return []
    farthest = max(float(np.abs(frame.corners).max(initial=0.0)) for frame in frames) if frames else 0.0
    dry = any(is_dry(inspection.assembly, g) for g in range(len(model.group_names)))
    if farthest > STAYS * smallest_block(model) or not dry:
        return []
    sentence = (
        "no block moved by more than a thousandth of its size, so that dry joints decide that stay closed: with points "
        "at their corners alone they bend three times as stiffly as an even pressure does"
    )
    advice = 'take specimen.patch_points = "spread", or say "corners" where that does not matter'
    return [Doubt("closed_joints", None, None, sentence, advice)]

"""Do joints that stay closed decide the answer, and bend or twist too stiffly by their contact points? With points at
the corners alone they do so three times as stiffly as by an even stress, by Gauss points once.

The limit is the accuracy that was asked for (`masonry/estimates/closed_joints.py`). Where a run is made for a strength,
and joints gave way, few_points asks what these bear, and corner_friction what rubs.
"""

from masonry.estimates.closed_joints import may_turn_otherwise, movement_error, strength_decides
from masonry.estimates.elastic_joints import bend_or_twist
from masonry.estimates.inspection import Inspection
from masonry.judgement.doubt import POINTS, Doubt
from masonry.laboratory.remarks.bending_points import advice_for
from masonry.laboratory.remarks.runs.closed_joints import dry_patches


def doubts(inspection: Inspection) -> list[Doubt]:
    """One at most."""
    if not inspection.frames or dry_patches.doubts(inspection) or not may_turn_otherwise(inspection):
        return []
    if strength_decides(inspection):
        return []
    error, limit = movement_error(inspection), inspection.accuracy
    if abs(error) <= limit:
        return []
    sentence = (
        f"joints that stay closed {bend_or_twist(error)}: movements may be about {100.0 * abs(error):.2g} % too "
        f"{'small' if error > 0.0 else 'large'}, and what is shared out by stiffness is off as well"
    )
    return [Doubt("closed_joints", error, limit, sentence, advice_for(inspection.assembly), POINTS)]

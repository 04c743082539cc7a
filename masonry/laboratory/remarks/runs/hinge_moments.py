"""Do joints with one row of contact points make the strength too low? They bear no moment about it, as a hinge
(`masonry/estimates/hinged_joints.py`).

The limit of the share of moments that they lack is the accuracy that the scene asks for. A run that was stopped often
shows no more than that they may turn.
"""

from masonry.estimates.hinged_joints import hinges_of, lacking_moments
from masonry.estimates.inspection import Inspection
from masonry.judgement.doubt import POINTS, Doubt
from masonry.laboratory.remarks.hinges import free_hinges, more_points

MOST_OF_IT = 0.95
"""Share of the work from which on it is not told how much the strength is off."""


def doubts(inspection: Inspection) -> list[Doubt]:
    """One of what was not borne at the peak or right behind it; of a run that was stopped, of each group that may
    turn."""
    assembly, faces = inspection.assembly, inspection.faces
    if not inspection.frames or not len((hinges := hinges_of(assembly, faces)).face):
        return []
    share, limit = lacking_moments(inspection, hinges), inspection.accuracy
    if share <= limit:
        return free_hinges(assembly, faces, hinges) if inspection.outcome.stopped else []
    much = "far too low" if share > MOST_OF_IT else f"too low by up to {100.0 * share:.2g} %"
    sentence = (
        "joints with one row of contact points turned about it and bear no moment there, as a hinge: the "
        f"{inspection.strength} may be {much}"
    )
    return [Doubt("hinges", share, limit, sentence, more_points(assembly), POINTS)]

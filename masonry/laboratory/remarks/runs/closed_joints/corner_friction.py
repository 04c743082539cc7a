"""Does friction in joints with points at their corners alone decide a strength in space? Closed joints decide there how
blocks press on each other, and with that what friction bears.

What that makes of a strength is told by a rule: by two points along each edge a facade was 1.2 % weaker than by four
and 1.9 % weaker than by six, a house 0.9 % weaker and 0.4 % stronger, others 0.7 % weaker and 1.9 % stronger. Two
estimates did not measure it: by virtual work of friction with the pressures of elastic joints under the load that is
borne, the facade is 1.1 % too strong, and it is too weak; following the load without dilation with more points takes
ten times as long as a run with them does.
"""

from masonry.estimates.closed_joints import corner_friction, may_turn_otherwise, strength_decides
from masonry.estimates.inspection import Inspection
from masonry.judgement.doubt import POINTS, Doubt
from masonry.laboratory.remarks.bending_points import advice_for

CORNERS, RUBS, TWISTS = 0.02, 0.1, 1e-3
"""By what share a load may be off where joints have points at their corners alone; shares of the work of joints at the
peak, of friction and of twists, from which on that counts."""


def doubts(inspection: Inspection) -> list[Doubt]:
    """One at most."""
    if not inspection.frames or inspection.assembly.scene.is_large or inspection.accuracy >= CORNERS:
        return []
    if not may_turn_otherwise(inspection) or not strength_decides(inspection):
        return []
    rubs, twists = corner_friction(inspection)
    if rubs < RUBS or twists < TWISTS:
        return []
    sentence = (
        "joints slide and twist on contact points at their corners alone, and which of these press follows from joints "
        f"that turn three times too stiffly: the {inspection.strength} may be about {100.0 * CORNERS:g} % off"
    )
    return [Doubt("closed_joints", CORNERS, inspection.accuracy, sentence, advice_for(inspection.assembly), POINTS)]

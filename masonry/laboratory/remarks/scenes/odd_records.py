"""Does a record shake as no earthquake does? Then its unit is another one: what is in cm/s2 and read as g is a thousand
times too strong, the other way round a thousand times too weak. The strongest motions on record have 4 g, and 0.002 g
is hardly felt.

Asked of files, but for those that are scaled to a peak.
"""

from masonry.assembly.assemble import Assembly
from masonry.judgement.doubt import Doubt
from masonry.quantity import GRAVITY

WEAKEST, STRONGEST = 0.001, 5.0
"""g"""


def doubts(assembly: Assembly) -> list[Doubt]:
    """One for each file."""
    raised = []
    for ground in (*assembly.scene.ground, *assembly.scene.waves):
        if ground.record is None or ground.peak is not None:
            continue
        largest = max(motion.peak_acceleration for motion in ground.motions.values())
        peak = largest / abs(ground.scale or 1.0) / GRAVITY
        if not WEAKEST <= peak <= STRONGEST:
            sentence = f"the record of {ground.PLACE} has a peak of {peak:.3g} g, which is none of an earthquake"
            limit = STRONGEST if peak > STRONGEST else WEAKEST
            raised.append(Doubt("odd_record", peak, limit, sentence, "look at its unit, or give the peak"))
    return raised

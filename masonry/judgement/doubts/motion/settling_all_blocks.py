"""Did the dead loads come to rest before the test began? What is left of the motion: unbalanced force over the dead
loads, and kinetic over stored energy.

A specimen whose forces balance to a thousandth is within a thousandth of its answer. Below 1e-6 of the stored energy a
swing is less than a thousandth of the displacements; a specimen that slides or falls under a load only a thousandth too
large is above it.
"""

from masonry.judgement.doubt import Criterion
from masonry.judgement.evidence import Evidence
from masonry.rows.rest_criterion import DOUBTED

ADVICE = "raise settle.steps, or leave [settle] out; if that does not help, {} cannot stand under them"


def is_asked(evidence: Evidence) -> bool:
    """Whether rest is required: not in real time, unless the ground shakes the specimen, as it is to stand before; nor
    without loads, as nothing settles then."""
    falls = evidence.in_real_time and not evidence.table("shaking")
    return not falls and evidence.summary.get("work_of_loads_j") != {}


UNBALANCED_AFTER_SETTLING = Criterion(
    name="unbalanced_after_settling",
    measure=lambda evidence: evidence.number("unbalanced_after_settling"),
    limit=DOUBTED.force,
    sentence="the dead loads had not come to rest: {value:.2g} of them is unbalanced",
    advice=ADVICE.format("the specimen"),
    asked_of=is_asked,
)
KINETIC_AFTER_SETTLING = Criterion(
    name="kinetic_after_settling",
    measure=lambda evidence: evidence.number("kinetic_after_settling"),
    limit=DOUBTED.energy,
    sentence="the dead loads had not come to rest: the kinetic energy is {value:.2g} of the stored energy",
    advice=ADVICE.format("the specimen"),
    asked_of=is_asked,
)


def rests(evidence: Evidence) -> bool:
    """Whether all blocks together had come to rest: then single ones are asked."""
    doubts = (one.doubt(evidence) for one in (UNBALANCED_AFTER_SETTLING, KINETIC_AFTER_SETTLING))
    return not any(doubts)

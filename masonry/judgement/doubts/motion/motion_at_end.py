"""Is all at rest at the end of a run without a drive? Kinetic over stored energy, of all blocks and of the one that
moves most; asked where the dead loads had settled and nothing fell.

The limits are those of the settling, for the same reasons.
"""

from masonry.judgement.doubt import Criterion
from masonry.judgement.doubts.motion.settling_all_blocks import rests
from masonry.judgement.doubts.motion.settling_block import KINETIC_BLOCK, UNBALANCED_BLOCK
from masonry.judgement.evidence import Evidence
from masonry.judgement.words import block_at
from masonry.rows.columns import STORED_BY_ELEMENTS
from masonry.rows.rest_criterion import DOUBTED, still_moving

TERMS = ("kinetic", "elastic_blocks", "elastic_contacts", *STORED_BY_ELEMENTS, "external_work")


def is_asked(evidence: Evidence) -> bool:
    """Whether rest is required: not if driven, in real time or fallen; what had not settled was named already."""
    if evidence.in_real_time or evidence.has_drive or evidence.falls or not rests(evidence):
        return False
    return not (UNBALANCED_BLOCK.doubt(evidence) or KINETIC_BLOCK.doubt(evidence))


def kinetic(evidence: Evidence) -> float | None:
    """Kinetic over stored energy; None where the first was not measured."""
    energies = {key: evidence.number(f"energy_j.{key}") for key in TERMS}
    if energies["kinetic"] is None:
        return None
    return still_moving({key: value or 0.0 for key, value in energies.items()})


MOTION_AT_END = Criterion(
    name="motion_at_end",
    measure=kinetic,
    limit=DOUBTED.energy,
    sentence="the specimen still moves at the end: its kinetic energy is {value:.2g} of the stored energy",
    asked_of=is_asked,
)
BLOCK_AT_END = Criterion(
    name="block_at_end",
    measure=lambda evidence: evidence.number("moving_at_end.kinetic"),
    limit=DOUBTED.of_block.energy,
    sentence=lambda evidence, value: (
        f"{block_at(evidence.table('moving_at_end'))} still moves at the end: its kinetic energy is {value:.2g} of "
        "what it stores"
    ),
    asked_of=lambda evidence: is_asked(evidence) and not MOTION_AT_END.doubt(evidence),
)

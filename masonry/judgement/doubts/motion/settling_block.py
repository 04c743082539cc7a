"""Did each block come to rest under the dead loads? The same as of all together, on the block's own scales: a small
block beside a large one does not show in sums.

Where all swing together some blocks swing more than the mean: the force on one may exceed the share that is asked of
the sum ten times, and its energy the square of that.
"""

from masonry.judgement.doubt import Criterion
from masonry.judgement.doubts.motion.settling_all_blocks import ADVICE, is_asked, rests
from masonry.judgement.evidence import Evidence
from masonry.judgement.words import block_at
from masonry.rows.rest_criterion import DOUBTED


def is_block_asked(evidence: Evidence) -> bool:
    """Only where all together rest."""
    return is_asked(evidence) and rests(evidence)


def beginning(evidence: Evidence) -> str:
    """Which block, and what of it."""
    return f"{block_at(evidence.table('unrest_after_settling'))} had not come to rest under the dead loads"


UNBALANCED_BLOCK = Criterion(
    name="unbalanced_block",
    measure=lambda evidence: evidence.number("unrest_after_settling.unbalanced"),
    limit=DOUBTED.of_block.force,
    sentence=lambda evidence, value: f"{beginning(evidence)}: {value:.2g} of what it bears is unbalanced",
    advice=ADVICE.format("it"),
    asked_of=is_block_asked,
)
KINETIC_BLOCK = Criterion(
    name="kinetic_block",
    measure=lambda evidence: evidence.number("unrest_after_settling.kinetic"),
    limit=DOUBTED.of_block.energy,
    sentence=lambda evidence, value: f"{beginning(evidence)}: its kinetic energy is {value:.2g} of what it stores",
    advice=ADVICE.format("it"),
    asked_of=is_block_asked,
)

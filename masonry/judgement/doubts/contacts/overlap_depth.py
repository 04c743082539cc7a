"""Do contacts close by much of a block? The deepest overlap over the size of its block.

Blocks that overlap by 1 % stand visibly elsewhere than they should; areas and lever arms are off by as much. What a
joint has crushed is its own loss, and no overlap of blocks.
"""

from masonry.judgement.doubt import Criterion

OVERLAP = Criterion(
    name="overlap",
    measure=lambda evidence: evidence.number("overlap_max"),
    limit=0.01,
    sentence="contacts close by up to {value:.2g} of a block's size",
    advice="raise the normal stiffness: it is too low for this load",
)

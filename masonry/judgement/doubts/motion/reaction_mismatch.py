"""Do the forces at drive and support agree? Their largest difference over the peak: inertia makes it.

The stress is read at the drive: it is uncertain by what the other end reads otherwise, and a test is read to 1 or 2 %.
"""

from masonry.judgement.doubt import Criterion
from masonry.judgement.doubts.motion.quasi_static import acts_slowly, slower

REACTION_MISMATCH = Criterion(
    name="reaction_mismatch",
    measure=lambda evidence: evidence.number("reaction_mismatch_max"),
    limit=0.02,
    sentence="not quasi-static: the forces at drive and support differ by {value:.2g} of the peak (should be under "
    "{limit:g})",
    advice=slower,
    asked_of=acts_slowly("reaction_mismatch_max"),
    unknown="no force at drive or support was measured: the drive met nothing, or the run ended before it did",
)

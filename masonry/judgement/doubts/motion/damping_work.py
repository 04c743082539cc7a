"""Does damping take much of the work, or add to it? Work of damping, without what sudden cracks released, over the work
since the settling.

What damping takes, the force of the drive has to bring up: 2 % of the work is 2 % of the force. It adds energy where it
pulls along what lags behind the drive; kinetic energy counts with it, which a slow run has little of, so that 1 % is
more than a slow run has.
"""

from masonry.judgement.doubt import Criterion
from masonry.judgement.doubts.motion.quasi_static import acts_slowly, slower
from masonry.judgement.evidence import Evidence

TAKES, ADDS = 0.02, 0.01


def gain(evidence: Evidence) -> float | None:
    """Energy that damping added, over the work."""
    loss = evidence.number("damping_over_external")
    return None if loss is None else -loss


DAMPING = Criterion(
    name="damping",
    measure=lambda evidence: evidence.number("damping_over_external"),
    limit=TAKES,
    sentence="not quasi-static: damping takes {value:.2g} of the work (should be under {limit:g})",
    advice=slower,
    asked_of=acts_slowly("damping_over_external"),
)
DAMPING_GAIN = Criterion(
    name="damping_gain",
    measure=gain,
    limit=ADDS,
    sentence="damping added {percent} of the work and removed none",
    advice="ask for a smaller accuracy",
    asked_of=lambda evidence: not evidence.in_real_time and (evidence.has_drive or gain(evidence) is not None),
)

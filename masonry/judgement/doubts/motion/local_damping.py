"""Did local damping slow a motion in real time? What it took, over the external work.

It has no physical meaning there; 1 % is the accuracy that is usually asked of a run. Where it acts while dead loads
settle alone, or a scene asks for it by [damping], nothing is asked.
"""

import math

from masonry.judgement.doubt import Criterion
from masonry.judgement.evidence import Evidence


def share(evidence: Evidence) -> float | None:
    """Work of damping over the external work, without signs."""
    work, loss = (evidence.magnitude(f"energy_j.{key}") for key in ("external_work", "damping"))
    if loss is None:
        return None
    if not work:
        return math.inf if loss else 0.0
    return loss / work


LOCAL_DAMPING = Criterion(
    name="local_damping",
    measure=share,
    limit=0.01,
    sentence="local damping took {percent} of the work: what moves in real time is slower than it should be",
    advice="set solver.damping = 0",
    asked_of=lambda evidence: evidence.in_real_time and not evidence.summary.get("damping_after_settling"),
)

"""Does re-detection conserve energy? In large displacement contacts that press are detected anew, at other points and
with other areas: what that gained or took, over the external work.

Where the weight takes the work of the drive back from what is pushed over, the work of the drive alone counts. 1 % is
the accuracy that is usually asked of a run.
"""

import math

from masonry.judgement.doubt import Criterion
from masonry.judgement.evidence import Evidence

TERMS = ("area", "redetection")


def share(evidence: Evidence) -> float | None:
    """Energy changed by areas and re-detection, over the work; None where neither was measured."""
    changes = [evidence.magnitude(f"energy_j.{key}") for key in TERMS]
    work = max(evidence.magnitude("energy_j.external_work") or 0.0, evidence.number("work_of_force_j") or 0.0)
    if changes == [None, None]:
        return None
    change = sum(value or 0.0 for value in changes)
    return change / work if work > 0.0 and math.isfinite(change) else 0.0


REDETECTION = Criterion(
    name="redetection",
    measure=share,
    limit=0.01,
    sentence="re-detection of contacts that press changed the energy by {percent} of the work: what fell hit harder or "
    "softer than it should",
    advice="raise the normal stiffness",
    asked_of=lambda evidence: any(key in evidence.table("energy_j") for key in TERMS),
)

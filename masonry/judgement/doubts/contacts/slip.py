"""Do contacts slide far over their joints? They keep the areas that they had at first, which are off by that share.

Patches are not asked, as their areas follow. The limit is a fifth of `solver.slip_limit`, at which a run is ended: 5 %
of the joint, where that is 25 %.
"""

import math

from masonry.judgement.doubt import Criterion
from masonry.judgement.evidence import Evidence

SHARE = 0.2
"""Of `solver.slip_limit`."""


def sentence(evidence: Evidence, value: float) -> str:
    """Bonds in large displacement hold their blocks together, so that these are not looked at elsewhere."""
    bonds = (
        "; blocks held by such bonds do not meet elsewhere" if evidence.summary.get("in_real_time") is not None else ""
    )
    return f"contacts slid by up to {value:.2g} of their joints, but keep the areas that they had at first{bonds}"


SLIP = Criterion(
    name="slip",
    measure=lambda evidence: evidence.number("slip_max"),
    limit=lambda evidence: SHARE * (evidence.number("slip_limit") or math.inf),
    sentence=sentence,
    asked_of=lambda evidence: evidence.summary.get("slip_max") is not None,
)

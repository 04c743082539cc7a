"""Does damping take much of the work of a load that goes to and fro, before any fall?

The pace of such a load aims at less than the accuracy; what takes 2.5 times as much, and 2 % at least, cracked or slid
suddenly, and where that came to rest depends on its damping.
"""

from masonry.judgement.doubt import Criterion

LEAST, TIMES = 0.02, 2.5
"""Share of the work; and times the accuracy."""

DAMPING_BEFORE_FALL = Criterion(
    name="damping_before_fall",
    measure=lambda evidence: evidence.number("damping_over_external"),
    limit=lambda evidence: max(LEAST, TIMES * (evidence.number("collapse_load.accuracy") or 0.0)),
    sentence="damping took {percent} of the work of the load before any fall: something cracked or slid suddenly, and "
    "where it came to rest depends on its damping",
    advice="`masonry sensitivity` shows by how much",
    asked_of=lambda evidence: bool(evidence.table("collapse_load").get("loops")),
)

"""Did the force pass its peak? By how much it rose over the last tenth of the way of the drive, over the highest force,
where that stands at the end.

Such a highest force is no strength: it grows by about that share with each further tenth of the way. 1 % is the
accuracy that is usually asked of a run. A specimen that is elastic throughout has no strength and is not asked, and a
drive that turns back has no last tenth.
"""

from masonry.judgement.doubt import Criterion
from masonry.judgement.evidence import Evidence, Table

ELASTIC = {"elastic"}
LIMIT = 0.01


def has_strength(evidence: Evidence) -> bool:
    """Whether something in the specimen can break or slide."""
    return set(evidence.table("law_by_group").values()) != ELASTIC


def still_rises(summary: Table) -> bool:
    """Whether the highest force is that of the end, whatever the specimen is made of."""
    return (Evidence(summary).number("rise_at_end") or 0.0) > LIMIT


def advice(evidence: Evidence) -> str:
    """Advice; empty for a run that was to go on."""
    ended_early = evidence.summary.get("stopped") or evidence.summary.get("interrupted")
    return "" if ended_early else "raise drive.displacement"


STILL_RISING = Criterion(
    name="still_rising",
    measure=lambda evidence: evidence.number("rise_at_end"),
    limit=LIMIT,
    sentence="the force still rose at the end, by {percent} over the last tenth of the drive: the highest force is no "
    "strength",
    advice=advice,
    asked_of=lambda evidence: evidence.number("rise_at_end") is not None and has_strength(evidence),
)

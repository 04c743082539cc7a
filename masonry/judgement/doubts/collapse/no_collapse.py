"""Is there a collapse load at all? Nothing may fall up to the end of the load, or the least part of it may be too much.

A run that was interrupted before anything fell is not asked.
"""

from masonry.judgement.doubt import Criterion
from masonry.judgement.evidence import Evidence


def is_asked(evidence: Evidence) -> bool:
    """Whether a load grew, and was not interrupted before anything fell."""
    return evidence.grows and not (evidence.summary.get("interrupted") and not evidence.falls)


def nothing_fell(evidence: Evidence) -> bool:
    """Whether a load that only grew came to its end."""
    return not evidence.falls and evidence.table("collapse_load").get("loops") is None


def nothing_borne(evidence: Evidence) -> bool:
    """Whether the first load that was tried made something fall; on the way back from one side that may be so."""
    grown = evidence.table("collapse_load")
    loops = grown.get("loops")
    return grown.get("borne") == 0.0 and evidence.falls and (loops is None or loops["leg"] == 1)


def has_factor(evidence: Evidence) -> bool:
    """Whether there is a factor to be doubted."""
    return is_asked(evidence) and not nothing_fell(evidence) and not nothing_borne(evidence)


NOTHING_FELL = Criterion(
    name="nothing_fell",
    measure=nothing_fell,
    sentence="nothing fell up to the factor at which the load ends, so this is no collapse load",
    advice="raise limit.up_to",
    asked_of=is_asked,
)
NOTHING_BORNE = Criterion(
    name="nothing_borne",
    measure=nothing_borne,
    sentence="not the least part of the load was borne: nothing resists it, or the specimen hardly stands without it",
    asked_of=is_asked,
)

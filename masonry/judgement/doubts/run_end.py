"""Did the run come to its end? One that was interrupted, or that the program stopped, is only its first part."""

from masonry.judgement.doubt import STOPPED, Criterion
from masonry.judgement.evidence import Evidence


def why_it_stopped(evidence: Evidence, _: float) -> str:
    """With the reason, which says what to change where something helps."""
    return f"the run was stopped, so this is only its first part: {evidence.summary['stopped']}".removesuffix(".")


INTERRUPTED = Criterion(
    name="interrupted",
    measure=lambda evidence: bool(evidence.summary.get("interrupted")),
    sentence="the run was interrupted, so this is only its first part",
    advice="`masonry resume` continues it from its last checkpoint",
    verdict=STOPPED,
)
STOPPED_EARLY = Criterion(
    name="stopped",
    measure=lambda evidence: bool(evidence.summary.get("stopped")),
    sentence=why_it_stopped,
    verdict=STOPPED,
)

"""Did the run come to its end? One that was interrupted, or that the program stopped, is only its first part."""

from masonry.judgement.doubt import STOPPED, Criterion

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
    sentence="the run was stopped, so this is only its first part",
    advice="the key `stopped` of summary.json says why",
    verdict=STOPPED,
)

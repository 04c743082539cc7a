"""Did blocks move far before the fall? In small displacement the balance is that of the shape as drawn.

The limit is half of the accuracy that was asked for, over the size of the smallest block: a soft arch loses twice as
much of its factor as it sways.
"""

from masonry.judgement.doubt import Criterion
from masonry.judgement.doubts.collapse.no_collapse import has_factor
from masonry.judgement.evidence import Evidence

SHARE = 0.5
"""Of the accuracy."""


def sentence(evidence: Evidence, value: float) -> str:
    """Sentence on the motion before a fall, as the factor of what fell may be too large."""
    before = f"blocks moved by up to {value:.2g} of the smallest one"
    if evidence.falls:
        return f"{before} before it fell, but the balance is that of the shape as drawn, so the factor may be too large"
    return f"{before}, but the balance is that of the shape as drawn"


SWAY = Criterion(
    name="sway",
    measure=lambda evidence: evidence.number("collapse_load.swayed_over_block"),
    limit=lambda evidence: SHARE * (evidence.number("collapse_load.accuracy") or 0.0),
    sentence=sentence,
    advice='take displacements = "large"',
    asked_of=has_factor,
)

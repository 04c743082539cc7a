"""Would what fell bear again, had it been followed farther? The fall draws tight a bar that hangs slack: when, follows
from how far it had come. Not asked beyond the travel that a scene gives (limit.travel).
"""

from masonry.judgement.doubt import Criterion
from masonry.judgement.evidence import Evidence


def travel(evidence: Evidence) -> float:
    """m, of a fall."""
    return evidence.number("collapse_load.travel_m") or 0.0


def later(evidence: Evidence) -> float:
    """m, after which it would bear; 0 where nothing would."""
    return evidence.number("collapse_load.later_m") or 0.0


def advice(evidence: Evidence) -> str:
    """A longer travel, or displacements that may be as large."""
    if later(evidence) <= travel(evidence):
        return 'take displacements = "large"'
    return f'where it may move as far, set limit.travel = "{1.5e3 * later(evidence):.3g} mm"'


LATER_REST = Criterion(
    name="later_rest",
    measure=later,
    sentence=lambda evidence, value: (
        f"a bar that hangs slack bears what fell after about {1e3 * value:.4g} mm, farther than that was followed: the "
        "load that is borne then is not known"
    ),
    advice=advice,
    asked_of=lambda evidence: evidence.falls,
)

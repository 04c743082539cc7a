"""Would what fell bear again, had it been followed farther? The fall draws tight a bar that hangs slack: when, follows
from how far it had come. Asked where the scene leaves the travel of a fall to the program (limit.travel).
"""

from masonry.judgement.doubt import Criterion
from masonry.judgement.evidence import Evidence


def travel(evidence: Evidence) -> float:
    """m, of a fall."""
    return evidence.number("collapse_load.travel_m") or 0.0


def later(evidence: Evidence) -> float:
    """m, after which it would bear; 0 where nothing would."""
    return evidence.number("collapse_load.later_m") or 0.0


LATER_REST = Criterion(
    name="later_rest",
    measure=later,
    sentence=lambda evidence, value: (
        f"what fell was followed for {1e3 * travel(evidence):.4g} mm, and a bar that hangs slack bears after about "
        f"{1e3 * value:.4g} mm: the load that is borne then is not known"
    ),
    advice=lambda evidence: f'where it may move as far, set limit.travel = "{1.5e3 * later(evidence):.3g} mm"',
    asked_of=lambda evidence: evidence.falls,
)

"""Did blocks leave the floor? What leaves it falls on for ever, and its energy is counted."""

from masonry.judgement.doubt import Doubt
from masonry.laboratory.remarks.inspection import Inspection


def doubts(inspection: Inspection) -> list[Doubt]:
    """One at most."""
    return [Doubt("left_floor", None, None, line) for line in inspection.outcome.found.get("left_floor", [])]

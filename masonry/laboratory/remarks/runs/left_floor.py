"""Did blocks leave the floor? What leaves it falls on for ever, and its energy is counted."""

from masonry.estimates.inspection import Inspection
from masonry.judgement.doubt import Doubt
from masonry.monitors.collapse import LeftFloor


def doubts(inspection: Inspection) -> list[Doubt]:
    """One at most."""
    left = inspection.outcome.records.get(LeftFloor)
    if left is None:
        return []
    others = f", and {left.blocks - 1} more later" if left.blocks > 1 else ""
    sentence = (
        f"block {left.block} had left the floor after {left.time:.3g} s{others}: what leaves it falls on for ever, and "
        "its energy is counted"
    )
    return [Doubt("left_floor", None, None, sentence, "make the floor larger")]

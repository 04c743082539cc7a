"""Are the contact points of joints that bend, or slide and twist, too few? Few points bear another moment than many
(`masonry/estimates/strength/strength_error.py`).

The limit is the accuracy that the scene asks for, but no less than the 1.5 % of this estimate.
"""

from masonry.estimates.inspection import Inspection
from masonry.estimates.strength.strength_error import bears_on_nodes, enough_points, strength_error
from masonry.judgement.doubt import POINTS, Doubt
from masonry.laboratory.remarks.bending_points import ON_NODES

TWICE = 1.5
"""Times a strength from which on its error is told as a factor."""


def doubts(inspection: Inspection) -> list[Doubt]:
    """One where the strength is off by more than the accuracy that was asked for."""
    error, limit = strength_error(inspection), inspection.accuracy
    if error is None or abs(error.ratio - 1.0) <= limit:
        return []
    moves, load = ("slide and twist", "load") if error.joint.in_plane else ("bend", "moment")
    sentence = (
        f"the contact points of joints that {moves} are too few: a joint bears {error.borne:.3g} times the {load} that "
        f"it would bear with many, and the {inspection.strength} may be {size_of(error.ratio)}"
    )
    meshed = bears_on_nodes(inspection, error)
    advice = ON_NODES if meshed else f"take {enough_points(inspection, error.bearing, limit)}"
    return [Doubt("few_points", error.ratio - 1.0, limit, sentence, advice, POINTS)]


def size_of(ratio: float) -> str:
    """In words, of a strength over what it should be."""
    if max(ratio, 1.0 / ratio) >= TWICE:
        return f"about {ratio:.2g} times what it should be"
    return f"about {100.0 * abs(ratio - 1.0):.2g} % too {'high' if ratio > 1.0 else 'low'}"

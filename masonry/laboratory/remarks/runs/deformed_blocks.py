"""Did blocks deform beyond what their elastic law and the proof of the time step allow?

Below about 0.8 of its volume a block of St Venant-Kirchhoff softens under pressure, and may turn inside out.
"""

from masonry.estimates.inspection import Inspection
from masonry.judgement.doubt import Doubt
from masonry.monitors.collapse import Strains

SQUEEZED = 0.8
"""Least share of its volume."""


def doubts(inspection: Inspection) -> list[Doubt]:
    """Of the most in any row."""
    strains = inspection.outcome.records.get(Strains)
    return [] if strains is None else of_strains(strains)


def of_strains(strains: Strains) -> list[Doubt]:
    """One for what is squeezed too far, and one for what is stretched too far."""
    least, longest, proven = strains
    raised = []
    if least < SQUEEZED:
        sentence = (
            f"blocks are squeezed to {least:.2g} of their volume: below {SQUEEZED:g} their elastic law (St "
            "Venant-Kirchhoff) is not to be trusted"
        )
        raised.append(Doubt("squeezed_blocks", least, SQUEEZED, sentence, "raise their modulus, or take rigid blocks"))
    if longest > proven:
        sentence = (
            f"blocks are stretched by {longest:.3g}, more than the {proven:g} that the stable time step is proven for"
        )
        raised.append(Doubt("stretched_blocks", longest, proven, sentence, "lower solver.step_fraction"))
    return raised

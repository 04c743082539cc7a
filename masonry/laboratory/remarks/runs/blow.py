"""Is the peak a blow? It lies far above all rows of the curve then, has just risen, and is no strength. And was a blow
left out of it, where none fell?

Rows of a slow test lie much closer to its peak than the 20 % that are let through; where a force grows with the way,
any rows may pass by its peak.
"""

from masonry.estimates.inspection import Inspection
from masonry.judgement.doubt import Doubt
from masonry.monitors.collapse import Fallen

LIMIT, THROUGH = 1.2, 1e-2
"""Peak over the highest row; share of the way for which it had been there, as it is said in docs/results.md, half of
the peak before it."""


def doubts(inspection: Inspection) -> list[Doubt]:
    """One at most."""
    assembly, outcome = inspection.assembly, inspection.outcome
    rows, section = outcome.standing_rows, assembly.specimen.section
    after = rows["step"] >= assembly.plan.settle
    highest = float(rows["stress"][after].max(initial=0.0))
    how_hard = "how hard blocks strike depends on the stiffness of their contacts"
    if outcome.blow > outcome.peak_force > 0.0 and outcome.records.get(Fallen) is None:
        struck = f"a blow of {1e-6 * outcome.blow / section:.4g} MPa is not counted for the peak: {how_hard}"
        above = outcome.blow / outcome.peak_force
        return [Doubt("blow", above, 1.0, struck, "look at the curve and the movie for what struck the drive")]
    shown = outcome.peak_force <= LIMIT * highest * section or not outcome.displacement_at_peak
    if shown or outcome.borne_through >= THROUGH:
        return []
    ratio = outcome.peak_force / (highest * section) if highest > 0.0 else None
    sentence = f"the peak is a blow between two rows, and the highest row shows {1e-6 * highest:.4g} MPa: {how_hard}"
    return [Doubt("blow", ratio, LIMIT, sentence, "read the strength from the rows of the curve")]

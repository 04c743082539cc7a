"""Is the peak a blow? It lies far above all rows of the curve then, and is no strength.

Rows of a slow test lie much closer to its peak than the 20 % that are let through.
"""

from masonry.judgement.doubt import Doubt
from masonry.laboratory.remarks.inspection import Inspection

LIMIT = 1.2
"""Peak over the highest row."""


def doubts(inspection: Inspection) -> list[Doubt]:
    """One at most."""
    assembly, outcome = inspection.assembly, inspection.outcome
    rows, section = outcome.standing_rows, assembly.specimen.section
    after = rows["step"] >= assembly.plan.settle
    highest = float(rows["stress"][after].max(initial=0.0))
    if outcome.peak_force <= LIMIT * highest * section or not outcome.displacement_at_peak:
        return []
    ratio = outcome.peak_force / (highest * section) if highest > 0.0 else None
    sentence = (
        f"the peak is a blow between two rows, and the highest row shows {1e-6 * highest:.4g} MPa: how hard blocks "
        "strike depends on the stiffness of their contacts"
    )
    return [Doubt("blow", ratio, LIMIT, sentence, "read the strength from the rows of the curve")]

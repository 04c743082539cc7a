"""Are all energies numbers? Beyond what floating point holds they are infinite, or no number; null in a file."""

import math

from masonry.judgement.doubt import Criterion
from masonry.judgement.evidence import Evidence


def lost(evidence: Evidence) -> list[str]:
    """The energies that are no numbers, in words."""
    energies = evidence.table("energy_j").items()
    return [name.replace("_", " ") for name, value in energies if value is None or not math.isfinite(value)]


ENERGY_NUMBERS = Criterion(
    name="energy_numbers",
    measure=lambda evidence: len(lost(evidence)) if evidence.table("energy_j") else None,
    sentence=lambda evidence, count: f"there is no number of this energy: {', '.join(lost(evidence))}",
    advice="look for a stiffness near 0",
)

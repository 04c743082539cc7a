"""Does the load rise again behind the collapse? Then a slack bar, a stop or another block bears there, and the collapse
factor is that of the first motion alone.

The limit is twice the accuracy: the factor that is led exceeds equilibrium by half of it.
"""

from masonry.judgement.doubt import Criterion
from masonry.judgement.evidence import Evidence

TIMES = 2.0
"""Times the accuracy."""


def rise(evidence: Evidence) -> float | None:
    """Over the least factor that was not borne: by how much the largest one behind it is more."""
    most, falls = evidence.number("collapse_load.branch.factor_max"), evidence.number("collapse_load.falls")
    return None if most is None or not falls else most / falls - 1.0


BRANCH_RISES = Criterion(
    name="branch_rises",
    measure=rise,
    limit=lambda evidence: TIMES * (evidence.number("collapse_load.accuracy") or 0.0),
    sentence="behind the collapse the load rises again, by {percent} of the collapse factor: that is the load of the "
    "first motion, and not all that is borne",
    advice="leave limit.control and limit.until out: the run then finds what is borne after that motion",
    asked_of=lambda evidence: bool(evidence.branch) and bool(evidence.branch.get("led")),
)

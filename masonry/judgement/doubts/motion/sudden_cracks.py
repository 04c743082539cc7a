"""Did sudden cracks release much energy? What they set free and did not consume, over all energy lost.

What the specimen does with it depends on how its vibration is damped, which no scene knows: from 1 % on that is more
than the accuracy that is usually asked of a run. What is dry loses next to nothing as it rocks: there a thousandth of
the work of the test counts, which changes its force by no more than that.
"""

from masonry.judgement.doubt import Criterion
from masonry.judgement.evidence import Evidence
from masonry.judgement.words import percent

OF_WORK = 10.0
"""Times the share of the work: a tenth of the work counts as lost at least."""


def share(evidence: Evidence) -> float | None:
    """Of the energy lost, or of a tenth of the work where that is more."""
    of_lost, of_work = (evidence.number(f"released_over_{name}") for name in ("dissipated", "work"))
    return of_lost if of_lost is None or of_work is None else min(of_lost, OF_WORK * of_work)


SUDDEN_CRACKS = Criterion(
    name="sudden_cracks",
    measure=share,
    limit=0.01,
    sentence=lambda evidence, value: (
        f"sudden cracks released {percent(evidence.number('released_over_dissipated') or value)} of all energy that "
        "was lost: what happened after them depends on the damping of the vibration"
    ),
    advice="`masonry sensitivity` shows by how much",
)

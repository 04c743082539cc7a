"""Did sudden cracks release much energy? What they set free and did not consume, over all energy lost.

What the specimen does with it depends on how its vibration is damped, which no scene knows: from 1 % on that is more
than the accuracy that is usually asked of a run.
"""

from masonry.judgement.doubt import Criterion

SUDDEN_CRACKS = Criterion(
    name="sudden_cracks",
    measure=lambda evidence: evidence.number("released_over_dissipated"),
    limit=0.01,
    sentence="sudden cracks released {percent} of all energy that was lost: what happened after them depends on the "
    "damping of the vibration",
    advice="`masonry sensitivity` shows by how much",
)

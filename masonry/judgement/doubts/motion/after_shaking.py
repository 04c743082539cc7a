"""Is what a shaken run tells the last word? It is not where a block turned far, or where the specimen still moves.

A block that rocks far out is near to overturning, and there the smallest difference decides: two records that differ by
a digit, or two stiffnesses, leave one block standing and throw the other over. At 0.1 rad a block as slender as ten to
one is over its corner, one of four to one is at 40 % of that. What still moves has not come to its last place.
"""

from masonry.judgement.doubt import Criterion

FAR, MOVING = 0.1, 1e-2


CHANCE = Criterion(
    name="one_history",
    measure=lambda evidence: evidence.number("rotation_max_rad"),
    limit=FAR,
    sentence=lambda evidence, value: (
        f"a block turned by {value:.2g} rad as the ground shook: near to overturning one history proves nothing"
    ),
    advice="run a sweep over seeds, records or scales, and count (docs/fragility.md)",
    asked_of=lambda evidence: bool(evidence.table("shaking")),
)
STILL_MOVES = Criterion(
    name="still_moves",
    measure=lambda evidence: evidence.number("shaking.kinetic_at_end"),
    limit=MOVING,
    sentence="the specimen still moved at the end, with {percent} of its largest kinetic energy: what gauges had left "
    "then does not stay",
    advice="raise solver.duration",
    asked_of=lambda evidence: bool(evidence.table("shaking")),
)

"""Do laws and contacts agree on the dissipated energy? What the laws booked against the work that the contacts took up.

The two sums differ by the error of the steps, which integrate the laws: 1 % of the dissipated energy is the accuracy
that is usually asked of a run.
"""

from masonry.judgement.doubt import Criterion
from masonry.judgement.words import percent

LIMIT = 0.01
DISSIPATION = Criterion(
    name="dissipation",
    measure=lambda evidence: evidence.number("dissipation_mismatch"),
    limit=LIMIT,
    sentence=lambda evidence, value: (
        f"laws and contacts disagree on the dissipated energy by {percent(value, 3)} (should be under {percent(LIMIT)})"
    ),
    advice="take smaller steps: lower solver.step_fraction",
)

"""Is the branch behind the collapse in equilibrium? What inertia takes of the collapse factor, at most.

The limit is the accuracy that was asked of the factor.
"""

from masonry.judgement.doubt import Criterion
from masonry.judgement.words import percent

BRANCH_BALANCE = Criterion(
    name="branch_balance",
    measure=lambda evidence: evidence.number("collapse_load.branch.out_of_balance_max"),
    limit=lambda evidence: evidence.number("collapse_load.accuracy"),
    sentence=lambda evidence, value: (
        f"behind the collapse motion took up to {percent(value)} of the collapse factor, more than the accuracy beyond "
        f"{1e3 * evidence.branch['near_to_m']:.4g} mm"
    ),
    advice="see the column out_of_balance",
    asked_of=lambda evidence: bool(evidence.branch),
)

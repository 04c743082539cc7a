"""Do forces and moments add up to nothing? What supports, drive, loads and inertia exert, over the largest of them.

As of the energy balance, only rounding may be left.
"""

from masonry.judgement.doubt import Criterion

FORCE_BALANCE = Criterion(
    name="force_balance",
    measure=lambda evidence: evidence.number("force_balance"),
    limit=1e-9,
    sentence="forces and moments add up to {value:.2g} of the largest, not to 0",
    advice="report it: the program is wrong",
)

"""Does the energy balance close? All works against all energies, over the external work.

Both sides are summed independently, step by step: 1e-15 is left in a sound run, by rounding, and up to 1e-11 after
millions of steps. A force whose work is missing shows as a share of the work: 1e-9 lies far from both.
"""

from masonry.judgement.doubt import Criterion

ENERGY_BALANCE = Criterion(
    name="energy_balance",
    measure=lambda evidence: evidence.magnitude("energy_imbalance"),
    limit=1e-9,
    sentence="the energy balance is open by {value:.2g} of the external work (should be under {limit:g})",
    advice="report it: the program is wrong",
    unknown="the energy balance is not known",
)

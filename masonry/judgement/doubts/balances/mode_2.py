"""Did any contact dissipate more in mode II than its law has? The energy taken, over the area under the law's curve.

Steps that are too long leave the curve behind, and a law that is wrong has none. 2 % is twice the accuracy that is
usually asked of a run.
"""

from masonry.judgement.doubt import Criterion

MODE_2 = Criterion(
    name="mode_2_energy",
    measure=lambda evidence: evidence.number("mode_2_over_law"),
    limit=1.02,
    sentence="a contact took {value:.3g} times the energy of mode II that its law has",
    advice="take smaller steps (lower solver.step_fraction), or check the law where it is your own",
)

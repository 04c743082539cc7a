"""Experiments of the paper: couplets at 0.1, 0.5 and 1.0 MPa, the wallettes of modes 1 and 2, the walls in bending.

These are validation, not verification: how well the model fits masonry, not whether the equations are solved. A case
needs numbers to hold the curves against. The paper shows its experimental envelopes in figures alone and tabulates
none, so there is nothing to compare with. The scenes are shipped: couplet, wallette-mode-1, wallette-mode-2, bending-0.
"""

from verification.case import Case, Findings, RequiredFeature


def run() -> Findings:
    """Not built: says what is missing."""
    raise RequiredFeature("tabulated curves of the experiments; the paper has them in figures only")


CASE = Case(
    name="paper-experiments",
    row="A25",
    title="Experiments of the paper (validation)",
    area="Fracture",
    run=run,
    quick=True,
    problems=("couplet", "wallette-mode-1", "wallette-mode-2", "bending-0"),
)

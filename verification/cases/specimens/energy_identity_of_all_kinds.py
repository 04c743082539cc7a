"""Where the energy goes: rigid blocks, affine blocks and tets in one wall, with each law and each option of the laws.

    external work = kinetic + elastic + damping + work taken by the contacts            (an identity)

            4 -> u         five blocks in running bond, 0 and 1 held: 0 rigid, 1 and 3 tets, 2 and 4 affine;
          2    3           weight, tractions on 3 and 4
        0    1

Reference: by hand, the sum of v(n+1/2) - v(n-1/2) = F dt/m times v.
"""

from verification.case import Case, Findings
from verification.checks.ledgers import identity, scene_of, two_sums
from verification.fixtures.scene_text import run as run_text

MIXED = '{default = "rigid", soft = "affine", fine = "tets"}'
SOLVER = 'masses = "scaled"\ndamping = 0.8'
OPTIONS = (
    'unloading = "elastic"',
    'softening_variable = "plastic"',
    'coupling = "independent"',
    'dilation_angle = "5 deg"',
)

EXPECTED = 1e-3
"""Difference of the two sums of the dissipation at the finer step, over the first."""


def run() -> Findings:
    """All kinds with the exponential law; rigid blocks with the others, with each option, and without damping."""
    found = Findings()
    identity(found, "all kinds, exponential", run_text(scene_of(MIXED, "exponential", SOLVER)))
    for law in ("brittle", "linear", "polynomial"):
        identity(
            found, f"rigid, {law}", run_text(scene_of('"rigid"', law, SOLVER, one_group=True)), ("elastic_blocks",)
        )
    for option in OPTIONS:
        result = run_text(scene_of('"rigid"', "exponential", SOLVER, more=option, one_group=True))
        identity(found, f"rigid, exponential, {option}", result, ("elastic_blocks",))
    undamped = 'masses = "real"\ndamping = 0.0\nstep_fraction = '
    runs = [
        run_text(scene_of('"rigid"', "exponential", f"{undamped}{0.9 / finer}", finer, one_group=True))
        for finer in (2, 4)
    ]
    identity(found, "rigid, no damping", runs[0], ("elastic_blocks", "damping"))
    found.note("rigid, no damping, half the step", runs[1])
    two_sums(found, "rigid, no damping", runs, EXPECTED)
    return found


CASE = Case(
    "energy-identity-of-all-kinds",
    "A21",
    "Where the energy goes: all kinds, laws and options",
    area="Dynamics",
    run=run,
    scene=scene_of(MIXED, "exponential", SOLVER),
    no_ladders="an identity: it holds at any setting",
)

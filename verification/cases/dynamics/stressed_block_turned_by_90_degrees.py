"""A block under stress that is turned by 90 degrees as a whole.

      sigma               sigma
       |      turn          ->
      [ ]     --->     [ ] <-        the stress turns with the block, R sigma R^T; no kinetic energy comes of it

Turns are linear here, u = theta x r, so a turn by 0.01 rad already fakes strains of 5e-5; beyond `rotation_limit`
(0.02 rad) a run is stopped. The scene turned before it is loaded is another case (invariance).

Reference: objectivity of the stress.
"""

from verification.case import Case, Findings, RequiredFeature


def run() -> Findings:
    """Cannot be run yet."""
    raise RequiredFeature("large rotations")


CASE = Case(
    "stressed-block-turned-by-90-degrees",
    "A22",
    "A block under stress that is turned",
    area="Invariance",
    run=run,
    no_problems="not built: there is nothing to run",
)

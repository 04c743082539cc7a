"""Nothing depends on where the axes point, on numbering, or on a rigid motion: rigid blocks.

           _______
        __|___5___|_         five blocks in running bond, the lower two held; weight, a traction on top
       |_3___|__4__|
     |__1__|__2__|

The scene is shifted, turned by 45 degrees about (1, 2, 3) and by 90 degrees, mirrored, and numbered otherwise; its
displacements must be those of the scene as it stands, turned likewise: at rest (strong joints, damped), and while it
swings and cracks (weak joints, undamped). A rigid motion of all blocks makes no force, contact forces add up to nothing
and have no moment, and free blocks keep their momentum.

Reference: Galilei's and Newton's; small rotations, whose turns are linear.
"""

from verification.case import Case, Findings
from verification.checks import invariance


def run() -> Findings:
    """Five rigid blocks."""
    found = Findings()
    invariance.study(found, ["rigid"] * 5, "rigid", 15000)
    return found


CASE = Case(
    "invariance-of-rigid-blocks",
    "A22",
    "Axes, numbers and rigid motions: rigid blocks",
    area="Invariance",
    run=run,
    quick=True,
    no_ladders="the same at any setting, to rounding",
)

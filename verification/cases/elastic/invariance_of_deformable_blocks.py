"""Nothing depends on where the axes point, on numbering, or on a rigid motion: affine blocks, tets, and a mixture.

           _______
        __|___5___|_         five blocks in running bond, the lower two held; weight, a traction on top
       |_3___|__4__|
     |__1__|__2__|

As for rigid blocks: shifted, turned, mirrored, renumbered, at rest and cracking; forces, and momentum. Meshes and
contact points are turned with the blocks, so that both scenes have the same discretisation.

Reference: Galilei's and Newton's; small rotations, whose turns are linear.
"""

from verification.case import Case, Findings
from verification.checks import invariance


def run() -> Findings:
    """Five affine blocks, five of tets, and all kinds together."""
    found = Findings()
    invariance.study(found, ["affine"] * 5, "affine", 15000)
    invariance.study(found, ["tets"] * 5, "tets", 40000)
    invariance.study(found, ["rigid", "affine", "tets", "affine", "tets"], "mixed", 40000)
    return found


CASE = Case(
    "invariance-of-deformable-blocks",
    "A22",
    "Axes, numbers and rigid motions: affine blocks and tets",
    area="Invariance",
    run=run,
    no_ladders="the same at any setting, to rounding",
)

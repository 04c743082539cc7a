"""Nothing depends on where the axes point, on numbering, or on a rigid motion.

           _______
        __|___5___|_         five blocks in running bond, the lower two held; weight, a traction on top
       |_3___|__4__|
     |__1__|__2__|

The scene is shifted, turned by 45 degrees about (1, 2, 3) and by 90 degrees, mirrored, and numbered otherwise; its
displacements must be those of the scene as it stands, turned likewise: at rest (strong joints, damped), and while it
swings and cracks (weak joints, undamped). A rigid motion of all blocks makes no force, contact forces add up to nothing
and have no moment, and free blocks keep their momentum. Meshes and contact points are turned with the blocks, so that
both scenes have the same discretisation.

Reference: Galilei's and Newton's; small rotations, whose turns are linear.
"""

from verification.case import Case, Findings
from verification.checks.invariance import study

TITLE = "Axes, numbers and rigid motions: "
EXACT = "the same at any setting, to rounding"


def rigid() -> Findings:
    """Five rigid blocks."""
    findings = Findings()
    study(findings, ["rigid"] * 5, "rigid", 15000)
    return findings


def deformable() -> Findings:
    """Five affine blocks, five of tets, and all kinds together."""
    findings = Findings()
    study(findings, ["affine"] * 5, "affine", 15000)
    study(findings, ["tets"] * 5, "tets", 40000)
    study(findings, ["rigid", "affine", "tets", "affine", "tets"], "mixed", 40000)
    return findings


CASES = (
    Case(
        "invariance-of-rigid-blocks", "A22", f"{TITLE}rigid blocks", "Invariance", rigid, quick=True, no_problems=EXACT
    ),
    Case(
        "invariance-of-deformable-blocks",
        "A22",
        f"{TITLE}affine blocks and tets",
        "Invariance",
        deformable,
        no_problems=EXACT,
    ),
)

"""The load at which dry structures fall, by limit analysis: forces that balance it, and the mechanism that proves it.

    largest factor a with   forces in the joints balance the dead loads and a times the pattern on every block,
                            no tension, and no more shear than friction allows

    the arch of Oppenheim, tilted      tan = 0.37361        wall 1 of Ferris and Tin-Loi, tilted     0.64286
    the same tilt by simulation        case arch-by-tilt    (exact where dilation equals friction)
    a pebble of 20 mm on a block of 2 m, tilted: it weighs 4e-6 of the block, and tips at 1/4      0.25

References: Oppenheim (1992), Earthquake Engineering and Structural Dynamics 21, 1005; Ferris and Tin-Loi (2001),
International Journal of Mechanical Sciences 43, 209.
"""

import masonry
from verification.case import Case, Findings, Tolerance
from verification.scene_runs import load

FACTORS = {"arch-tilted": (0.37361, 1e-4), "wall-tilted": (0.64286, 1e-4), "pebble-on-a-boulder": (0.25, 1e-9)}
"""With the tolerance: references have five digits, the pebble as many as one likes."""


def run() -> Findings:
    """Factors, the gap to those of the mechanisms, and what is left unbalanced."""
    findings = Findings()
    for scene, (wanted, digits) in FACTORS.items():
        limit = masonry.limit(load(scene))
        tolerance = Tolerance(digits, 0.1 * digits, "the reference has as many digits", "limit analysis")
        findings.check(f"load factor of {scene}", "1", limit.factor, wanted, tolerance)
        findings.at_most(f"duality gap of {scene}", "1", limit.gap, 1e-6, "the mechanism needs the same load")
        reason = "over its own loads"
        findings.at_most(f"left on the block of {scene} that is balanced worst", "1", limit.unbalance, 1e-9, reason)
    return findings


CASE = Case(
    name="limit-analysis",
    row="A35",
    title="Collapse loads by limit analysis",
    area="Friction and stability",
    run=run,
    quick=True,
    scene="wall-tilted",
    no_problems="a programme has no step",
)

"""The load at which dry structures fall, by limit analysis: forces that balance it, and the mechanism that proves it.

    largest factor a with   forces in the joints balance the dead loads and a times the pattern on every block,
                            no tension, and no more shear than friction allows

    the arch of Oppenheim, tilted      tan = 0.37361        wall 1 of Ferris and Tin-Loi, tilted     0.64286
    the same tilt by simulation        case arch-by-tilt    (exact where dilation equals friction)

References: Oppenheim (1992), Earthquake Engineering and Structural Dynamics 21, 1005; Ferris and Tin-Loi (2001),
International Journal of Mechanical Sciences 43, 209.
"""

import masonry
from verification.case import Case, Findings

FACTORS = {"arch-tilted": 0.37361, "wall-tilted": 0.64286}


def run() -> Findings:
    """Factors, the gap to those of the mechanisms, and what is left unbalanced."""
    findings = Findings()
    for scene, wanted in FACTORS.items():
        found = masonry.limit(scene)
        findings.check(f"load factor of {scene}", "1", found.factor, wanted, "limit analysis", 1e-4, 1e-5,
                       "the reference has five digits")  # fmt: skip
        findings.at_most(f"duality gap of {scene}", "1", found.gap, 1e-6, "the mechanism needs the same load")
        findings.at_most(f"force left on a block of {scene}", "1", found.unbalance, 1e-9, "a linear programme")
    return findings


CASE = Case(
    name="limit-analysis",
    row="A35",
    title="Collapse loads by limit analysis",
    area="Friction and stability",
    run=run,
    quick=True,
    scene="wall-tilted",
    no_problems="a linear programme has no step",
)

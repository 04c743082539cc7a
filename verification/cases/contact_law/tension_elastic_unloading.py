"""One contact in tension that unloads with its full stiffness: an opening stays, and is closed in compression.

    stress   .   envelope
            /| \\
           / |/  \\          slope k_n down from (kappa, t):  opening that stays  kappa - t/k_n
          /  /     \\        dissipated                       D = W(kappa) - t^2/(2 k_n)
         ---/--------- u
           /                compression begins there already: an artefact of this rule, to be seen

All four laws, the cycle 0, 20, 0, -8, 0, 20, 40 um.

Reference: incremental laws such as 3DEC's; eqs (7), (12), (14), (16) of the paper for the envelopes.
"""

import numpy as np

from verification.case import Case, Findings, Tolerance
from verification.fixtures.single_tension import JOINT, WIDEST, cycle
from verification.references.closed_forms import LAWS, tension


def run() -> Findings:
    """The cycle of each law, and the opening that stays."""
    findings = Findings()
    for name in LAWS:
        walked = cycle(findings, name, "elastic")
        opening, first = walked.path[:, 2], int(np.argmax(walked.path[:, 2] >= WIDEST))
        below = first + int(np.argmax(walked.sigma[first:] < 0.0))
        a, b = walked.sigma[below - 1], walked.sigma[below]
        stays = float(opening[below - 1] + (opening[below] - opening[below - 1]) * a / (a - b))
        wanted = WIDEST - float(tension(name, JOINT, WIDEST)) / JOINT.kn
        tolerance = Tolerance(1e-12, 1e-14, "a straight line between two points: rounding")
        findings.check(f"opening that stays, {name}", "m", stays, wanted, tolerance)
    return findings


CASE = Case(
    "tension-elastic-unloading",
    "2.1",
    "One contact in tension, elastic unloading",
    area="Contact laws",
    run=run,
    quick=True,
    no_problems="one contact point, driven by displacement: exact at any setting",
)

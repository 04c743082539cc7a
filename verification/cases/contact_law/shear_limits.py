"""One contact in shear where a strength is missing: no compression, no cohesion, nothing to soften.

    s = 0            tau_m = c0, tau_r = cres: the envelope of cohesion alone
    c0 = 0           tau_m = s tan0; eq. (17) has nothing to soften with, so the exponential law keeps its angle;
                     the linear law falls to s tanr over G_II all the same
    c0 = 0, s = 0    no stress and no dissipation at all
    c0 = cres        (and one angle): perfect friction, tau = min(k_s u, c0 + s tan0)

Reference: eqs (13), (15), (17) of the paper, in the limit.
"""

import numpy as np

from verification.case import Case, Findings, Tolerance
from verification.fixtures.single_shear import slid
from verification.references.closed_forms import Joint, shear

S = 0.5e6
LAST = 0.6e-3
LAWS = ("linear", "polynomial", "exponential")


def run() -> Findings:
    """Each limit for each law."""
    findings = Findings()
    perfect = {"cohesion": 0.4e6, "residual_cohesion": 0.4e6, "tan_residual_friction": 1.01}
    limits: tuple[tuple[str, float, Joint, dict[str, float]], ...] = (
        ("no compression", 0.0, Joint(), {}),
        ("no compression, residual cohesion", 0.0, Joint(c_res=0.2e6), {"residual_cohesion": 0.2e6}),
        ("no cohesion", S, Joint(c0=0.0), {"cohesion": 0.0}),
        ("nothing to soften", S, Joint(c0=0.4e6, c_res=0.4e6, tan_res=1.01), perfect),
    )
    for words, compression, joint, changes in limits:
        top = joint.c0 + compression * joint.tan0
        for name in LAWS:
            walked = slid(name, compression, LAST, **changes)
            if words == "nothing to soften":
                wanted = np.minimum(joint.ks * walked.path[:, 0], top)
            else:
                wanted = shear(name, joint, walked.path[:, 0], compression)
            off = float(np.abs(walked.tau - wanted).max())
            tolerance = Tolerance(1e-12, 1e-14, "the same formula: rounding")
            findings.check(f"{words}, {name}: stress, largest deviation", "Pa", off, 0.0, tolerance, scale=top)
    for name in LAWS:
        walked = slid(name, 0.0, LAST, cohesion=0.0)
        most = float(max(walked.tau.max(), np.abs(walked.dissipated).max()))
        quantity = f"no cohesion and no compression, {name}: stress or dissipation, largest"
        findings.check(quantity, "Pa", most, 0.0, Tolerance(1e-14, 1e-16, "nothing holds: exactly zero"), scale=1.0)
    return findings


CASE = Case(
    "shear-limits",
    "2.2",
    "One contact in shear without one of its strengths",
    area="Contact laws",
    run=run,
    no_problems="one contact point, driven by displacement: exact at any setting",
)

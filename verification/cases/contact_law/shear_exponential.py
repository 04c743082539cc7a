"""One contact in shear under constant compression s, exponential law (c of the exponent read as c0).

    tau = tau_r + d exp(-(c0/G_II) (u - u_p)) beyond u_p = tau_m/k_s,   d = tau_m - tau_r
    tau_m = c0 + s tan0,  tau_r = cres + s tanr

Area above tau_r, elastic part included: G_II d/c0 + d^2/(2 k_s), where d/c0 = (c0 - cres)/c0 + s (tan0 - tanr)/c0: the
second term is the energy of losing friction, not of losing cohesion. Below tau_r it is friction.

    s, MPa     tau_m, MPa    tau_r, MPa    d/c0          the couplet of the paper, Table 1
    0.1        0.971         0.073         1.032
    0.5        1.375         0.365         1.161
    1.0        1.880         0.730         1.322

Reference: eq. (17) of the paper; areas by hand.
"""

from math import exp

from verification.case import Case, Findings
from verification.fixtures.single_shear import LAST, energies, envelope
from verification.references.closed_forms import Joint

JOINT = Joint()


def area(s: float) -> float:
    """J/m2 above tau_r up to LAST."""
    top, energy = JOINT.c0 + s * JOINT.tan0, JOINT.G_II + JOINT.G_II_slope * s
    d = top - s * JOINT.tan_res
    gone = 1.0 - exp(-JOINT.c0 / energy * (LAST - top / JOINT.ks))
    return energy * d / JOINT.c0 * gone + d**2 / (2 * JOINT.ks)


def run() -> Findings:
    """Envelope and energies."""
    found = Findings()
    envelope(found, "exponential", JOINT)
    energies(found, "exponential", JOINT, area)
    return found


CASE = Case(
    "shear-exponential",
    "2.2",
    "One contact in shear, exponential law",
    area="Contact laws",
    run=run,
    quick=True,
    ladders=("couplet", "couplet-exponential-01", "couplet-exponential-10"),
)

"""One contact in shear under constant compression s, polynomial law (as mended: lambda is 1 at the peak).

    tau = tau_r + d (w/(w + u - u_p))^beta beyond u_p = tau_m/k_s,   w = 2 G_II/tau_m,   d = tau_m - tau_r
    tau_m = c0 + s tan0,  tau_r = cres + s tanr

Area above tau_r up to a slip U, elastic part included: d^2/(2 k_s) + 2 G_II d/(tau_m (beta - 1)) [1 - (w/(w + U -
u_p))^(beta - 1)]. Below tau_r it is friction: tau_r times the plastic slip.

Reference: eq. (15) of the paper; areas by hand.
"""

from verification.case import Case, Findings
from verification.fixtures.single_shear import LAST, energies, envelope
from verification.references.closed_forms import Joint

JOINT = Joint()


def area(s: float) -> float:
    """J/m2 above tau_r up to LAST."""
    top, energy = JOINT.c0 + s * JOINT.tan0, JOINT.G_II + JOINT.G_II_slope * s
    d, wide = top - s * JOINT.tan_res, 2 * energy / top
    rest = (wide / (wide + LAST - top / JOINT.ks)) ** (JOINT.beta - 1)
    return d**2 / (2 * JOINT.ks) + 2 * energy * d / (top * (JOINT.beta - 1)) * (1 - rest)


def run() -> Findings:
    """Envelope and energies."""
    found = Findings()
    envelope(found, "polynomial", JOINT)
    energies(found, "polynomial", JOINT, area)
    return found


CASE = Case(
    "shear-polynomial",
    "2.2",
    "One contact in shear, polynomial law",
    area="Contact laws",
    run=run,
    quick=True,
    ladders=("couplet-polynomial-05",),
)

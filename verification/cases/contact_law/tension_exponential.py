"""One contact in tension, exponential law.

    t(u) = f_T exp(-f_T (u - u0)/G) beyond u0 = f_T/k_n

Work up to an opening U, after the peak: G [1 - exp(-f_T (U - u0)/G)]; in all G (1 + r) with r = f_T^2/(2 k_n G). First
softening slope: f_T^2/G. Unloading along the secant to the origin; compression with k_n.

Reference: eq. (16) of the paper; areas by hand.
"""

from math import exp

from verification.case import Case, Findings
from verification.fixtures.single_tension import UM, cycle, envelope, first_slope, recoverable, works
from verification.references.closed_forms import Joint

JOINT = Joint()


def run() -> Findings:
    """Envelope, works, slope and cycle."""
    found = Findings()
    last = 300 * UM
    post = JOINT.G_I * (1.0 - exp(-JOINT.fT * (last - JOINT.opening_at_peak) / JOINT.G_I))
    envelope(found, "exponential", JOINT)
    works(found, "exponential", JOINT, last, post + JOINT.fT**2 / (2 * JOINT.kn), post)
    first_slope(found, "exponential", JOINT, JOINT.fT**2 / JOINT.G_I, 1.0)
    cycle(found, "exponential", JOINT)
    recoverable(found, "exponential", JOINT)
    return found


CASE = Case(
    "tension-exponential",
    "2.1",
    "One contact in tension, exponential law",
    area="Contact laws",
    run=run,
    quick=True,
    ladders=("tension-exponential",),
)

"""One contact in tension, polynomial law.

    t(u) = f_T (A/(A - u0 + u))^alpha beyond u0 = f_T/k_n,  A = 2 G/f_T

Work up to an opening U, after the peak: 2 G/(alpha - 1) [1 - (A/(A + U - u0))^(alpha - 1)]; in all G [2/(alpha-1) + r]
with r = f_T^2/(2 k_n G). First softening slope: alpha f_T^2/(2 G). Unloading along the secant to the origin;
compression with k_n. alpha, and beta in shear, must be above 1, or the energy is infinite: refused.

Reference: eq. (14) of the paper; areas by hand.
"""

from verification.case import Case, Check, Findings
from verification.fixtures.single_tension import UM, cycle, envelope, first_slope, least_accepted, recoverable, works
from verification.references.closed_forms import Joint

JOINT = Joint()


def run() -> Findings:
    """Envelope, works, slope and cycle."""
    found = Findings()
    wide, last, rest = 2 * JOINT.G_I / JOINT.fT, 200 * UM, JOINT.alpha - 1.0
    post = 2 * JOINT.G_I / rest * (1.0 - (wide / (wide + last - JOINT.opening_at_peak)) ** rest)
    envelope(found, "polynomial", JOINT)
    works(found, "polynomial", JOINT, last, post + JOINT.fT**2 / (2 * JOINT.kn), post)
    first_slope(
        found,
        "polynomial",
        JOINT,
        JOINT.alpha * JOINT.fT**2 / (2 * JOINT.G_I),
        (JOINT.alpha + 1) * (JOINT.alpha + 2) / 4,
    )
    cycle(found, "polynomial", JOINT)
    recoverable(found, "polynomial", JOINT)
    for key, sign in (("exponent_tension", "alpha"), ("exponent_shear", "beta")):
        found.checks.append(
            Check(f"least {sign} that is accepted", "1", least_accepted("polynomial", key, 10.0), 1.0, "closed form",
                  1e-13, 1e-15, "bisection of a comparison: rounding")
        )  # fmt: skip
    return found


CASE = Case(
    "tension-polynomial",
    "2.1",
    "One contact in tension, polynomial law",
    area="Contact laws",
    run=run,
    quick=True,
    ladders=("tension-polynomial",),
)

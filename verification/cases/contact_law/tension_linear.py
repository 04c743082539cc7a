"""One contact in tension, linear law.

    stress                        u0 = f_T/k_n      opening at the peak
    f_T  . /\\                    A  = 2 G/f_T      opening at which nothing is left
          /    \\                 r  = f_T^2/(2 k_n G)
         /  G     \\
        /____________\\___ u      t(u) = f_T (A - u)/(A - u0) beyond u0, 0 beyond A
           u0         A

Work to full opening is G exactly, after the peak G (1 - r). The curve needs A > u0, that is G > f_T^2/(2 k_n): below
that it would rise, so the input is refused. Unloading along the secant to the origin; compression with k_n.

Reference: eq. (12) of the paper; areas by hand.
"""

from verification.case import Case, Check, Findings
from verification.fixtures.single_tension import cycle, envelope, first_slope, least_accepted, recoverable, works
from verification.references.closed_forms import Joint

JOINT = Joint()


def run() -> Findings:
    """Envelope, works, slope, cycle, and the least energy that is accepted."""
    found = Findings()
    r = JOINT.fT**2 / (2 * JOINT.kn * JOINT.G_I)
    last = 2 * JOINT.G_I / JOINT.fT
    envelope(found, "linear", JOINT)
    works(found, "linear", JOINT, last, JOINT.G_I, JOINT.G_I * (1 - r))
    first_slope(found, "linear", JOINT, JOINT.fT / (last - JOINT.opening_at_peak), 0.0)
    cycle(found, "linear", JOINT)
    recoverable(found, "linear", JOINT)
    least = JOINT.fT**2 / (2 * JOINT.kn)
    found.checks.append(
        Check("least energy that is accepted", "N/m", least_accepted("linear", "fracture_energy_mode_1", 58.0), least,
              "closed form", 1e-13, 1e-15, "bisection of a comparison: rounding")
    )  # fmt: skip
    return found


CASE = Case(
    "tension-linear",
    "2.1",
    "One contact in tension, linear law",
    area="Contact laws",
    run=run,
    quick=True,
    ladders=("tension-linear",),
)

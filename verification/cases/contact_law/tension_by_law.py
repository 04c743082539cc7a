"""One contact in tension, law by law: envelope, works, first softening slope, and a cycle of unloading.

    stress                        u0 = f_T/k_n             opening at the peak; up to it t(u) = k_n u
    f_T  . /\\                    A  = 2 G/f_T             opening at which the linear law has nothing left
          /    \\                 E  = f_T^2/(2 k_n)       elastic triangle; the linear law needs G > E, that is A > u0
         /  G     \\
        /____________\\___ u
           u0         A

    law           stress beyond u0                 work after the peak, up to U                        first slope
    linear        f_T (A - u)/(A - u0), 0 past A   G - E at U = A                                      f_T/(A - u0)
    polynomial    f_T (A/(A - u0 + u))^alpha       2 G/(alpha - 1) [1 - (A/(A + U - u0))^(alpha - 1)]  alpha f_T^2/(2 G)
    exponential   f_T exp(-f_T (u - u0)/G)         G [1 - exp(-f_T (U - u0)/G)]                        f_T^2/G
    brittle       0                                0

The whole work is E more. alpha, and beta in shear, must be above 1, or the energy is infinite: refused, and so is a
smaller G of the linear law. The brittle drop falls into one step du, so the trapezoid of the work adds f_T du/2 at
most. Unloading goes along the secant to the origin; closing gives k_n in compression.

Reference: eqs (7), (12), (14), (16) of the paper; areas by hand.
"""

from collections.abc import Iterator
from functools import partial
from math import exp
from typing import NamedTuple

from verification.case import Case, Findings, Tolerance
from verification.fixtures.single_tension import (
    JOINT,
    UM,
    cycle,
    envelope,
    first_slope,
    least_accepted,
    opened,
    recoverable,
    works,
)

PEAK, WIDE, REST = JOINT.opening_at_peak, 2 * JOINT.G_I / JOINT.fT, JOINT.alpha - 1.0
ELASTIC = JOINT.fT**2 / (2 * JOINT.kn)
BROKEN = 5 * UM


class Softening(NamedTuple):
    """Known values of a law, by hand: work after the peak (J/m2) up to an opening (m), and how its stress falls first.

    slope  Pa/m            third  third derivative of the envelope over its slope there, in (f_T/G)^2
    """

    last: float
    work: float
    slope: float
    third: float


LAWS = {
    "linear": Softening(WIDE, JOINT.G_I - ELASTIC, JOINT.fT / (WIDE - PEAK), 0.0),
    "polynomial": Softening(
        200 * UM,
        2 * JOINT.G_I / REST * (1.0 - (WIDE / (WIDE + 200 * UM - PEAK)) ** REST),
        JOINT.alpha * JOINT.fT**2 / (2 * JOINT.G_I),
        (JOINT.alpha + 1) * (JOINT.alpha + 2) / 4,
    ),
    "exponential": Softening(
        300 * UM, JOINT.G_I * (1.0 - exp(-JOINT.fT * (300 * UM - PEAK) / JOINT.G_I)), JOINT.fT**2 / JOINT.G_I, 1.0
    ),
}
LEAST = {
    "linear": [("energy", "N/m", "fracture_energy_mode_1", 58.0, ELASTIC)],
    "polynomial": [("alpha", "1", "exponent_tension", 10.0, 1.0), ("beta", "1", "exponent_shear", 10.0, 1.0)],
}
"""Law -> name, unit, key of a scene, where the search ends, and the least value that is accepted."""


def softening(law: str) -> Findings:
    """Envelope, works, slope, cycle, and the least values that are accepted."""
    findings, known = Findings(), LAWS[law]
    envelope(findings, law)
    works(findings, law, known.last, known.work + ELASTIC, known.work)
    first_slope(findings, law, known.slope, known.third)
    cycle(findings, law)
    recoverable(findings, law)
    for name, unit, key, end, least in LEAST.get(law, []):
        tolerance = Tolerance(1e-13, 1e-15, "bisection of a comparison: rounding")
        findings.check(f"least {name} that is accepted", unit, least_accepted(law, key, end), least, tolerance)
    return findings


def brittle() -> Findings:
    """Envelope, the energy of a break, and the cycle."""
    findings = Findings()
    envelope(findings, "brittle")
    cycle(findings, "brittle")
    for most in (1.0 * UM, 0.01 * UM):
        broken = opened("brittle", PEAK, BROKEN, step=most)
        du = (BROKEN - PEAK) / -(-(BROKEN - PEAK) // most)
        tolerance = Tolerance(1e-12, 1e-14, "a closed area at any step: rounding")
        value = broken.dissipated[-1]
        findings.check(f"energy of a break, steps of {1e6 * most:g} um", "J/m2", value, ELASTIC, tolerance)
        tolerance = Tolerance(1e-12, 1e-14, "half the drop times the step in which it falls, exactly")
        reference = ELASTIC + 0.5 * JOINT.fT * du
        findings.check(
            f"trapezoid of its work, steps of {1e6 * most:g} um", "J/m2", broken.work[-1], reference, tolerance
        )
    return findings


def cases() -> Iterator[Case]:
    """A case for each law."""
    title = "One contact in tension, "
    for law in LAWS:
        name, run = f"tension-{law}", partial(softening, law)
        yield Case(name, "2.1", f"{title}{law} law", "Contact laws", run, quick=True, problems=(name,))
    exact = "one contact point, driven by displacement: exact at any setting"
    yield Case("tension-brittle", "2.1", f"{title}brittle", "Contact laws", brittle, no_problems=exact)


CASES = tuple(cases())

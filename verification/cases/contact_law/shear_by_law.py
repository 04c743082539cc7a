"""One contact in shear under constant compression s, law by law: envelope and energies.

    tau                              tau_m = c0 + s tan0        u_p = tau_m/k_s        d = tau_m - tau_r
    tau_m . /\\                      tau_r = cres + s tanr      w = 2 G_II/tau_m
           /   \\
    tau_r . /  G  \\_________        law           stress beyond u_p
          /                 u        linear        straight to tau_r at u_l = 2 G_II/d + tau_r/k_s, then tau_r
                                     polynomial    tau_r + d (w/(w + u - u_p))^beta     as mended: 1 at the peak
                                     exponential   tau_r + d exp(-(c0/G_II) (u - u_p))  c of the exponent read as c0
                                     brittle       tau_r at once

Area above tau_r up to a slip U, elastic part included; below tau_r it is friction, tau_r times the plastic slip:

    linear        G_II exactly at U >= u_l
    polynomial    d^2/(2 k_s) + 2 G_II d/(tau_m (beta - 1)) [1 - (w/(w + U - u_p))^(beta - 1)]
    exponential   d^2/(2 k_s) + G_II d/c0 [1 - exp(-(c0/G_II) (U - u_p))]
    brittle       d^2/(2 k_s): what the spring held above tau_r less the friction over the slip that the drop makes at
                  once; it falls into one step du, and costs d du/2 more there

d/c0 = (c0 - cres)/c0 + s (tan0 - tanr)/c0: its second term is the energy of losing friction, not of losing cohesion.

    s, MPa     tau_m, MPa    tau_r, MPa    d/c0          the couplet of the paper, Table 1
    0.1        0.971         0.073         1.032
    0.5        1.375         0.365         1.161
    1.0        1.880         0.730         1.322

Brittle limit of the linear law: G_II > d^2/(2 k_s), refused below; where a compression brings a contact there while it
runs, it drops to tau_r and never gains strength.

Reference: eqs (7), (8), (13), (15), (17) of the paper; areas by hand.
"""

from collections.abc import Iterator
from functools import partial
from math import exp

from verification.case import Case, Findings, Tolerance
from verification.fixtures.single_shear import COMPRESSIONS, JOINT, LAST, STEP, energies, envelope, slid
from verification.fixtures.single_tension import least_accepted

BROKEN = 0.1e-3
LADDERS = {
    "linear": ("couplet-linear-05", "triplet"),
    "polynomial": ("couplet-polynomial-05",),
    "exponential": ("couplet", "couplet-exponential-01", "couplet-exponential-10"),
}
"""Laws that soften -> problems that stand for them."""


def area(law: str, s: float) -> float:
    """J/m2 above tau_r up to LAST."""
    top, energy = JOINT.c0 + s * JOINT.tan0, JOINT.G_II + JOINT.G_II_slope * s
    d, past, order = top - s * JOINT.tan_res, LAST - top / JOINT.ks, JOINT.beta - 1
    if law == "linear":
        return energy
    if law == "exponential":
        return energy * d / JOINT.c0 * (1.0 - exp(-JOINT.c0 / energy * past)) + d**2 / (2 * JOINT.ks)
    wide = 2 * energy / top
    return d**2 / (2 * JOINT.ks) + 2 * energy * d / (top * order) * (1 - (wide / (wide + past)) ** order)


def softening(law: str) -> Findings:
    """Envelope and energies; of the linear law what lies about its brittle limit as well."""
    findings = Findings()
    envelope(findings, law)
    energies(findings, law, partial(area, law))
    if law == "linear":
        limit(findings)
    return findings


def limit(findings: Findings) -> None:
    """The least energy that the linear law accepts, and a compression beyond its brittle limit."""
    least = JOINT.c0**2 / (2 * JOINT.ks)
    accepted = least_accepted("linear", "fracture_energy_mode_2", 580.0, fracture_energy_mode_2_slope=0.0)
    compression, energy = 20e6, {"fracture_energy_mode_2": 1.01 * least, "fracture_energy_mode_2_slope": 0.0}
    top = JOINT.c0 + compression * JOINT.tan0
    beyond = slid("linear", compression, top / JOINT.ks, 2e-3, step=1e-6, **energy)
    tolerance = Tolerance(1e-13, 1e-15, "bisection of a comparison: rounding")
    findings.check("least energy that is accepted", "N/m", accepted, least, tolerance)
    tolerance = Tolerance(1e-12, 1e-14, "strength never grows: rounding")
    findings.check("largest stress beyond the brittle limit", "Pa", beyond.tau.max(), top, tolerance)
    tolerance = Tolerance(1e-12, 1e-14, "the residual friction: rounding")
    findings.check("stress after the drop", "Pa", beyond.tau[-1], compression * JOINT.tan_res, tolerance)


def brittle() -> Findings:
    """Envelope, and the energy of the drop."""
    findings = Findings()
    envelope(findings, "brittle")
    for s in COMPRESSIONS:
        top, rest = JOINT.c0 + s * JOINT.tan0, s * JOINT.tan_res
        us0 = top / JOINT.ks
        walked = slid("brittle", s, us0, BROKEN)
        du = (BROKEN - us0) / -(-(BROKEN - us0) // STEP)
        wanted = (top - rest) ** 2 / (2 * JOINT.ks) + rest * (BROKEN - rest / JOINT.ks) + 0.5 * (top - rest) * du
        tolerance = Tolerance(1e-12, 1e-14, "the drop in one step is exact with its d du/2: rounding of 1000 sums")
        findings.check(f"dissipated at 0.1 mm at {s / 1e6:g} MPa", "J/m2", walked.dissipated[-1], wanted, tolerance)
    return findings


def cases() -> Iterator[Case]:
    """A case for each law."""
    title = "One contact in shear, "
    for law, problems in LADDERS.items():
        run = partial(softening, law)
        yield Case(f"shear-{law}", "2.2", f"{title}{law} law", "Contact laws", run, quick=True, problems=problems)
    yield Case("shear-brittle", "2.2", f"{title}brittle", "Contact laws", brittle, problems=("couplet",))


CASES = tuple(cases())

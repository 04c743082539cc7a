"""One contact pressed until nothing but its residual strength is left, by a cap and by a cut-off.

    compression |      _.-.                    cap        hardening   f kp (1/3 + pi/6) = 0.85693 f kp
              f |    .'    '.                             softening   G_c above f/10,  km = kp + 75/67 G_c/f
            f/2 |   /        '.                           at kp: f, at km: f/2
            f/3 |  |           '--.____ f/10   cut-off    triangle    G_c down to nothing, within 2 G_c/f
                |__|_____________________
                   0   kp    km    plastic closing

The work of crushing that the contact books; an increment of plastic closing is booked by its trapezoid, and that near
0, where the slope of the cap is infinite, takes the finest steps.

Reference: Lourenco and Rots 1997, as OOFEM's manual writes it; the areas by hand.
"""

import numpy as np

from verification.case import Case, Findings, Line, Tolerance
from verification.checks.crushed_contact import AT_PEAK, CAP, CUT_OFF, ENERGY, FM, KN, closed_by, ours
from verification.fixtures.one_contact import walk
from verification.references.interface.crushing import bears

MIDDLE = AT_PEAK + 75.0 / 67.0 * ENERGY / FM
NEAR = Tolerance(1e-9, 1e-10, "the path is given by the plastic closing: a return ends within 1e-10 of the strength")


def by_plastic_closing(k: np.ndarray, strength: np.ndarray) -> np.ndarray:
    """(N, 3) m, the path on which a pressed contact has closed for good by k."""
    return closed_by(k + strength / KN)


def of_cap(findings: Findings) -> Line:
    """Areas up to the peak and beyond, and the strength at three places."""
    hardening = AT_PEAK * np.linspace(0.0, 1.0, 3001) ** 3
    softening = np.concatenate([np.linspace(AT_PEAK, MIDDLE, 1001), np.linspace(MIDDLE, 12.0 * MIDDLE, 6001)[1:]])
    k = np.concatenate([hardening, softening[1:]])
    walked = walk(ours(CAP), by_plastic_closing(k, bears(CAP, k)))
    work, at_peak, at_middle = walked.dissipated_by_mode[:, 3], len(hardening) - 1, len(hardening) + 999
    area = FM * AT_PEAK * (1.0 / 3.0 + np.pi / 6.0)
    beyond = float(work[-1] - work[at_peak]) - 0.1 * FM * float(k[-1] - AT_PEAK)
    reason = "trapezoids of the plastic closing"
    findings.check("cap: work of hardening", "J/m2", work[at_peak], area, Tolerance(1e-6, 2e-7, reason))
    findings.check("cap: work of softening above the residual", "J/m2", beyond, ENERGY, Tolerance(1e-5, 2e-6, reason))
    for what, at, wanted in (("peak", at_peak, FM), ("middle", at_middle, 0.5 * FM), ("end", -1, 0.1 * FM)):
        findings.check(f"cap: strength at the {what}", "Pa", -walked.sigma[at], wanted, NEAR)
    return Line("cap", 1e3 * k[:at_middle], -1e-6 * walked.sigma[:at_middle])


def of_cut_off(findings: Findings) -> Line:
    """The triangle, and half of the strength at half of its length."""
    length = 2.0 * ENERGY / FM
    k = np.linspace(0.0, 1.2 * length, 1201)
    walked = walk(ours(CUT_OFF), by_plastic_closing(k, bears(CUT_OFF, k)))
    work = float(walked.dissipated_by_mode[-1, 3])
    tolerance = Tolerance(1e-9, 1e-10, "trapezoids of a straight line; a return ends within 1e-10 of the strength")
    findings.check("cut-off: work of crushing", "J/m2", work, ENERGY, tolerance)
    findings.check("cut-off: strength half way", "Pa", -walked.sigma[500], 0.5 * FM, NEAR)
    findings.check("cut-off: strength behind the end", "Pa", -walked.sigma[-1], 0.0, NEAR, scale=FM)
    return Line("cut-off", 1e3 * k, -1e-6 * walked.sigma)


def run() -> Findings:
    """Both."""
    findings = Findings()
    lines = of_cap(findings), of_cut_off(findings)
    findings.plot("Strength in compression", "plastic closing (mm)", "compression (MPa)", *lines)
    return findings


CASE = Case(
    "areas-of-crushing",
    "A70",
    "One contact crushed: the areas of the cap and of the cut-off",
    area="Contact laws",
    run=run,
    quick=True,
    no_problems="one contact point, driven by displacement: exact at any setting",
)

"""One contact that dilates: plastic slip lifts the faces by tan(psi) times its path; held down, they press.

    constant s      rise = tan(psi) p, with p = u - tau/k_s the plastic slip: along that path s stays what it was
    locked normal   s = s0 + k_n tan(psi) p; without softening k_s (u - p) = c0 + tan0 s gives
                    p = (k_s u - c0 - tan0 s0)/(k_s + tan0 k_n tan(psi))
    dissipation     (tau - s tan(psi)) dp, never negative for psi <= phi; a steeper psi is refused
    cut-off         the rise ends at tan(psi) times the slip given, exactly

Reference: eqs (9), (10) of the paper, solved by hand.
"""

from math import atan, tan

import numpy as np

from verification.case import Case, Findings, Line, Tolerance
from verification.fixtures.one_contact import along, contact, law, refused, walk
from verification.fixtures.single_tension import ROUNDING, UM
from verification.fixtures.thresholds import threshold
from verification.references.closed_forms import Joint

JOINT = Joint(c_res=0.87e6, tan_res=1.01)
PSI = 0.1
S = 0.3e6
PERFECT = {"residual_cohesion": 0.87e6, "tan_residual_friction": 1.01, "dilation_angle": PSI, "dilation_cutoff": 1.0}
TOP = JOINT.c0 + S * JOINT.tan0


def free(findings: Findings) -> None:
    """The faces rise as the closed form says; the compression then stays."""
    slip = along([(0.0, 0, 0), (TOP / JOINT.ks, 0, 0), (0.15e-3, 0, 0)], 0.1 * UM)[:, 0]
    plastic = np.maximum(slip - TOP / JOINT.ks, 0.0)
    path = np.column_stack([slip, 0 * slip, tan(PSI) * plastic - S / JOINT.kn])
    walked = walk(law("linear", **PERFECT), path)
    tolerance = Tolerance(1e-12, 1e-14, "k_n times rises of 15 um whose rounding is that of a sum of 1500")
    value = np.abs(walked.sigma + S).max()
    findings.check("free: compression, largest deviation", "Pa", value, 0.0, tolerance, scale=S)
    findings.check("free: plastic slip at the end", "m", walked.slip[-1, 0], plastic[-1], ROUNDING)


def locked(findings: Findings) -> None:
    """Held at one height: compression, shear stress and dissipation."""
    z = -S / JOINT.kn
    walked = walk(law("linear", **PERFECT), along([(0, 0, z), (TOP / JOINT.ks, 0, z), (0.2e-3, 0, z)], 1 * UM))
    slip = walked.path[:, 0]
    plastic = np.maximum(JOINT.ks * slip - TOP, 0.0) / (JOINT.ks + JOINT.tan0 * JOINT.kn * tan(PSI))
    pressed = S + JOINT.kn * tan(PSI) * plastic
    rate = walked.tau + walked.sigma * tan(PSI)
    dissipated = float(np.trapezoid(rate, walked.slip[:, 0]))
    grows = (JOINT.tan0 - tan(PSI)) * JOINT.kn * tan(PSI)
    by_hand = (TOP - S * tan(PSI)) * plastic[-1] + 0.5 * grows * plastic[-1] ** 2
    off = float(np.abs(walked.sigma + pressed).max()), float(np.abs(walked.tau - JOINT.ks * (slip - plastic)).max())
    findings.check("locked: compression, largest deviation", "Pa", off[0], 0.0, ROUNDING, scale=pressed.max())
    findings.check("locked: shear stress, largest deviation", "Pa", off[1], 0.0, ROUNDING, scale=walked.tau.max())
    tolerance = Tolerance(1e-12, 1e-14, "a trapezoid of straight lines: rounding")
    findings.check("locked: dissipated", "J/m2", walked.dissipated[-1], by_hand, tolerance)
    findings.check("locked: sum of (tau - s tan psi) dp", "J/m2", dissipated, by_hand, tolerance)
    lines = (
        Line("compression", 1e6 * slip, -1e-6 * walked.sigma),
        Line("shear stress", 1e6 * slip, 1e-6 * walked.tau),
        Line("closed form", 1e6 * slip[::10], 1e-6 * pressed[::10], "points"),
    )
    findings.plot("Dilation with a locked normal", "slip (um)", "stress (MPa)", *lines)


def as_steep_as_friction(findings: Findings) -> None:
    """As steep as friction, forth and back and with all laws: no step makes energy. Steeper is refused."""
    z = -0.1e6 / JOINT.kn
    corners = [(0, 0, z), (90 * UM, 0, z), (-90 * UM, 30 * UM, z), (50 * UM, 0, z - 3 * UM)]
    for name in ("linear", "exponential"):
        steep = law(name, cohesion=0.1e6, dilation_angle=atan(0.73) * (1 - 1e-12), dilation_cutoff=1.0)
        dissipated = walk(steep, along(corners, 0.5 * UM)).dissipated
        tolerance = Tolerance(1e-12, 1e-14, "tau >= s tan(psi): rounding")
        quantity = f"as steep as friction, {name}: largest fall of the dissipation"
        findings.check(quantity, "J/m2", min(np.diff(dissipated).min(), 0.0), 0.0, tolerance, scale=dissipated[-1])
    steepest = threshold(lambda angle: refused("linear", dilation_angle=angle), 0.0, 1.5, 60)[0]
    tolerance = Tolerance(1e-13, 1e-15, "bisection of a comparison: rounding")
    findings.check("steepest dilation angle that is accepted", "rad", steepest, atan(0.73), tolerance)


def ended(findings: Findings) -> None:
    """The rise at the cut-off, of a slip that goes to and fro."""
    for name in ("linear", "exponential"):
        for cutoff in (30.05 * UM, 60 * UM):
            shape, interface = law(name, dilation_angle=PSI, dilation_cutoff=cutoff)
            state = contact(interface)
            walk((shape, interface), along([(0, 0, -2 * UM), (80 * UM, 0, -2 * UM), (0, 0, -2 * UM)], 0.7 * UM), state)
            assert state.dilation is not None
            tolerance = Tolerance(1e-12, 1e-14, "a sum that stops at its limit: rounding")
            quantity = f"rise at a cut-off of {1e6 * cutoff:g} um, {name}"
            findings.check(quantity, "m", state.dilation[0], tan(PSI) * cutoff, tolerance)


def run() -> Findings:
    """All of the above."""
    findings = Findings()
    for part in (free, locked, as_steep_as_friction, ended):
        part(findings)
    return findings


CASE = Case(
    "dilation",
    "2.2",
    "One contact that dilates",
    area="Contact laws",
    run=run,
    quick=True,
    no_problems="one contact point, driven by displacement: exact at any setting",
)

"""One contact whose compression changes while it slides.

Without softening the stress is on the cone of the compression that acts: tau = c0 + s(u) tan0, up and down. With the
exponential law (G_II without slope) the share of strength left falls by exp(-(c0/G_II) x) with the slip x that the
contact makes beyond the strength left: k_s x' = k_s u' - (the change of that strength with s).

     s   1.35 |      /\\
              |     /  \\             s rises from 0.15 to 1.35 MPa, then falls to 0.075 MPa
         0.15 |____/    \\__ u

Reference: eqs (8) and (17) of the paper.
"""

import numpy as np

from verification.case import Case, Findings, Line, Tolerance
from verification.fixtures.one_contact import Walk, along, law, walk
from verification.fixtures.single_tension import UM
from verification.references.closed_forms import Joint, shear

JOINT = Joint(G_II_slope=0.0)
CORNERS = [(0, 0, -1 * UM), (60 * UM, 0, -1 * UM), (140 * UM, 0, -9 * UM), (300 * UM, 0, -0.5 * UM)]
PERFECT = {"residual_cohesion": 0.87e6, "tan_residual_friction": 1.01}


def check(findings: Findings, words: str, walked: Walk, wanted: np.ndarray) -> None:
    """Stress beyond 40 um of slip against the wanted one."""
    sliding = walked.path[:, 0] > 40 * UM
    off = float(np.abs(walked.tau - wanted)[sliding].max())
    tolerance = Tolerance(1e-12, 1e-14, "the same formula: rounding")
    findings.check(f"stress, {words}, largest deviation", "Pa", off, 0.0, tolerance, scale=wanted.max())
    x, some = 1e6 * walked.path[:, 0], slice(0, None, 100)
    lines = (Line("contact", x, 1e-6 * walked.tau), Line("closed form", x[some], 1e-6 * wanted[some], "points"))
    findings.plot(f"Changing compression, {words}", "slip (um)", "shear stress (MPa)", *lines)


def softened(slip: np.ndarray) -> np.ndarray:
    """Stress (Pa) of the exponential law at slips (m) along CORNERS; no lasting way back, so it slides beyond the peak.

    On a leg on which s changes by g k_s for a metre of slip, x' = 1 - g (tan_r + exp(-a x)(tan0 - tan_r)), a = c0/G_II.
    With y = exp(a x) that is y' = A y - B, A = a (1 - g tan_r), B = a g (tan0 - tan_r), solved leg by leg.
    """
    corner = np.array(CORNERS)
    s = np.interp(slip, corner[:, 0], -JOINT.kn * corner[:, 2])
    a, y = JOINT.c0 / JOINT.G_II, np.ones_like(slip)
    begin, top = float(JOINT.peak(-JOINT.kn * corner[0, 2])) / JOINT.ks, 1.0
    for k in range(1, len(corner)):
        end = corner[k, 0]
        g = -JOINT.kn * (corner[k, 2] - corner[k - 1, 2]) / (end - corner[k - 1, 0]) / JOINT.ks
        A, B = a * (1.0 - g * JOINT.tan_res), a * g * (JOINT.tan0 - JOINT.tan_res)  # noqa: N806
        on = (slip > begin) & (slip <= end * (1 + 1e-12))
        y[on] = (top - B / A) * np.exp(A * (slip[on] - begin)) + B / A
        top, begin = (top - B / A) * np.exp(A * (end - begin)) + B / A, end
    rest, peak = JOINT.residual(s), JOINT.peak(s)
    return np.minimum(JOINT.ks * slip, rest + (peak - rest) / y)


AGAIN = [(0, 0, -1e6), (100 * UM, 0, -1e6), (70 * UM, 0, -1e6), (70 * UM, 0, -0.1e6), (120 * UM, 0, -0.1e6)]


def slip_again(findings: Findings) -> None:
    """A contact that slides again under a tenth of the compression goes on at the share that was left.

    Out under 1 MPa: share and plastic slip p by eq. (17). Back, and again under 0.1 MPa: k_s (u - p) up to the strength
    which that share leaves there, and from u1 on the share falls by exp(-(c0/G_II)(u - u1)).
    """
    joint, (most, back, last) = Joint(), (100 * UM, 70 * UM, 120 * UM)
    walked = walk(law("exponential"), along(np.array(AGAIN) / (1.0, 1.0, joint.kn), 0.1 * UM))
    first = np.exp(-joint.c0 / joint.mode_2_energy(1e6) * (most - joint.peak(1e6) / joint.ks))
    plastic = most - float(shear("exponential", joint, most, 1e6)) / joint.ks
    rest, drop = joint.residual(0.1e6), joint.peak(0.1e6) - joint.residual(0.1e6)
    begins = plastic + (rest + first * drop) / joint.ks
    again = slice(int(np.flatnonzero(walked.path[:, 2] >= -0.1e6 / joint.kn * (1 + 1e-9))[0]), None)
    slip = walked.path[again, 0]
    left = first * np.exp(-joint.c0 / joint.mode_2_energy(0.1e6) * np.maximum(slip - begins, 0.0))
    wanted = np.where(slip < begins, joint.ks * (slip - plastic), rest + left * drop)
    tolerance = Tolerance(1e-12, 1e-14, "the same formula: rounding")
    quantity = "stress of slip again under less compression, largest deviation"
    findings.check(quantity, "Pa", np.abs(walked.stress[again, 0] - wanted).max(), 0.0, tolerance, scale=joint.c0)
    assert slip[0] == back and slip[-1] == last
    x, some = 1e6 * slip, slice(0, None, 20)
    lines = (
        Line("contact", x, 1e-6 * walked.stress[again, 0]),
        Line("closed form", x[some], 1e-6 * wanted[some], "points"),
    )
    findings.plot("Slip again under less compression", "slip (um)", "shear stress (MPa)", *lines)


def run() -> Findings:
    """The path with and without softening, and slip that goes on under less compression."""
    findings = Findings()
    path = along(CORNERS, 0.1 * UM)
    for name in ("linear", "exponential"):
        walked = walk(law(name, **PERFECT), path)
        s = -JOINT.kn * path[:, 2]
        check(
            findings, f"{name} without softening", walked, np.minimum(JOINT.ks * path[:, 0], JOINT.c0 + s * JOINT.tan0)
        )
    offs = []
    for most in (0.1 * UM, 0.05 * UM):
        path = along(CORNERS, most)
        walked = walk(law("exponential", fracture_energy_mode_2_slope=0.0), path)
        wanted = softened(path[:, 0])
        offs.append(float(np.abs(walked.tau - wanted)[path[:, 0] > 20 * UM].max()))
        fall = float(min(np.diff(walked.dissipated).min(), 0.0))
    tolerance = Tolerance(1e-5, 2e-6, "the compression of a step is that at its end: first order")
    findings.check("stress, exponential, largest deviation", "Pa", offs[1], 0.0, tolerance, scale=JOINT.c0)
    tolerance = Tolerance(1e-3, 2e-4, "first order", "order")
    findings.check("deviation, exponential, over that in half the steps", "1", offs[0] / offs[1], 2.0, tolerance)
    tolerance = Tolerance(1e-12, 1e-14, "sliding against a cone: rounding")
    findings.check("dissipation never falls, largest fall", "J/m2", fall, 0.0, tolerance, scale=walked.dissipated[-1])
    slip_again(findings)
    return findings


CASE = Case(
    "slip-under-changing-compression",
    "2.2",
    "One contact whose compression changes while it slides",
    area="Contact laws",
    run=run,
    quick=True,
    no_problems="one contact point, driven by displacement: exact at any setting",
)

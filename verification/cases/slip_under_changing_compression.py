"""One contact whose compression changes while it slides.

Without softening the stress is on the cone of the compression that acts: tau = c0 + s(u) tan0, up and down. With the
exponential law (G_II without slope) the share of strength left, exp(-(c0/G_II)(u - tau_m(s)/k_s)), never grows again:
it is the least of all values so far.

     s   1.35 |      /\\
              |     /  \\             s rises from 0.15 to 1.35 MPa, then falls to 0.075 MPa
         0.15 |____/    \\__ u

Reference: eqs (8) and (17) of the paper.
"""

import numpy as np

from verification.case import Case, Check, Findings, Line, Plot
from verification.closed_forms import Joint
from verification.rigs.one_contact import Walk, along, law, walk
from verification.rigs.single_tension import UM

JOINT = Joint(G_II_slope=0.0)
CORNERS = [(0, 0, -1 * UM), (60 * UM, 0, -1 * UM), (140 * UM, 0, -9 * UM), (300 * UM, 0, -0.5 * UM)]
PERFECT = {"residual_cohesion": 0.87e6, "tan_residual_friction": 1.01}


def check(findings: Findings, words: str, walked: Walk, wanted: np.ndarray) -> None:
    """Stress beyond 40 um of slip against the wanted one."""
    sliding = walked.path[:, 0] > 40 * UM
    off = float(np.abs(walked.tau - wanted)[sliding].max())
    findings.checks.append(
        Check(f"stress, {words}, largest deviation", "Pa", off, 0.0, "closed form", 1e-12, 1e-14,
              "the same formula: rounding", float(wanted.max()))
    )  # fmt: skip
    x, some = 1e6 * walked.path[:, 0], slice(0, None, 100)
    lines = (Line("contact", x, 1e-6 * walked.tau), Line("closed form", x[some], 1e-6 * wanted[some], "points"))
    findings.plots.append(Plot(f"Changing compression, {words}", "slip (um)", "shear stress (MPa)", lines))


def run() -> Findings:
    """The path with and without softening."""
    found = Findings()
    path = along(CORNERS, 0.1 * UM)
    for name in ("linear", "exponential"):
        walked = walk(law(name, **PERFECT), path)
        s = -JOINT.kn * path[:, 2]
        check(found, f"{name} without softening", walked, np.minimum(JOINT.ks * path[:, 0], JOINT.c0 + s * JOINT.tan0))
    walked = walk(law("exponential", fracture_energy_mode_2_slope=0.0), path)
    top, rest = JOINT.c0 + s * JOINT.tan0, s * JOINT.tan_res
    past = np.maximum(path[:, 0] - top / JOINT.ks, 0.0)
    left = np.minimum.accumulate(np.exp(-JOINT.c0 / JOINT.G_II * past))
    check(found, "exponential", walked, np.minimum(JOINT.ks * path[:, 0], rest + left * (top - rest)))
    fall = float(min(np.diff(walked.dissipated).min(), 0.0))
    found.checks.append(
        Check("dissipation never falls, largest fall", "J/m2", fall, 0.0, "closed form", 1e-12, 1e-14,
              "sliding against a cone: rounding", float(walked.dissipated[-1]))
    )  # fmt: skip
    return found


CASE = Case(
    "slip-under-changing-compression",
    "2.2",
    "One contact whose compression changes while it slides",
    area="Contact laws",
    run=run,
    quick=True,
    no_ladders="one contact point, driven by displacement: exact at any setting",
)

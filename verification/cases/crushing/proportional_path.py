"""One contact on paths on which the shear stress is r times the compression: where it meets the cap, and how it flows.

    tau |   .cap            s^2 + 9 t^2 = sb(k)^2        peak   s = f/sqrt(1 + 9 r^2),  t = f/3 at s = 0
        |  .  '. / t = r s                               flow   (closing, slip) along the normal (s, 9 t)
        | .    /'.                                       k      the length of that path
        |_____/___'._______ s
              0.5547 f at r = 0.5

The path that keeps t = r s is closing s/kn + k cos a, slip t/ks + k sin a with tan a = 9 r and s = sb(k)/sqrt(1 + 9
r^2). The cohesion is beyond all that is met, so that nothing else yields.

Reference: Lourenco and Rots 1997, with Cnn = 1, Cn = 0, Css = 9.
"""

import numpy as np

from verification.case import Case, Findings, Line, Tolerance
from verification.checks.crushed_contact import AT_PEAK, CAP, FACTOR, FM, KN, KS, STRONG, ours
from verification.fixtures.one_contact import walk
from verification.references.interface.crushing import bears

RATIOS = (0.0, 0.2, 0.5, 1.0, 3.0)
REASON = "the flow at the end of each step is that of the whole path, as its direction never changes"


def paths() -> dict[str, tuple[float, float]]:
    """Shares of the compression and of the shear stress, by ratio; the last one is shear alone."""
    return {f"tau = {r:g} sigma": (1.0, r) for r in RATIOS} | {"shear alone": (0.0, 1.0)}


def run() -> Findings:
    """The peak of each path, and the largest deviation from it."""
    findings, lines = Findings(), []
    k = 4.0 * AT_PEAK * np.linspace(0.0, 1.0, 401) ** 2
    for words, (pressed, sheared) in paths().items():
        reach, flow = np.hypot(pressed, np.sqrt(FACTOR) * sheared), np.hypot(pressed, FACTOR * sheared)
        s, t = bears(CAP, k) * pressed / reach, bears(CAP, k) * sheared / reach
        path = np.column_stack([t / KS + k * FACTOR * sheared / flow, 0.0 * k, -s / KN - k * pressed / flow])
        walked = walk(ours(CAP, **STRONG), path)
        peak = float(walked.tau.max()) if pressed == 0.0 else float(-walked.sigma.min())
        wanted = FM / 3.0 if pressed == 0.0 else FM / reach
        off = np.hypot(walked.sigma + s, walked.tau - t)[1:].max()
        findings.check(f"peak, {words}", "Pa", peak, wanted, Tolerance(1e-9, 1e-10, REASON))
        tolerance = Tolerance(1e-8, 1e-9, REASON)
        findings.check(f"both stresses, {words}, largest deviation", "Pa", off, 0.0, tolerance, scale=FM)
        lines.append(Line(words, -1e-6 * walked.sigma, 1e-6 * walked.tau, "points"))
    angle = np.linspace(0.0, 0.5 * np.pi, 50)
    cap = Line("cap at its peak", 1e-6 * FM * np.cos(angle), 1e-6 * FM / 3.0 * np.sin(angle), "dashed")
    findings.plot("Proportional paths", "compression (MPa)", "shear stress (MPa)", cap, *lines)
    return findings


CASE = Case(
    "proportional-path-to-the-cap",
    "A71",
    "One contact on proportional paths to the cap",
    area="Contact laws",
    run=run,
    quick=True,
    no_problems="one contact point, driven by displacement: exact at any setting",
)

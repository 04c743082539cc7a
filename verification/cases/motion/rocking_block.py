"""A slender block that rocks on its edges.

      ____
     |    |  th       th'' = -p^2 sin(alpha - th),  p^2 = 3 g/(4 R),  tan(alpha) = b/h
     |    |/          let go at th = alpha/2: impacts at 0.34917, 0.91745 and 1.39964 s
     |____|__         of its spin each leaves (I + m h^2 - m b x)/(I + m h^2 + m b x), x = b: 0.91176

What an impact leaves is no input: it follows from where its impulse acts, here at the corner, x from the middle of the
base. The dashpots that take the rest are critical; they act in closed contacts only, and never pull.

Reference: Housner (1963), Bulletin of the Seismological Society of America 53, 403; times by quadrature.
"""

from math import atan, cos, hypot

import numpy as np

from verification.case import Case, Findings, Line, Tolerance
from verification.scene_runs import result_of

SCENE, HALF, HIGH, G = "block-rocking", 0.125, 0.5, 9.81
MASS = 2000.0 * 0.25 * 0.5 * 1.0
IMPACTS, KEPT = (0.34917, 0.91745, 1.39964), 0.91176
BETWEEN = (0.2, 0.6, 1.15, 1.55)
"""s: before each impact and after the last, in the middle of a swing."""


def run() -> Findings:
    """Times of the impacts, and what each leaves of the spin."""
    findings = Findings()
    result = findings.note("rocking", result_of(SCENE, {"solver.rows": 3000, "solver.duration": "1.6 s"}))
    rows, alpha = result.history.rows, atan(HALF / HIGH)
    time, leant = rows["time"], MASS * G * hypot(HALF, HIGH) * (cos(0.5 * alpha) - cos(alpha))
    energy = rows["kinetic"] - rows["external_work"] + leant  # from the place at which it stands upright
    swings = np.interp(BETWEEN, time, energy)
    halfway = 0.5 * (swings[1:] + swings[:-1])
    for number, (limit, wanted) in enumerate(zip(halfway, IMPACTS, strict=True), 1):
        tolerance = Tolerance(1e-2, 3e-3, "springs give way, and dashpots stretch each impact")
        findings.check(f"time of impact {number}", "s", time[energy > limit][-1], wanted, tolerance)
    for number, left in enumerate(np.sqrt(swings[1:] / swings[:-1]), 1):
        tolerance = Tolerance(1e-2, 3e-3, "critical dashpots; the block turns a little in each impact")
        findings.check(f"spin left by impact {number}, over that before", "1", left, KEPT, tolerance)
    before = swings[0] * KEPT ** (2.0 * np.arange(3))
    findings.plot("Energy of a rocking block", "time (s)", "energy above that of standing (J)",
                  Line("run", time, energy),
                  Line("closed form, before each impact", np.array(IMPACTS), before, "points"))  # fmt: skip
    return findings


CASE = Case(
    name="rocking-block",
    row="A13",
    title="A block that rocks on its edges",
    area="Friction and stability",
    run=run,
    scene=SCENE,
    problems=("rocking",),
)

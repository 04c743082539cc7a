"""A load that varies over time on a block that is as good as free: what it moves is its impulse.

    F ^        .           m v = integral of F dt = A s T r/2 for a share of the stress s that rises to r in T;
      |     .              work of the loads = m v^2/2
      |  .____ t           without damping, on a spring so soft that it gives way by (w T)^2 = 6e-7 of the load
      |.
    The load starts a step after the settling, and is taken for straight over the 200 steps from there on: the impulse
    is 200/2 (1 - 1/200) (1/T) steps too large for that, 5e-5 of it.

Reference: Newton; areas by hand.
"""

import numpy as np

from verification.case import Case, Findings, Tolerance
from verification.scene_runs import result_of

SIDES, HEIGHT, DENSITY = (0.2, 0.1), 0.05, 1900.0
AREA = SIDES[0] * SIDES[1]
MASS = DENSITY * AREA * HEIGHT
STEP, STEPS, SETTLE = 2.0**-23, 2000, 10
STRESS = 0.2e6, -0.3e6
RISES = 1.0, -1.7
"""Of each load: share of the stress that it rises to."""

SCENE = "loads-that-rise"


def run() -> Findings:
    """Kinetic energy and work at the end."""
    findings = Findings()
    result = findings.note("impulse", result_of(SCENE))
    momentum = 0.5 * AREA * STEP * STEPS * np.array(STRESS) * RISES
    wanted = float(momentum @ momentum) / (2.0 * MASS)
    rows = result.history.rows
    why = "the line over the first 200 steps: 5e-5 of the impulse, twice of its square"
    for name, key in (("kinetic energy", "kinetic"), ("work of the loads", "external_work")):
        findings.check(f"{name} at the end", "J", rows[key][-1], wanted, Tolerance(3e-4, 1e-4, why))
    tolerance = Tolerance(1e-13, 1e-15, "steps times the step: rounding")
    findings.check("time at the end", "s", rows["time"][-1], STEP * (SETTLE + 1 + STEPS), tolerance)
    return findings


CASE = Case(
    "load-history-by-its-impulse",
    "A16",
    "Loads that vary, by their impulse",
    area="Dynamics",
    run=run,
    quick=True,
    scene=SCENE,
    no_problems="a sum over steps: exact at any",
)

"""Ground that shakes as a cosine without end, under a block that never sticks: how far it slides to and fro.

    eta = mu g/a0 < 2/sqrt(pi^2 + 4) = 0.53703: it slides at all times; in the steady state, from one turn to the other,
    slip from peak to peak = 2 a0/w^2 sqrt(1 - (pi eta/2)^2)

Reference: Den Hartog (1931), Transactions of the ASME 53, 107; Westermo and Udwadia (1983), Earthquake Engineering and
Structural Dynamics 11, 135.
"""

import numpy as np

from verification.case import Case, Findings, Line, Tolerance
from verification.scene_runs import result_of

G, A0, MU, PERIOD = 9.80665, 0.5, 0.2, 1.0
SCENE = "block-on-ground"
CYCLES = 12


def run() -> Findings:
    """The last two cycles of twelve."""
    findings = Findings()
    keys = {"ground.x": "0.5 g * cos(2 pi t / 1 s)", "ground.duration": f"{CYCLES} s", "solver.rows": 12000}
    rows = findings.note("twelve cycles", result_of(SCENE, keys)).history.rows
    w, eta = 2.0 * np.pi / PERIOD, MU / A0
    wanted = 2.0 * A0 * G / w**2 * np.sqrt(1.0 - (0.5 * np.pi * eta) ** 2)
    since = rows["time"] - rows["time"][-1] + CYCLES
    last = rows["slip"][since > CYCLES - 2 * PERIOD]
    tolerance = Tolerance(
        2e-3, 3e-4, "what is left of the first cycles, the stiffness of the joint, a peak between two rows"
    )
    findings.check("slip from peak to peak", "m", np.ptp(last), wanted, tolerance)
    findings.plot("Slip", "time (s)", "slip (m)", Line("slip", since, rows["slip"]))
    return findings


CASE = Case(
    "sine-base",
    "A46",
    "A block slides to and fro on ground that shakes as a sine",
    area="Dynamics",
    run=run,
    quick=True,
    scene=SCENE,
    no_problems="rigid-plastic sliding: exact but for the stiffness of the joint",
)

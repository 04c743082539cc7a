"""The largest stable step of rigid blocks, of affine blocks and of tets, and what a run does beyond it.

    leapfrog     sin(a/2) = w dt/2: bounded up to dt = 2/w_max, the kinetic energy of a mode at most 1/(1 - (w dt/2)^2)
                 of what it had; beyond, it grows by exp(2 acosh(w dt/2)) a step
    damping      local damping adds xi of the force to whatever turns round at each step: 2/(w_max sqrt(1 + xi))

w_max from the eigenvalues of a stiffness that is assembled apart from the program (`assembled.py`): springs at the
contact points, one strain in each affine block and in each tet. The program's own step comes from row sums, by
Gershgorin, which are never above. A scene at 1.05 of the limit must end with a message, at 0.99 it must give the same
answer as ever.

Reference: leapfrog, by hand; ARPACK.
"""

import numpy as np

from masonry import scene
from masonry.assembly.assemble import assemble
from masonry.errors import Stopped
from masonry.laboratory import laboratory
from verification.case import Case, Findings, Tolerance
from verification.checks import critical
from verification.fixtures import assembled, models

GIVEN = {"law": "exponential", "drive.steps": 8000, "settle.steps": 20000, "solver.masses": "real"}


def rigid() -> Findings:
    """A stack of three blocks, and the couplet on both sides of its limit."""
    findings = Findings()
    critical.study(findings, ["rigid"] * 3, "rigid")
    model = assemble(scene.load("couplet", GIVEN)).model
    omega, _ = assembled.fastest(model, assembled.stiffness(model, models.STONE))
    mass, spring = 1900.0 * 0.2 * 0.05 * 0.05, 150e9 * 0.2 * 0.05
    tolerance = Tolerance(1e-12, 1e-15, "one degree of freedom that is free: sqrt(k_n A/m)")
    findings.check("couplet: highest frequency", "rad/s", omega, np.sqrt(spring / mass), tolerance)
    limit = float(2.0 / omega / np.sqrt(1.8))
    result = laboratory.run(scene.load("couplet", {**GIVEN, "solver.time_step": f"{critical.BELOW * limit!r} s"}))
    findings.note("couplet at 0.99 of the limit", result)
    tolerance = Tolerance(1e-12, 1e-14, "as at any stable step: the settled confinement")
    reference = 0.73 * 0.5e6 + 1.01e6 * float(np.exp(-0.87e6 / 123.0 * (1e-3 - 1.375e6 / 70e9)))
    findings.check(
        "couplet: residual stress at 0.99 of the limit", "Pa", result.summary["final_stress_pa"], reference, tolerance
    )
    said = ""
    try:
        laboratory.run(scene.load("couplet", {**GIVEN, "solver.time_step": f"{critical.ABOVE * limit!r} s"}))
    except Stopped as stop:
        said = str(stop)
        rows = stop.result.history.rows
        findings.remarks.append(f"At 1.05 of the limit: {said}")
        said = said if all(np.isfinite(values).all() for values in rows.values()) else ""
    named = "unstable at step" in said and "block 1" in said and "gershgorin" in said
    tolerance = Tolerance(1e-14, 0.0, "yes or no")
    findings.check("couplet: stopped at 1.05 of the limit, its block named, rows finite", "1", named, 1.0, tolerance)
    return findings


def deformable() -> Findings:
    """A stack on a held rigid block, of each kind."""
    findings = Findings()
    for kind in ("affine", "tets"):
        critical.study(findings, ["rigid", kind, kind], kind)
    return findings


LIMIT = "the limit of the step itself: what a shorter one costs is a knob of most problems"
TITLE = "The largest stable step of "
CASES = (
    Case("critical-step", "A20", f"{TITLE}rigid blocks", "Dynamics", rigid, quick=True, no_problems=LIMIT),
    Case(
        "critical-step-of-deformable-blocks",
        "A20",
        f"{TITLE}affine blocks and tets",
        "Dynamics",
        deformable,
        no_problems=LIMIT,
    ),
)

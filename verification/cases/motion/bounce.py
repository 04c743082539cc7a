"""A block that falls flat on a slab, on springs and a dashpot that cannot pull: what it keeps of its speed.

      | v          m x'' = -k x - 2 zeta sqrt(k m) x' while that is above 0
     _v__
    |____|         e = v'/v by quadrature until the force is 0: it parts before x = 0
    ======

The dashpot acts on velocities half a step old, so the step makes an error of first order in dt sqrt(k/m).

Reference: one dof, integrated by scipy to 1e-12.
"""

import numpy as np

from verification.case import Case, Findings, Tolerance
from verification.fixtures.dry_blocks import box, restitution, slab
from verification.scene_runs import result_of

SCENE, SPEED = "dry-block", 1.0
DAMPING_RATIOS = (0.05, 0.1, 0.2, 0.5)


def run() -> Findings:
    """Speed after the impact over that before, without weight."""
    findings = Findings()
    for zeta in DAMPING_RATIOS:
        knobs = {
            "specimen.box": [slab(), box("block", (-0.05, -0.1, 0.02), (0.1, 0.2, 0.1), 1)],
            "contact.unit_unit.normal_dashpot": zeta,
            "gravity": None,
            "settle": None,
            "motion": [{"on": "block", "velocity": [0, 0, f"-{SPEED} m/s"]}],
            "solver.duration": "0.04 s",
            "solver.step_fraction": 0.1,
        }
        result = findings.note(f"zeta {zeta:g}", result_of(SCENE, knobs))
        rows = result.history.rows
        energy = rows["kinetic"][-1] / rows["kinetic"][1]
        tolerance = Tolerance(1e-2, 3e-3, "first order in the time step, a tenth of the bound")
        findings.check(f"restitution, zeta {zeta:g}", "1", np.sqrt(energy), restitution(zeta), tolerance)
    return findings


CASE = Case(
    name="bounce",
    row="A31",
    title="A block that bounces on springs and dashpots",
    area="Dynamics",
    run=run,
    scene=SCENE,
    problems=("bounce",),
)

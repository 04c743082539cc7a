"""A block that is pushed over at its centre: the force falls with its lean, and is nothing where it balances.

        ____
       /    /--> F        F/W = tan(alpha - theta),  tan(alpha) = b/h,  h the height of the centre over the edge
      /  . /              x = R (sin(alpha) - sin(alpha - theta)): way of the centre, R^2 = b^2 + h^2
     /____/_ edge

Reference: statics of a rigid block about its edge.
"""

import numpy as np

from verification.case import Case, Findings, Line, Tolerance
from verification.fixtures.dry_blocks import DENSITY, G, block
from verification.scene_runs import result_of

SCENE, HALF, HIGH, DEPTH = "dry-block", 0.05, 0.15, 0.2
KNOBS = {
    "specimen.box": block(HALF, HIGH),
    "contact.unit_unit": {
        "normal_stiffness": "100 GPa/m",
        "shear_stiffness": "100 GPa/m",
        "tan_friction_angle": 2.0,
        "normal_dashpot": 0.5,
    },
    "settle.steps": 40000,
    "drive": {"on": "block", "direction": "x", "displacement": "55 mm", "rate": "20 mm/s", "ramp": 0.2},
    "solver.duration": None,
    "solver.rows": 400,
}


def run() -> Findings:
    """The force at every row beyond 15 % of the way, and where it would balance."""
    findings = Findings()
    result = findings.note("pushed over", result_of(SCENE, KNOBS))
    rows = result.history.rows
    weight = DENSITY * G * 4.0 * HALF * HIGH * DEPTH
    travel = rows["displacement"]
    late = travel > 0.15 * travel[-1]  # it gathers way within a tenth
    alpha, radius = np.arctan2(HALF, HIGH), np.hypot(HALF, HIGH)
    left = np.arcsin(np.sin(alpha) - travel / radius)  # alpha - theta
    off = rows["force"][late] / weight - np.tan(left[late])
    worst = int(np.argmax(np.abs(off)))
    tolerance = Tolerance(1e-3, 1e-4, "springs let the edge in by a share of 1e-6, and v^2/(g R) is 3e-4")
    findings.check("force over weight", "1", off[worst], 0.0, tolerance, scale=1.0)
    at_rest = float(np.interp(0.0, -(rows["force"][late]), travel[late]))
    findings.check("way at which it balances", "m", at_rest, HALF, Tolerance(1e-3, 1e-4, "as the force"), scale=HALF)
    findings.plot("A block pushed over at its centre", "way of the centre (mm)", "force over weight (1)",
                  Line("run", travel * 1e3, rows["force"] / weight),
                  Line("tan(alpha - theta)", travel * 1e3, np.tan(left), "dashed"))  # fmt: skip
    return findings


CASE = Case(
    name="block-pushed-over",
    row="A30",
    title="A block pushed over its edge",
    area="Friction and stability",
    run=run,
    scene=SCENE,
    no_problems="the speed of the drive is what is left, and the closed form has none",
)

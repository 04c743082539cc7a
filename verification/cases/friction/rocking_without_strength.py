"""A unit without strength is pushed until it rocks: the force that overturns it is known.

        N = sigma A, constant
           |
        ___v___
       |       |--> F, in the middle of the unit, h/2 above the joint
       |_______|
     __|_______|__          F h/2 = N e,   e: from the middle of the joint to its outermost contact points

All contacts but the last row have opened then, and friction is more than enough. What is looked for besides: the unit
is a mechanism, and a damping about its expected motion must neither feed it nor swing it.
"""

import numpy as np

from verification.case import Case, Findings, Tolerance
from verification.scene_runs import result_of

SCENE = "dry-rocking"
N_OVER_AREA, HEIGHT = 0.05e6, 0.15


def run() -> Findings:
    """Force at the end, kinetic energy, and the work of damping."""
    findings = Findings()
    result = findings.note("rocking", result_of(SCENE))
    summary, points = result.summary, result.joints.point
    at_joint = np.abs(points[:, 2] - HEIGHT) < 1e-9
    lever = float(np.ptp(points[at_joint, 0])) / 2.0
    tolerance = Tolerance(
        1e-11,
        2e-12,
        "displacements are small, so the lever is that of the drawing; what swings at the end is below rounding",
    )
    value = summary["final_stress_pa"]
    findings.check("force over the section at the end", "Pa", value, N_OVER_AREA * lever / (HEIGHT / 2.0), tolerance)
    reason = "it moves with its drive"
    findings.at_most("kinetic over internal energy", "1", summary["kinetic_over_internal_max"], 0.01, reason)
    findings.at_most("work of damping, given", "1", -summary["damping_over_external"], 1e-6, "damping only takes")
    return findings


CASE = Case(
    name="rocking-without-strength",
    row="A27",
    title="A unit without strength rocks",
    area="Quasi-static loading",
    run=run,
    quick=True,
    scene=SCENE,
    no_problems="one run to the shipped accuracy, held against its closed form",
)

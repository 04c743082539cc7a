"""Four units in two courses pulled apart: a stepped crack of mixed mode, against the interface model.

            v v v v v v v v v v v v v    20 kPa, dead
           _______________________________
          |   upper   |      upper       |
          |___________|__________________|  -->  this end moves along x
          |      lower        |  lower   |  -->
          |___________________|__________|
          o  o  o  o  o  o  o  o  o  o  o   rollers; the left end is held along x and y

Head joints open, the bed joint between them slides under the little pressure, and opens at its ends: tension and shear
spend one damage, D = dt + ds - dt ds, which lowers tensile strength, secant and cohesion together. What is torn loses
the residual cohesion in proportion to its opening. The bond is not symmetric, so that one crack path is the only one:
two like head joints in a course would be a bifurcation, where two right models may each take another branch.
"""

import numpy as np

from verification.case import Case, Findings
from verification.checks.beside_pair import Allowed, compare
from verification.references.interface.model import InterfaceModel
from verification.scene_runs import assembled

SCENE = "two-courses-of-tets"
PLACES = [*np.linspace(0, 5e-6, 11)[1:], *np.linspace(5e-6, 105e-6, 34)[1:]]
LENGTH, HEIGHT, NEAR = 0.36, 0.2, 1e-9


def conditions(model: InterfaceModel) -> None:
    """One end held, the other moved; rollers below, a dead pressure above."""
    model.hold("xy", lambda x, block: x[:, 0] < NEAR)
    model.hold("z", lambda x, block: x[:, 2] < NEAR)
    model.drive("x", lambda x, block: x[:, 0] > LENGTH - NEAR)
    model.dead = model.pressed([0.0, 0.0, -20e3], lambda x: x[2] > HEIGHT - NEAR)


def run() -> Findings:
    """Curve and nodes, from the elastic range to a quarter of the peak."""
    findings = Findings()
    allowed = Allowed(elastic=(1e-9, 1e-8), softening=(1e-5, 5e-5), nodes=(1e-7, 1e-6))
    compare(findings, "two courses", lambda: assembled(SCENE), conditions, PLACES, allowed, move=3000, wait=1000)
    return findings


CASE = Case(
    "wallette-of-two-courses",
    "A7",
    "Two courses in tension, mixed mode, against the interface model on the same tets",
    area="Fracture",
    run=run,
    quick=True,
    scene=SCENE,
    problems=("two-courses-of-tets",),
)

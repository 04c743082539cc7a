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
from verification.fixtures.scene_text import assembled
from verification.references.interface.model import Model

SCENE = """title = "Two courses in tension along the bed joint"
law = "exponential"
kinematics = "tets"
[specimen]
kind = "boxes"
section = "8000 mm^2"
mesh_size = "90 mm"
box = [
  {name = "left below", origin = ["0 mm", "0 mm", "0 mm"], size = ["200 mm", "40 mm", "100 mm"], unit = 0},
  {name = "right below", origin = ["200 mm", "0 mm", "0 mm"], size = ["160 mm", "40 mm", "100 mm"], unit = 1},
  {name = "left above", origin = ["0 mm", "0 mm", "100 mm"], size = ["120 mm", "40 mm", "100 mm"], unit = 2},
  {name = "right above", origin = ["120 mm", "0 mm", "100 mm"], size = ["240 mm", "40 mm", "100 mm"], unit = 3},
]
[material.units]
density = "1900 kg/m^3"
young_modulus = "16.7 GPa"
poisson_ratio = 0.2
[contact.unit_unit]               # Table 3, without dilation
normal_stiffness = "167 GPa/m"
shear_stiffness = "69.6 GPa/m"
tensile_strength = "0.1 MPa"
cohesion = "0.15 MPa"
friction_angle = "45 deg"
residual_cohesion = "1.5 kPa"
residual_friction_angle = "36 deg"
fracture_energy_mode_1 = "5 N/m"
fracture_energy_mode_2 = "15 N/m"
[[support]]
on = "x = 0 mm"
fix = ["x", "y"]
[[support]]
on = "z = 0 mm"
fix = ["z"]
[drive]
on = "x = 360 mm"
direction = "x"
displacement = "105 um"
steps = 1000
[[traction]]
on = "z = 200 mm"
stress = {z = "-20 kPa"}
[settle]
steps = 1000
"""
PLACES = [*np.linspace(0, 5e-6, 11)[1:], *np.linspace(5e-6, 105e-6, 34)[1:]]
LENGTH, HEIGHT, NEAR = 0.36, 0.2, 1e-9


def conditions(model: Model) -> None:
    """One end held, the other moved; rollers below, a dead pressure above."""
    model.hold("xy", lambda x, block: x[:, 0] < NEAR)
    model.hold("z", lambda x, block: x[:, 2] < NEAR)
    model.drive("x", lambda x, block: x[:, 0] > LENGTH - NEAR)
    model.dead = model.pressed([0.0, 0.0, -20e3], lambda x: x[2] > HEIGHT - NEAR)


def run() -> Findings:
    """Curve and nodes, from the elastic range to a quarter of the peak."""
    found = Findings()
    allowed = Allowed(elastic=(1e-9, 1e-8), softening=(1e-5, 5e-5), nodes=(1e-7, 1e-6))
    compare(found, "two courses", lambda: assembled(SCENE), conditions, PLACES, allowed, move=3000, wait=1000)
    return found


CASE = Case(
    "wallette-of-two-courses",
    "A7",
    "Two courses in tension, mixed mode, against the interface model on the same tets",
    area="Fracture",
    run=run,
    quick=True,
    scene=SCENE,
    ladders=("two-courses-of-tets",),
)

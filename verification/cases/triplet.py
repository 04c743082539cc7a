"""A triplet of rigid units: the middle one is pushed, and both joints resist.

       s s s s s s
      |___________|        F = 2 A tau(u),  tau as of one joint under s
      |___________| -> F   (the upper unit may rise but not slide or turn, the lower one is held)
      |___________|
       ///////////

Reference: eqs (8), (17) of the paper; statics.
"""

import numpy as np

from verification.case import Case, Findings
from verification.closed_forms import Joint, dissipated_in_shear, shear
from verification.scene_text import run as run_text

AREA, S, STEPS = 0.2 * 0.05, 0.5e6, 20000
SCENE = """
law = "exponential"
kinematics = "rigid"
confinement = "0.5 MPa"
[specimen]
kind = "boxes"
section = "0.01 m^2"                # of one joint
box = [
  {name = "bottom", origin = ["0 m", "0 m", "0 mm"], size = ["200 mm", "50 mm", "50 mm"], unit = 0},
  {name = "middle", origin = ["0 m", "0 m", "50 mm"], size = ["200 mm", "50 mm", "50 mm"], unit = 1},
  {name = "top", origin = ["0 m", "0 m", "100 mm"], size = ["200 mm", "50 mm", "50 mm"], unit = 2},
]
[material.units]
density = "1900 kg/m^3"
[contact.unit_unit]
normal_stiffness = "150 GPa/m"
shear_stiffness = "70 GPa/m"
tensile_strength = "0.58 MPa"
cohesion = "0.87 MPa"
tan_friction_angle = 1.01
residual_cohesion = "0 Pa"
tan_residual_friction_angle = 0.73
fracture_energy_mode_1 = "5.8 N/m"
fracture_energy_mode_2 = "58 N/m"
fracture_energy_mode_2_slope = "130 N/m/MPa"
[[support]]
on = "bottom"
fix = "all"
[[support]]
on = "middle"
fix = ["y", "rotation"]
[[support]]
on = "top"
fix = ["x", "y", "rotation"]
[[traction]]
on = "top.z+"
stress = {z = "-confinement"}
[settle]
steps = 8000
[drive]
on = "middle"
direction = "x"
displacement = "1 mm"
steps = 20000
[solver]
rows = 600
"""


def run() -> Findings:
    """Force on the middle unit, and what both joints dissipate."""
    found, joint, kind = Findings(), Joint(), "closed form"
    result = found.note("triplet", run_text(SCENE))
    rows = result.history.rows
    moved = rows["displacement"] > 0.0
    slip, force = rows["displacement"][moved], AREA * rows["stress"][moved]
    wanted = 2 * AREA * shear("exponential", joint, slip, S)
    peak = 2 * AREA * float(joint.peak(S))
    energy = result.summary["energy_j"]
    spent = energy["fracture_mode_1"] + energy["fracture_mode_2"] + energy["friction"]
    gone = 2 * AREA * float(dissipated_in_shear("exponential", joint, slip[-1], S))
    steps = np.diff(rows["displacement"]) / np.maximum(np.diff(rows["step"]), 1)
    missed = 2 * AREA * joint.ks * float(steps[: np.searchsorted(rows["displacement"], joint.peak(S) / joint.ks)].max())
    print(float(np.abs(force - wanted).max()) / peak, spent / gone - 1, missed / peak)
    return found


CASE = Case("triplet", "A8", "Triplet of rigid units", area="Contact laws", run=run, quick=True, scene=SCENE)

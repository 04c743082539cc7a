"""Two units between glued plates, pulled apart: joint and glue in series.

    ===  plate, driven along z          U = u + C sigma(u),   C = 2/k_glue
    [ ]  unit, free                     sigma(u): the softening curve of the joint, closed_forms.tension
    [ ]  unit, free                     no snap-back while C < -1/(d sigma/d u), which all three laws keep here
    ===  plate, held

Peak fT. Dissipated: A (work of the joint up to u less sigma u/2, which secant unloading gives back). References: eqs
(12), (14), (16) of the paper, integrated term by term.
"""

import numpy as np

from verification.fixtures.scene_text import joint_table
from verification.ladder import FEW_ROWS, Problem, pace
from verification.references.closed_forms import Joint, dissipated_in_tension, tension
from verification.timed_run import Trial

JOINT = Joint()
GLUE, LENGTH, WIDTH, PULL = 600e9, 0.2, 0.05, 40e-6

SCENE = f"""
law = "exponential"
kinematics = "rigid"
[specimen]
kind = "prism"
units = 2
length = "{LENGTH} m"
width = "{WIDTH} m"
height = "50 mm"
plates = "20 mm"
[material]
units = {{density = "1900 kg/m^3"}}
plates = {{density = "7850 kg/m^3"}}
{joint_table(JOINT)}
[contact.plate]
law = "elastic"
normal_stiffness = "{GLUE} Pa/m"
shear_stiffness = "{GLUE / 2} Pa/m"
[[support]]
on = "bottom plate"
fix = "all"
[[support]]
on = "top plate"
fix = ["x", "y", "rotation"]
[drive]
on = "top plate"
direction = "z"
displacement = "{PULL} m"
"""


def exact(one: Trial) -> dict[str, float]:
    """Peak (Pa) and dissipated energy (J) of the law that a run had."""
    law = str(one.knobs["law"])
    opening = np.linspace(0.0, PULL, 400_001)
    moved = opening + 2.0 / GLUE * tension(law, JOINT, opening)
    last = float(np.interp(PULL, moved, opening))
    return {
        "peak stress": JOINT.fT,
        "dissipated energy": LENGTH * WIDTH * dissipated_in_tension(law, JOINT, last),
    }


def problem(law: str) -> Problem:
    """One law of the joint."""
    title = f"Joint and glue in tension, {law} law"
    return Problem(f"tension-{law}", title, SCENE, pace(64000), {"law": law, **FEW_ROWS}, exact=exact)


PROBLEMS = tuple(map(problem, ("linear", "polynomial", "exponential")))

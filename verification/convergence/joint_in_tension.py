"""Two units between glued plates, pulled apart: joint and glue in series.

    ===  plate, driven along z          U = u + C sigma(u),   C = 2/k_glue
    [ ]  unit, free                     sigma(u): the softening curve of the joint, closed_forms.tension
    [ ]  unit, free                     no snap-back while C < -1/(d sigma/d u), which all three laws keep here
    ===  plate, held

Peak fT. Dissipated: A (work of the joint up to u less sigma u/2, which secant unloading gives back). References: eqs
(12), (14), (16) of the paper, integrated term by term.
"""

import numpy as np

from verification.problem import FEW_ROWS, Problem, pace
from verification.references.closed_forms import Joint, dissipated_in_tension, tension
from verification.scene_runs import SceneRun

JOINT = Joint()
GLUE, LENGTH, WIDTH, PULL = 600e9, 0.2, 0.05, 40e-6

SCENE = "joint-and-glue"


def exact(one: SceneRun) -> dict[str, float]:
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
    base = {"law": law, **FEW_ROWS}
    return Problem(f"tension-{law}", title, SCENE, pace(64000), base, exact=exact, dear=law != "linear")


PROBLEMS = tuple(map(problem, ("linear", "polynomial", "exponential")))

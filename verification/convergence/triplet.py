"""The shear triplet: the middle unit is pushed out between two others under pressure, linear law.

p  | upper |          two joints carry the push: per joint  tau(s) of closed_forms.shear, the same slip s in both
   +-------+  -> s    peak      c0 + p tan(phi0)
middle unit           energy    2 A (work of a joint up to s less tau^2/(2 ks))
   +-------+
   | lower | held     section 2 A, so that the reported stress is tau
"""

from verification.problem import FEW_ROWS, Problem, pace
from verification.references.closed_forms import Joint, dissipated_in_shear
from verification.scene_runs import Run

JOINT = Joint(kn=80e9, ks=35e9, fT=0.2e6, c0=0.3e6, tan0=0.84, tan_res=0.7, G_I=10.0, G_II=50.0, G_II_slope=0.0)
LENGTH, WIDTH, PRESSURE, PUSH = 0.25, 0.1, 0.2e6, 0.6e-3


SCENE = "shear-triplet"


def exact(one: Run) -> dict[str, float]:
    """Peak (Pa) and dissipated energy (J)."""
    spent = float(dissipated_in_shear("linear", JOINT, PUSH, PRESSURE))
    return {"peak stress": float(JOINT.peak(PRESSURE)), "dissipated energy": 2 * LENGTH * WIDTH * spent}


PROBLEMS = (Problem("triplet", "Shear triplet, linear law", SCENE, pace(32000), FEW_ROWS, exact=exact),)

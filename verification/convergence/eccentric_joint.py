"""A joint that is pulled off its centre: it opens at one edge, and the block above it turns.

         ^ U          opening at x:  u(x) = U + turn (x - e)
    +----|---+        no moment about the line of the pull:  integral of sigma(u(x)) (x - e) dx = 0
    |    .   |        stress reported:  integral of sigma(u(x)) dx / L
    +----:---+
      |  :   |        no shear, for the block is free to move sideways; elastic:  U / sigma = (1 + 12 e^2/L^2)/kn
    ==+======+==      cracked: one equation for the turn at each U, solved with 2,000 fibres
     L:  e             the energy dissipated is that of each fibre, closed_forms.dissipated_in_tension

The knob that matters is the number of contact points along the joint: with Gauss points the stiffness is exact from two
on, the cracked joint is not.
"""

from functools import cache

import numpy as np
from scipy.optimize import brentq

from verification.problem import ACCURACY, FEW_ROWS, RATE, Problem, pace
from verification.references.closed_forms import Joint, dissipated_in_tension, tension
from verification.scene_runs import SceneRun

JOINT = Joint(G_I=20.0)
LENGTH, WIDTH, ECCENTRICITY, PULL, LAW = 0.2, 0.05, 0.03, 60e-6, "exponential"

SCENE = "eccentric-joint"
FIBRES = 2000
PLACES = (np.arange(FIBRES) + 0.5) * LENGTH / FIBRES - LENGTH / 2
"""(F,) x of the fibres from the middle of the joint (m)."""


@cache
def solution() -> tuple[float, float]:
    """(peak Pa, dissipated J) of the continuous joint: the turn at every pull, then the sum over the fibres."""
    arm, rotation, peak = PLACES - ECCENTRICITY, 0.0, 0.0
    widest = np.zeros(FIBRES)
    for pull in np.linspace(0.0, PULL, 4001)[1:]:
        guess, reach = rotation, 4e-3 * PULL

        def moment(rotation: float, pull: float = pull) -> float:
            return float(np.sum(tension(LAW, JOINT, pull + rotation * arm) * arm))

        while moment(guess - reach / LENGTH) * moment(guess + reach / LENGTH) > 0.0:
            reach *= 1.5
        rotation = float(brentq(moment, guess - reach / LENGTH, guess + reach / LENGTH, xtol=1e-16))
        opening = pull + rotation * arm
        widest = np.maximum(widest, opening)
        peak = max(peak, float(np.mean(tension(LAW, JOINT, opening))))
    cracked = widest[widest > JOINT.opening_at_peak]
    dissipated = sum(dissipated_in_tension(LAW, JOINT, w) for w in cracked)
    return peak, dissipated * WIDTH * LENGTH / FIBRES


def exact(one: SceneRun) -> dict[str, float]:
    """Peak (Pa) and dissipated energy (J) of the continuous joint."""
    peak, dissipated = solution()
    return {"peak stress": peak, "dissipated energy": dissipated}


POINTS = {str(n): {"specimen.points_per_edge": {"x": n}, "drive.steps": 16000} for n in (2, 4, 8, 16, 32)}
FINE = {"specimen.points_per_edge": {"x": 32}}
KNOBS = {knob: {label: FINE | keys for label, keys in settings.items()} for knob, settings in pace(32000).items()}
PROBLEMS = (
    Problem(
        "eccentric-joint",
        "Joint pulled off its centre",
        SCENE,
        KNOBS | {"contact points along the joint": POINTS},
        base=FEW_ROWS,
        exact=exact,
        kind="refined model",
    ),
    Problem(
        "eccentric-joint-large",
        "Joint pulled off its centre, in large displacement",
        SCENE,
        {knob: KNOBS[knob] for knob in (RATE, ACCURACY)} | {"contact points along the joint": POINTS},
        base=FEW_ROWS | {"displacements": "large"},
        exact=exact,
        kind="refined model",
        dear=True,
    ),
)

"""A joint that rocks on a toe that crushes: its moment and the energy of crushing, against points along it and pace.

    th = (u - V/(ks A))/h      turn at a drive u: what the joint slid is taken off      V = M(th)/h
    energy of crushing         t fc th xp^2/2: plastic closing th (xp - s) at s from the edge

With Gauss points, which stand in the middle of strips, and points from edge to edge.
"""

import numpy as np
from scipy.optimize import brentq

from verification.cases.crushing.rocking_joint import FORCE, HIGH, LENGTH, SCENE, STIFFNESS, STRENGTH, THICKNESS, moment
from verification.problem import ACCURACY, FEW_ROWS, RATE, Problem, Refinement, accuracies, steps
from verification.scene_runs import SceneRun

DRIVEN, SHEAR_STIFFNESS = 4e-3, 2e10
AREA = LENGTH * THICKNESS


def exact(one: SceneRun) -> dict[str, float]:
    """Largest force over the section (Pa), which is the last one, and energy (J)."""

    def beyond(turn: float) -> float:
        return turn * HIGH + float(moment(np.array(turn))) / HIGH / (SHEAR_STIFFNESS * AREA) - DRIVEN

    turn = float(brentq(beyond, 1e-9, DRIVEN / HIGH, xtol=1e-18))
    crushed = FORCE / (THICKNESS * STRENGTH) - 0.5 * STRENGTH / (STIFFNESS * turn)
    energy = 0.5 * THICKNESS * STRENGTH * turn * crushed**2
    return {"peak stress": float(moment(np.array(turn))) / HIGH / AREA, "energy of crushing": energy}


def measure(one: SceneRun) -> dict[str, float]:
    """The same of a run."""
    return {"peak stress": one.value("peak"), "energy of crushing": one.summary["energy_j"]["crushing"]}


def points(rule: str, *numbers: int) -> Refinement:
    """Along the joint; across it as few as there can be."""
    across = 1 if rule == "gauss" else 2
    return {
        str(n): {
            "specimen.contact_points": rule,
            "specimen.points_per_edge": {"x": n, "y": across, "z": across},
            "drive.accuracy": "0.5 %",
        }
        for n in numbers
    }


FINE = {"specimen.points_per_edge": {"x": 128, "y": 1, "z": 1}}
PROBLEMS = (
    Problem(
        "rocking-joint",
        "Joint that rocks on a toe that crushes",
        SCENE,
        {
            RATE: {label: FINE | keys for label, keys in steps(4000, 8000, 16000, 32000).items()},
            ACCURACY: {label: FINE | keys for label, keys in accuracies(5.0, 2.0, 1.0, 0.5).items()},
            "contact points along the joint, gauss": points("gauss", 4, 8, 16, 32, 64),
            "contact points along the joint, vertex": points("vertex", 5, 9, 17, 33, 65),
        },
        base=FEW_ROWS,
        measure=measure,
        exact=exact,
        units={"peak stress": "Pa", "energy of crushing": "J"},
    ),
)

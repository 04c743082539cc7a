"""A joint that rocks on a toe that crushes: its moment and the energy of crushing, against points along it and pace.

    both over their closed form at the turn th that the block has in the end:
    moment              M(th) of the case
    energy of crushing  t fc th xp^2/2: plastic closing th (xp - s) at s from the edge

With Gauss points, which stand in the middle of strips, and points from edge to edge.
"""

from verification.cases.crushing.rocking_joint import (
    FORCE,
    HIGH,
    LENGTH,
    SCENE,
    STIFFNESS,
    STRENGTH,
    THICKNESS,
    moment,
)
from verification.problem import ACCURACY, FEW_ROWS, RATE, Problem, Refinement, accuracies, steps
from verification.scene_runs import SceneRun

AREA = LENGTH * THICKNESS
MOMENT, ENERGY = "moment over the closed form", "energy of crushing over the closed form"


def exact(one: SceneRun) -> dict[str, float]:
    """Both are as they should be."""
    return {MOMENT: 1.0, ENERGY: 1.0}


def measure(one: SceneRun) -> dict[str, float]:
    """At the end of a run."""
    turn = (one.rows["left"] - one.rows["right"])[-1:] / LENGTH
    crushed = FORCE / (THICKNESS * STRENGTH) - 0.5 * STRENGTH / (STIFFNESS * turn)
    energy = 0.5 * THICKNESS * STRENGTH * turn * crushed**2
    return {
        MOMENT: one.value("final") * AREA * HIGH / float(moment(turn)[0]),
        ENERGY: one.summary["energy_j"]["crushing"] / float(energy[0]),
    }


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
        units={MOMENT: "1", ENERGY: "1"},
    ),
)

"""Three small tests of tets, all nodes of the joints softening apart from one another: the scenes of three cases.

    eccentric-tension     a joint pulled open from one side, the crack runs through it
    couplet-of-tets       a joint in shear under 0.5 MPa, through its peak
    two-courses-of-tets   four units pulled apart, bed joint and head joints at once

The cases hold a run against the interface model on the same mesh, to 1e-5. Here the loading is held against the
converged run on that mesh, and other meshes and laws, which are other models, against it as well.
"""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

from verification.cases.fracture import couplet_of_tets, eccentric_tension, wallette_of_two_courses
from verification.problem import ACCURACY, RATE, Problem, Refinement, accuracies, fractions, laws, steps, threads
from verification.timed_run import THREADS

COUNTS = (2000, 4000, 8000, 16000)
USUAL = {"drive.steps": COUNTS[-2]}


def meshes(extra: dict[str, Any], *sizes: int) -> Refinement:
    """Edges of the tets, mm."""
    return {f"{size} mm": {"specimen.mesh_size": f"{size} mm", **extra} for size in sizes}


def problem(
    name: str, title: str, scene: str, *sizes: int, more: Mapping[str, Refinement] = MappingProxyType({})
) -> Problem:
    """One of them, with knobs of its own besides those of all."""
    knobs = {
        RATE: steps(*COUNTS),
        ACCURACY: accuracies(4, 2, 1, 0.5, 0.25),
        "step fraction": fractions(USUAL),
        "model: mesh": meshes(USUAL, *sizes),
    }
    return Problem(name, title, scene, knobs | dict(more), converged=ACCURACY)


PROBLEMS = (
    problem("eccentric-tension", "Joint of tets pulled open from one side", eccentric_tension.SCENE, 40, 25, 16),
    problem("couplet-of-tets", "Couplet of tets in shear", couplet_of_tets.SCENE, 50, 25, 16),
    problem(
        *("two-courses-of-tets", "Two courses of tets in tension", wallette_of_two_courses.SCENE, 90, 45, 30),
        more={"model: law": laws(USUAL), THREADS: threads({"drive.steps": COUNTS[0]})},
    ),
)

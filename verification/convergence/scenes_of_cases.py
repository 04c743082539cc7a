"""Scenes of cases, whose loading is held here against the converged run: three of tets, two of torn beams.

    eccentric-tension     a joint pulled open from one side, the crack runs through it
    couplet-of-tets       a joint in shear under 0.5 MPa, through its peak
    two-courses-of-tets   four units pulled apart, bed joint and head joints at once
    dcb-force             half a double cantilever beam, pulled apart at its end
    enf                   an end-notched beam in three-point bending

The cases hold a run of tets against the interface model on the same mesh, to 1e-5; other meshes and laws, which are
other models, are held against the converged run on that mesh as well. The beams of rigid blocks tear by small jumps,
block by block, so that a drive paced by its error would take millions of steps: they are driven at constant rates, and
damped less than the default, which would eat a part of every jump.
"""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

from verification.cases.fracture import couplet_of_tets, dcb_force, eccentric_tension, enf, wallette_of_two_courses
from verification.problem import (
    ACCURACY,
    RATE,
    Problem,
    Refinement,
    accuracies,
    dampings,
    fractions,
    laws,
    steps,
    threads,
)
from verification.timed_run import THREADS

COUNTS = (2000, 4000, 8000, 16000)
USUAL = {"drive.steps": COUNTS[-2]}


def meshes(extra: dict[str, Any], *sizes: int) -> Refinement:
    """Edges of the tets, mm."""
    return {f"{size} mm": {"specimen.mesh_size": f"{size} mm", **extra} for size in sizes}


def tets(
    name: str, title: str, scene: str, *sizes: int, more: Mapping[str, Refinement] = MappingProxyType({})
) -> Problem:
    """One of them, with knobs of its own besides those of all."""
    knobs = {
        RATE: steps(*COUNTS),
        ACCURACY: accuracies(4, 2, 1, 0.5, 0.25),
        "step fraction": fractions(USUAL),
        "model: mesh": meshes(USUAL, *sizes),
    }
    return Problem(name, title, scene, knobs | dict(more), converged=ACCURACY, dear=True)


def torn(name: str, title: str, scene: str, fine: int) -> Problem:
    """The loading halved four times from `fine` steps, and the damping at a quarter of these."""
    counts = [fine >> k for k in (4, 3, 2, 1, 0)]
    knobs = {RATE: steps(*counts), "damping": dampings({"drive.steps": counts[2]}, 0.8, 0.5, 0.3, 0.2)}
    return Problem(name, title, scene, knobs, shipped=("", ""), dear=True)


PROBLEMS = (
    tets("eccentric-tension", "Joint of tets pulled open from one side", eccentric_tension.SCENE, 40, 25, 16),
    tets("couplet-of-tets", "Couplet of tets in shear", couplet_of_tets.SCENE, 50, 25, 16),
    tets(
        *("two-courses-of-tets", "Two courses of tets in tension", wallette_of_two_courses.SCENE, 90, 45, 30),
        more={"model: law": laws(USUAL), THREADS: threads({"drive.steps": COUNTS[0]})},
    ),
    torn("dcb-force", "Double cantilever beam", dcb_force.SCENE, 400_000),
    torn("enf", "End-notched beam", enf.SCENE, 400_000),
)

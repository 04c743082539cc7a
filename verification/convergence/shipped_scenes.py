"""The scenes of the paper as they are shipped: couplet, the wallettes of both failure modes, the wall in bending.

And two courses of the wallette of mode 2, with an eighth of its blocks, which can be driven far more slowly.
"""

from typing import Any

from verification.convergence.joint_in_shear import exact
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
from verification.references.closed_forms import LAWS
from verification.timed_run import THREADS

FACTORS = (8.0, 4.0, 2.0, 1.0, 0.5)


def rates(usual: float) -> Refinement:
    """Constant rates (mm/s): `FACTORS` times as fast as usual."""
    return {f"x{f:g}": {"drive.rate": f"{f * usual:g} mm/s"} for f in FACTORS}


def cells(extra: dict[str, Any], *sizes: tuple[int, ...]) -> Refinement:
    """The grid of a unit."""
    return {"x".join(map(str, d)): {"specimen.divisions": list(d), **extra} for d in sizes}


def motions(mesh: str, extra: dict[str, Any]) -> Refinement:
    """How the units move."""
    tets: dict[str, Any] = {"kinematics": {"units": "tets"}, "specimen.mesh_size": mesh}
    by_kinematics: Refinement = {
        "rigid": {"kinematics": "rigid"},
        "affine": {"kinematics": {"units": "affine"}},
        "tets": tets,
    }
    return {label: {**knobs, **extra} for label, knobs in by_kinematics.items()}


def couplet() -> Problem:
    """Exponential law at 0.5 MPa."""
    usual = {"drive.steps": 40000}
    knobs = {
        RATE: steps(*(round(40000 / f) for f in FACTORS)),
        ACCURACY: accuracies(5, 2, 1, 0.5),
        "step fraction": fractions(usual),
        "damping": dampings(usual),
        "kinematics": motions("25 mm", usual),
        "cells": cells(usual, (1, 1, 1), (2, 1, 1), (4, 2, 2)),
        "model: law, each against its own closed form": laws(usual, *LAWS),
        THREADS: threads({"drive.steps": 5000}),
    }
    return Problem("couplet", "Couplet as shipped", "couplet", knobs, exact=exact)


def wallette(mode: int) -> Problem:
    """x1 is 1 mm/s in mode 1, the rate of the paper, and half of that in mode 2.

    The reference is the finest accuracy: the peak at x0.5 is still 0.3 % off what smaller rates come to.
    """
    usual = 1.0 / mode
    quick, quicker = {"drive.rate": f"{4 * usual:g} mm/s"}, {"drive.rate": f"{16 * usual:g} mm/s"}
    moved = motions("60 mm", quick)
    moved["tets (at x16)"] = {**moved.pop("tets"), **quicker}
    knobs = {
        RATE: rates(usual),
        ACCURACY: accuracies(4, 2, 1, 0.5, 0.25),
        "step fraction": fractions(quick),
        "damping": dampings(quick),
        THREADS: threads(quicker),
        "model: kinematics": moved,
        "model: cells": cells(quick, (2, 1), (4, 2), (8, 4), (12, 6)),
        "model: law": laws(quick),
    }
    name = f"wallette-mode-{mode}"
    title = f"Wallette, failure mode {mode}, as shipped"
    return Problem(name, title, name, knobs, converged=ACCURACY, dear=mode == 1)


def bending() -> Problem:
    """The wall in horizontal bending, of rigid cells."""
    usual = {"drive.steps": 15000}
    knobs = {
        RATE: steps(7500, 15000, 30000, 60000),
        ACCURACY: accuracies(4, 2, 1, 0.5, 0.25),
        "step fraction": fractions(usual),
        "damping": dampings(usual),
        "model: law": laws(usual),
    }
    title = "Wallette in horizontal bending, as shipped"
    return Problem("bending-0", title, "bending-0", knobs, converged=ACCURACY, dear=True)


def deformable(mode: int, motion: str) -> Problem:
    """The wallette with units that deform: another model, which converges to another answer."""
    keys: dict[str, Any] = {"kinematics": {"units": motion}}
    knobs = {ACCURACY: accuracies(4, 2, 1, 0.5, 0.25)}
    if motion == "tets":
        keys["specimen.mesh_size"] = "60 mm"
        knobs[THREADS] = threads({"drive.rate": f"{16 / mode:g} mm/s"})
    return Problem(
        f"wallette-mode-{mode}-{motion}",
        f"Wallette, failure mode {mode}, units of {motion}"
        if motion == "tets"
        else f"Wallette, failure mode {mode}, affine units",
        f"wallette-mode-{mode}",
        knobs,
        base=keys,
        converged=ACCURACY,
        dear=True,
    )


def two_courses() -> Problem:
    """A wall of two courses, pulled along the bed joints."""
    quick = {"drive.rate": "0.5 mm/s"}
    knobs = {
        RATE: {f"{rate} mm/s": {"drive.rate": f"{rate} mm/s"} for rate in (4, 2, 1, 0.5, 0.25, 0.125, 0.0625)},
        ACCURACY: accuracies(),
        "step fraction": fractions(quick),
        "damping": dampings(quick),
        "model: law": laws(quick),
    }
    base = {"specimen.courses": 2, "specimen.divisions": [4, 2], "drive.displacement": "0.2 mm"}
    return Problem("small-wallette", "Wallette of two courses", "wallette-mode-2", knobs, base)


PROBLEMS = (
    couplet(),
    wallette(1),
    wallette(2),
    bending(),
    *(deformable(k, m) for k in (1, 2) for m in ("affine", "tets")),
    two_courses(),
)

"""Joints in shear whose peak, final stress and energy are known at every slip, see closed_forms.shear.

The couplet by law and confinement. And the shear triplet, linear law, whose middle unit is pushed out under pressure:

p  | upper |          two joints carry the push, each by the same slip s
   +-------+  -> s    peak      c0 + p tan(phi0)
middle unit           energy    2 A (work of a joint up to s less tau^2/(2 ks))
   +-------+
   | lower | held     section 2 A, so that the reported stress is tau
"""

from typing import Any

import numpy as np

from verification.problem import FEW_ROWS, Problem, pace
from verification.references import closed_forms
from verification.references.closed_forms import Joint
from verification.scene_runs import SceneRun, joint_of, load

STEPS = 32000


def exact_stress(scene: str, knobs: dict[str, Any], slip: np.ndarray) -> np.ndarray:
    """Shear stress (Pa) at slips (m) of the couplet as the scene gives it: up with ks, then the law's envelope."""
    loaded = load(scene, knobs)
    joint = joint_of(scene, knobs)
    return closed_forms.shear(loaded.contact["unit_unit"].law, joint, slip, loaded.confinement or 0.0)


def exact_values(one: SceneRun) -> dict[str, float]:
    """Peak and final stress (Pa), and the energy (J) that the joint has dissipated at the end of the drive."""
    loaded = load(one.scene, one.knobs)
    assert loaded.drive is not None
    slip = np.linspace(0.0, loaded.drive.farthest, 400_001)
    tau = exact_stress(one.scene, one.knobs, slip)
    stored = 0.5 * tau[-1] ** 2 / loaded.contact["unit_unit"].shear_stiffness
    area = loaded.specimen.length * loaded.specimen.width  # type: ignore[union-attr]
    return {
        "peak": float(tau.max()),
        "final": float(tau[-1]),
        "dissipated": area * float(np.trapezoid(tau, slip) - stored),
    }


def exact(one: SceneRun) -> dict[str, float]:
    """Peak and end stress (Pa), and dissipated energy (J), from the closed form."""
    values = exact_values(one)
    return {"peak stress": values["peak"], "end stress": values["final"], "dissipated energy": values["dissipated"]}


def motions() -> dict[str, dict[str, Any]]:
    """How the units move: all have the same closed form, since what is driven and held has no shear of its own."""
    usual = {"drive.steps": STEPS // 4}
    return {motion: {"kinematics": motion, **usual} for motion in ("rigid", "affine", "tets")}


def problem(law: str, confinement: str) -> Problem:
    """The couplet with one law at one confinement."""
    return Problem(
        name=f"couplet-{law}-{confinement.split()[0].replace('.', '')}",
        title=f"Joint in shear, {law} law, {confinement}",
        scene="couplet",
        knobs=pace(STEPS) | {"kinematics": motions()},
        base={"law": law, "confinement": confinement, **FEW_ROWS},
        exact=exact,
        dear=law != "linear",
    )


JOINT = Joint(kn=80e9, ks=35e9, fT=0.2e6, c0=0.3e6, tan0=0.84, tan_res=0.7, G_I=10.0, G_II=50.0, G_II_slope=0.0)
LENGTH, WIDTH, PRESSURE, PUSH = 0.25, 0.1, 0.2e6, 0.6e-3
"""Of the triplet: m, m, Pa, m."""


def exact_of_triplet(one: SceneRun) -> dict[str, float]:
    """Peak (Pa) and dissipated energy (J)."""
    dissipated = float(closed_forms.dissipated_in_shear("linear", JOINT, PUSH, PRESSURE))
    return {"peak stress": float(JOINT.peak(PRESSURE)), "dissipated energy": 2 * LENGTH * WIDTH * dissipated}


PROBLEMS = (
    problem("exponential", "0.1 MPa"),
    problem("exponential", "1.0 MPa"),
    problem("linear", "0.5 MPa"),
    problem("polynomial", "0.5 MPa"),
    Problem("triplet", "Shear triplet, linear law", "shear-triplet", pace(STEPS), FEW_ROWS, exact=exact_of_triplet),
)

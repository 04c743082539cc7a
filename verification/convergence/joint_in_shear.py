"""The couplet by law and confinement: peak, final stress and energy are known at every slip, see closed_forms.shear."""

from typing import Any

from verification.ladder import FEW_ROWS, Problem, pace
from verification.studies.couplet import exact_values
from verification.timed_run import Trial

STEPS = 32000


def exact(one: Trial) -> dict[str, float]:
    """Peak and end stress (Pa), and dissipated energy (J), from the closed form."""
    found = exact_values(one)
    return {"peak stress": found["peak"], "end stress": found["final"], "dissipated energy": found["dissipated"]}


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
    )


PROBLEMS = (
    problem("exponential", "0.1 MPa"),
    problem("exponential", "1.0 MPa"),
    problem("linear", "0.5 MPa"),
    problem("polynomial", "0.5 MPa"),
)

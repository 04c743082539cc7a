"""A block under stress that is turned by 90 degrees as a whole.

      sigma               sigma
       |      turn          ->          F -> R F:  sigma -> R sigma R^T,  sigma = F S F^T / det F,
      [ ]     --->     [ ] <-           S = lambda tr(E) 1 + 2 mu E,  E = (F^T F - 1)/2;  the same energy

First it is put there. Then it spins by more than that, in flight: its ends stretch it, and what its stress and its
motion hold together stays.

Reference: objectivity of the stress (St Venant-Kirchhoff, by hand).
"""

from typing import Any

import numpy as np

from masonry.configuration import energy
from verification.case import Case, Findings, Tolerance
from verification.scene_runs import assembled, result_of

SCENE, YOUNG, POISSON, DENSITY = "brick-in-flight", 1e8, 0.2, 2000.0
SIZE = np.array([0.24, 0.115, 0.06])
STRETCH = np.array([[1.0, 2e-3, 1e-3], [2e-3, 0.996, 3e-3], [1e-3, 3e-3, 1.004]])
ORDER = ((0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1))
RATE = 20.0
"""rad/s about z."""
KNOBS: dict[str, Any] = {
    "kinematics": "affine",
    "material.units": {
        "density": f"{DENSITY} kg/m^3",
        "young_modulus": f"{YOUNG} Pa",
        "poisson_ratio": POISSON,
    },
    "gravity": None,
    "settle": None,
}


def by_hand(gradient: np.ndarray) -> tuple[np.ndarray, float]:
    """Cauchy's stress (3, 3) Pa and the energy (J) of the brick at a deformation gradient."""
    mu, lame = YOUNG / (2.0 * (1.0 + POISSON)), YOUNG * POISSON / ((1.0 + POISSON) * (1.0 - 2.0 * POISSON))
    strain = 0.5 * (gradient.T @ gradient - np.eye(3))
    second = lame * np.trace(strain) * np.eye(3) + 2.0 * mu * strain
    stress = gradient @ second @ gradient.T / np.linalg.det(gradient)
    return stress, float(0.5 * np.sum(second * strain) * np.prod(SIZE))


def quarter(axis: int) -> np.ndarray:
    """A rotation by 90 degrees about x, y or z."""
    i, j = (axis + 1) % 3, (axis + 2) % 3
    values = np.zeros((3, 3))
    values[axis, axis] = values[j, i] = 1.0
    values[i, j] = -1.0
    return values


def put_there(findings: Findings) -> None:
    """Stress and energy of the stretched brick, as it lies and turned about each axis."""
    model = assembled(SCENE, KNOBS).model
    body = model.bodies.affine
    off, apart = [], []
    for rotation in (np.eye(3), *map(quarter, range(3))):
        gradient = rotation @ STRETCH
        body.q[0, 3:], body.frame[0] = (gradient - np.eye(3)).ravel(), gradient
        seen, (stress, stored) = energy.observe(model), by_hand(gradient)
        rows = np.array([stress[i, j] for i, j in ORDER])
        off.append(np.abs(seen.stress[0] - rows).max() / np.abs(stress).max())
        apart.append(seen.elastic_blocks / stored - 1.0)
    tolerance = Tolerance(1e-12, 1e-13, "products of matrices")
    findings.check("stress, as it lies and turned about x, y and z", "1", max(off), 0.0, tolerance, scale=1.0)
    findings.check("energy, in the same places", "1", np.abs(apart).max(), 0.0, tolerance, scale=1.0)


def spinning(findings: Findings) -> None:
    """The brick spins by more than 90 degrees about z, let go unstretched: it swings about the stretch of the spin."""
    knobs = {
        **KNOBS,
        "motion": [{"on": "block", "spin": [0, 0, f"{RATE} rad/s"]}],
        "solver.time_step": "1e-5 s",
        "solver.duration": "0.2 s",
        "solver.rows": 4000,
    }
    rows = findings.note("spinning", result_of(SCENE, knobs)).history.rows
    energy = rows["kinetic"] + rows["elastic_blocks"]
    drift = float(np.ptp(energy[1:]) / energy[1])
    tolerance = Tolerance(4e-7, 5e-8, "the step is of second order in the frequency of the swing")
    findings.check("energy of its motion and of its stress", "1", drift, 0.0, tolerance, scale=1.0)
    reason = "it is stretched"
    findings.at_most("less than the stretch of the spin stores", "J", 0.0, rows["elastic_blocks"].max(), reason)


def run() -> Findings:
    """Put there, and spinning."""
    findings = Findings()
    put_there(findings)
    spinning(findings)
    return findings


CASE = Case(
    name="stressed-block-turned-by-90-degrees",
    row="A22",
    title="A block under stress that is turned",
    area="Invariance",
    run=run,
    scene=SCENE,
    no_problems="turns change nothing, whatever the step",
)

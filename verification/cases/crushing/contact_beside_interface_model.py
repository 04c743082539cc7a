"""One contact on random paths through cap, Coulomb line and tension, beside the joint of the interface model.

    tau |  Coulomb .'   cap            every leg of a path goes straight to a random slip and opening
        |       .' '.                  cap: closing and slip of its flow; Coulomb: slip alone; both at the corner
        |    .'      '.
        |__.'__________'.___ compression

Both integrate backward, the program by a share of the stress (compression_cap.py), the interface model by a multiplier
(interface/crushing.py), written apart. Where nothing is lost in shear they are one, at any step. Where
cohesion goes, the program's cap sees what is lost in a step in the next one: a difference of the order of the step.

Reference: the interface model, which shares no code with the program.
"""

from typing import Any

import numpy as np

from verification.case import Case, Findings, Tolerance
from verification.checks.crushed_contact import CAP, CUT_OFF, FM, of_interface_model, ours, theirs
from verification.fixtures.one_contact import walk
from verification.references.interface.crushing import Compression

PATHS, CORNERS, KEPT = 40, 5, 10
FAR, DEEP, OPEN = 180e-6, 250e-6, 20e-6
WHOLE: dict[str, Any] = {"c_res": 0.35e6, "tan_res": 0.75, "combined": False}
"""Nothing is lost in shear."""
STEPS = (20, 40, 80)


def corners() -> np.ndarray:
    """(PATHS, CORNERS + 1, 3) m from rest: slips to all sides, two thirds of them pressed."""
    points = np.random.default_rng(1).uniform(-1.0, 1.0, (PATHS, CORNERS, 3))
    points[:, :, :2] *= FAR
    points[:, :, 2] = np.where(points[:, :, 2] > 0.6, OPEN * points[:, :, 2], -DEEP * np.abs(points[:, :, 2]))
    return np.concatenate([np.zeros((PATHS, 1, 3)), points], axis=1)


def through(points: np.ndarray, steps: int) -> np.ndarray:
    """(N, PATHS, 3) m, `steps` a leg."""
    part = (np.arange(1, steps + 1) / steps)[:, None, None]
    return np.concatenate([a + part * (b - a) for a, b in zip(points[:-1], points[1:], strict=True)])


def apart(compression: Compression, steps: int, **changes: Any) -> np.ndarray:
    """(PATHS,) the largest difference of the stresses at some places of each path, over the strength."""
    path = through(corners().swapaxes(0, 1), steps)
    law, every = ours(compression, **changes), slice(steps // KEPT - 1, None, steps // KEPT)
    one = np.stack([walk(law, each).stress for each in path.swapaxes(0, 1)], axis=1)[every]
    other = of_interface_model(theirs(compression, **changes), path)[every]
    return np.asarray(np.abs(one - other).max(axis=(0, 2)) / FM)


def run() -> Findings:
    """Without softening at one step, with it as the steps are halved."""
    findings = Findings()
    for words, compression in (("cap", CAP), ("cut-off", CUT_OFF)):
        tolerance = Tolerance(
            1e-8, 1e-9, "one scheme, two programs: what the roots are found to", "same discretisation"
        )
        quantity = f"{words}, nothing is lost in shear: stresses, largest difference"
        findings.check(quantity, "1", apart(compression, STEPS[0], **WHOLE).max(), 0.0, tolerance, scale=1.0)
    off = np.array([np.median(apart(CAP, steps)) for steps in STEPS])
    tolerance = Tolerance(0.2, 0.06, "of first order, and a corner more or less", "same discretisation")
    findings.check("cap, all softens: median difference, halved with the step", "1", off[-1] / off[-2], 0.5, tolerance)
    tolerance = Tolerance(2e-4, 7e-5, "of first order in the step", "same discretisation")
    findings.check("cap, all softens: median difference with 80 steps a leg", "1", off[-1], 0.0, tolerance, scale=1.0)
    return findings


CASE = Case(
    "contact-crushed-beside-interface-model",
    "A72",
    "One contact on random paths, crushed, beside the interface model",
    area="Contact laws",
    run=run,
    no_problems="one contact point: its error goes with the step, as is checked",
)

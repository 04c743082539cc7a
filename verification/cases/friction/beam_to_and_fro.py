"""A force goes to and fro on a beam with two dry feet, of which one slides: the loops of Masing.

         ____________________
    F <-|____________________|-> F       N1 = W/3, N2 = 2 W/3; both feet have the stiffness k along the joint
           |__| N1    |__| N2

The left foot slides at R = mu N1, that is at F = 2 R; behind that the right one alone gives way. From 0 to F the beam
goes by (F - R)/k and the foot slides by s = (F - 2 R)/k. From then on each half loop takes twice the force on twice the
way (Masing 1926): the beam goes by 2 (F - R)/k, the foot slides by 2 s and dissipates 2 R s. The first cycle, from rest
at 0, dissipates R s + 2 R s.
"""

import numpy as np

from verification.case import Case, Findings, Line, Tolerance
from verification.scene_runs import result_of

SCENE = "beam-to-and-fro"
FORCE = 440.0
SLIDES = 0.5 * 2000.0 * 9.81 * 1.2 * 0.2 * 0.2 / 3.0
"""N, what the left foot bears along the joint."""
FOOT = 40e9 * 0.02 * 0.2
"""N/m, stiffness of a foot."""
ACCURACIES = (0.02, 0.01, 0.005)
WHY = "the beam leans, as its feet bear unlike loads, so the edges of a foot slide one after the other"


def slip(force: float) -> float:
    """m, by how much the left foot slides as the force goes from 0 to so much for the first time."""
    return max(force - 2.0 * SLIDES, 0.0) / FOOT


def run() -> Findings:
    """Energies of both cycles and the way of the beam, to three accuracies."""
    findings, once = Findings(), SLIDES * slip(FORCE)
    for accuracy in ACCURACIES:
        result = findings.note(f"to {100 * accuracy:g} %", result_of(SCENE, {"limit.accuracy": accuracy}))
        first, second = result.summary["cycles"]
        bound = f"to {100 * accuracy:g} %"
        for name, cycle, wanted in (("first", first, 3.0 * once), ("second", second, 4.0 * once)):
            tolerance = Tolerance(1e-3, 6e-4, WHY)
            findings.check(f"dissipated in the {name} cycle, {bound}", "J", cycle["dissipated_j"], wanted, tolerance)
        tolerance = Tolerance(1e-3, 1e-4, WHY)
        value = second["farthest_m"] - second["farthest_back_m"]
        findings.check(f"way of the beam, {bound}", "m", value, 2.0 * (FORCE - SLIDES) / FOOT, tolerance)
        value = result.summary["damping_over_external"]
        findings.at_most(f"work that damping took, {bound}", "1", value, accuracy, "rests follow on each other slowly")
    rows = result.history.rows
    reading = 1e6 * (rows["beam"] - rows["beam"][int(np.flatnonzero(rows["load_factor"])[0]) - 1])
    turns = np.array([0.0, 2.0 * SLIDES, FORCE])
    travel = 1e6 * np.array([0.0, SLIDES / FOOT, (FORCE - SLIDES) / FOOT])
    back = 1e6 * np.array([0.0, 2.0 * SLIDES / FOOT, 2.0 * (FORCE - SLIDES) / FOOT])
    half = np.array([0.0, 4.0 * SLIDES, 2.0 * FORCE])
    findings.plot(
        "Force on the beam over its way",
        "beam (um)",
        "force (N)",
        Line("masonry", reading, rows["load_factor"], "points"),
        Line("first loading", travel, turns, "dashed"),
        Line("half loop down", travel[-1] - back, FORCE - half, "dashed"),
        Line("half loop up", travel[-1] - back[-1] + back, half - FORCE, "dashed"),
    )
    return findings


CASE = Case(
    name="beam-to-and-fro",
    row="A37",
    title="A force goes to and fro: loops of Masing",
    area="Friction and stability",
    run=run,
    quick=True,
    scene=SCENE,
    no_problems="the accuracies are the study: three of them, each with its error",
)

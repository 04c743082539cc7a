"""A block on ground whose acceleration rises slowly lifts off where its weight and its inertia pass its corner.

    a = g b/h        at 0.99 of it the block has turned by what its joint gives way, at 1.01 it rocks

The pulse is half a sine of 4 s; above the threshold for 0.18 s at 1.01, in which the block turns by 2e-4 rad.

Reference: Housner (1963), Bulletin of the Seismological Society of America 53, 403.
"""

import numpy as np

from verification.case import Case, Findings
from verification.scene_runs import result_of

SCENE = "block-under-a-pulse"
WIDTH, HEIGHT, G, STANDARD = 0.79495, 3.11327, 9.81, 9.80665
ELASTIC = 1e-5
"""rad, of the joint under all of the weight at one edge: W/(kn b^2), about."""


def turn(findings: Findings, share: float) -> float:
    """The largest angle (rad) at a share of g b/h."""
    keys = {
        "ground.x": "1 g * sin(2 pi t / 4 s)",
        "ground.duration": "2 s",
        "ground.scale": share * WIDTH / HEIGHT * G / STANDARD,
        "solver.duration": "2 s",
    }
    rows = findings.note(f"{share:g} g b/h", result_of(SCENE, keys)).history.rows
    return float(np.abs(rows["sway"]).max()) / HEIGHT


def run() -> Findings:
    """Below and above."""
    findings = Findings()
    below, above = turn(findings, 0.99), turn(findings, 1.01)
    findings.at_most("largest angle at 0.99 g b/h", "rad", below, ELASTIC, "the joint gives way and holds")
    findings.at_most("least angle at 1.01 g b/h, as its negative", "rad", -above, -10.0 * ELASTIC, "it has lifted off")
    return findings


CASE = Case(
    "uplift",
    "A49",
    "A block lifts off where the ground accelerates by g b/h",
    area="Dynamics",
    run=run,
    quick=True,
    scene=SCENE,
    no_problems="it lifts off or not",
)

"""An end-notched beam in three-point bending, whose halves slide on each other: its force.

                        | P
                        v                       G_II = 9 P^2 (a + 1/b)^2/(16 B^2 E h^3),  b^2 = 8 ks/(E h)
      __________________________________        C = [2 L^3 + 3 (a + 1/b)^3]/(8 B E h^3)
     |__________________________________| h     tears stably while a > 0.693 L
     |//////|___________________________| h
     ^  a                               ^
     |<-       L      ->|<-     L     ->|

Russell & Street (1982): G of an end-notched flexure specimen. Here the joint that still holds slips elastically, which
makes the crack 1/b longer: s'' = b^2 s + h V/(2 E I) beyond the tip, s' = h kappa at it, G = ks s^2/2 gives just this.
Both halves are rows of rigid blocks whose joints are the bending stiffness (kn = E/d); where the beam is notched they
slide without friction. The strength is artificial, c^2 = 2 ks G/4, so that the process zone is short beside a.
"""

import numpy as np

from verification.case import Case, Findings, Line, Tolerance
from verification.references.closed_forms import Floats
from verification.scene_runs import result_of

MODULUS, HEIGHT, WIDTH, CELL, HALF = 10e9, 0.1, 0.05, 0.01, 0.5
NOTCH = 0.375 + CELL / 2
"""m from the end; the supports are at the middles of the end blocks."""
STIFFNESS, ENERGY = 300e9, 50.0
SLIDE = float(np.sqrt(MODULUS * HEIGHT / (8 * STIFFNESS)))
"""1/b, m"""
SCENE = "enf"


def compliance(a: Floats | float) -> Floats:
    """m/N at a crack length (m)."""
    return np.asarray((2 * HALF**3 + 3 * (a + SLIDE) ** 3) / (8 * WIDTH * MODULUS * HEIGHT**3))


def critical(a: Floats | float) -> Floats:
    """The force (N) that tears."""
    return np.asarray(4 / 3 * WIDTH * np.sqrt(MODULUS * HEIGHT**3 * ENERGY) / (a + SLIDE))


def run() -> Findings:
    """One push, through the first tear and on towards the middle."""
    findings = Findings()
    result = findings.note("push", result_of(SCENE))
    w, force = result.history.rows["displacement"], result.history.rows["stress"] * HEIGHT * WIDTH
    start = NOTCH - CELL / 2
    lengths = np.linspace(start, 0.93 * HALF, 400)
    path, limit = compliance(lengths) * critical(lengths), critical(lengths)
    top = int(np.argmax(force))
    elastic = (w > 0.2 * w[top]) & (w < 0.4 * w[top])
    slope, peak = float(np.polyfit(force[elastic], w[elastic], 1)[0]), float(result.summary["peak_stress_pa"])
    tears = (w > w[top]) & (w < path[-1])
    ratio = force[tears] / np.interp(w[tears], path, limit)
    tolerance = Tolerance(0.03, 0.01, "the halves also shear a little, and press into each other under the load")
    findings.check("compliance", "m/N", slope, compliance(start), tolerance)
    tolerance = Tolerance(
        0.10,
        0.02,
        "the catalogue's band of 10 %: joints that soften ahead of the notch make it a little longer at the peak",
    )
    findings.check("greatest force", "N", peak * HEIGHT * WIDTH, critical(start), tolerance)
    tolerance = Tolerance(
        0.10,
        0.03,
        "the catalogue's band of 10 %: 1 % of the compliance is 2 % of the force at the same displacement, and points "
        "come off one by one",
    )
    findings.check("force while it tears over that of theory, mean", "1", ratio.mean(), 1.0, tolerance)
    lines = (Line("masonry", w, force), Line("theory", path, limit, "dashed"))
    findings.plot("End-notched beam", "w (m)", "P (N)", *lines)
    return findings


CASE = Case(
    name="enf",
    row="A11",
    title="End-notched beam in bending",
    area="Fracture",
    run=run,
    scene=SCENE,
    problems=("enf",),
)

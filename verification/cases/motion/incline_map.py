"""A block on a plane that leans: it stays, slides, topples, or does both, by friction, slenderness and slope.

           __
          |  |                stays        tan(psi) < mu, b/h
          |  | h              slides       mu < b/h, tan(psi)
        __|__|__              topples      b/h < tan(psi), mu > mu_c
       psi  b   plane         both         b/h < mu < mu_c(psi, b/h)

60 points, none nearer to a border than 4 %. Where it slides, friction dissipates; where it topples, it turns.

Reference: mechanics; for sliding and toppling at once see `verification.fixtures.dry_blocks.fate`.
"""

from itertools import product

import numpy as np

from verification.case import Case, Findings
from verification.fixtures.dry_blocks import DENSITY, G, block, fate, leaning
from verification.scene_runs import result_of

SCENE = "dry-block"
SLOPES, HALVES, HIGH = (14.0, 16.0, 18.0, 32.0, 54.0), (0.02, 0.03, 0.04, 0.07), 0.13
FRICTIONS = (0.17, 0.35, 0.6)
ROTATED, SLID, TIME = 1e-3, 1e-4, 0.1
"""rad, and m of slip under the weight: more is toppling, and sliding; within s, as the formulas are for small turns."""


def run() -> Findings:
    """The fate of every block against that of the formulas."""
    findings, wrong, seen = Findings(), [], set()
    for slope, half, friction in product(SLOPES, HALVES, FRICTIONS):
        knobs = {
            "specimen.box": block(half, HIGH),
            "contact.unit_unit.tan_friction_angle": friction,
            "solver.duration": f"{TIME} s",
            **leaning(slope),
        }
        result = result_of(SCENE, knobs)
        rows = result.history.rows
        weight = DENSITY * G * 4.0 * half * HIGH * 0.2
        slid = rows["friction"][-1] > SLID * friction * weight * np.cos(np.radians(slope))
        toppled = result.summary["rotation_max_rad"] > ROTATED
        wanted = fate(half, HIGH, friction, slope)
        seen.add(wanted)
        if (bool(slid), bool(toppled)) != wanted:
            wrong.append(f"{slope:g} deg, b/h {half / HIGH:.3g}, mu {friction:g}")
    if wrong:
        findings.remarks.append("other than the formulas say: " + "; ".join(wrong))
    findings.at_most("blocks of another fate, of 60", "1", len(wrong), 0, "each is clear of all borders")
    findings.at_most("kinds of fate that were not met", "1", 4 - len(seen), 0, "the map has all four")
    return findings


CASE = Case(
    name="incline-map",
    row="A29",
    title="A block on a plane: it stays, slides, topples, or both",
    area="Friction and stability",
    run=run,
    scene=SCENE,
    problems=("slide",),
)

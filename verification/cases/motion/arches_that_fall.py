"""Dry arches between standing and falling: the least thickness, the greatest tilt, the greatest spread.

       .-"-.         16 voussoirs, semicircle, own weight: stands from t/R = 0.10708 (mean radius, straight edges)
     /       \\       7 voussoirs, 157.5 degrees, t/R = 0.15, tilted: stands up to tan = 0.37361
    |         |      20 voussoirs, semicircle, t/R = 0.12, one support drawn away: up to s/R = 0.0337 in all, while
                     the thrust grows from 0.07179 to 0.07809 of unit weight and R

Each is run just on either side of its limit: it stands on the one, and falls on the other.

References: Milankovitch (1907) and limit analysis of 16 blocks; Oppenheim (1992), Earthquake Engineering and Structural
Dynamics 21, 1005; Ochsendorf (2002), thesis, MIT.
"""

from math import atan, degrees

import numpy as np

from verification.case import Case, Findings, Tolerance
from verification.scene_runs import Settings, result_of

THINNEST, TILT, SPREAD = 0.10708, 0.37361, 0.0337
THRUST = 0.07179, 0.07809
MARGIN = 0.01


def by_thickness() -> Findings:
    """Under own weight at 1 % less and more than the least thickness."""
    findings = Findings()
    for factor in (1.0 - MARGIN, 1.0 + MARGIN):
        knobs = {
            "specimen.angle": "180 deg",
            "specimen.voussoirs": 16,
            "specimen.thickness": f"{THINNEST * factor!r} m",
            "gravity.tilt": None,
            "curve": None,
            "settle.steps": 60000,
            "solver.duration": "4 s",
        }
        fell(findings, f"t/R = {THINNEST * factor:.5f}", "arch-tilted", knobs, factor < 1.0)
    return findings


def by_tilt() -> Findings:
    """Tilted to 1 % less and more than the greatest tilt, and left there."""
    findings = Findings()
    for factor in (1.0 - MARGIN, 1.0 + MARGIN):
        angle = degrees(atan(TILT * factor))
        knobs = {"gravity.tilt.angle": f"{angle!r} deg", "gravity.tilt.duration": "10 s", "solver.duration": "13 s"}
        fell(findings, f"tan = {TILT * factor:.5f}", "arch-tilted", knobs, factor > 1.0)
    return findings


def fell(findings: Findings, name: str, scene: str, knobs: Settings, wanted: bool) -> None:
    """Run an arch, and hold whether it has fallen."""
    result = findings.note(name, result_of(scene, knobs))
    has = result.summary["collapse"] is not None
    reason = f"it {'falls' if wanted else 'stands'} on this side of the limit"
    findings.at_most(f"{name}: {'stands' if wanted else 'falls'}", "1", has != wanted, 0.0, reason)


def by_spread() -> Findings:
    """The packaged scene: thrust before and at the fall, and the spread then."""
    findings = Findings()
    result = findings.note("spreading", result_of("arch-spreading"))
    fallen, rows = result.summary["collapse"], result.history.rows
    began = abs(fallen["began"]["displacement_m"])
    tolerance = Tolerance(
        0.05, 0.015, "its last hinge opens slowly, and joints give way by a share of 1e-5", "limit analysis"
    )
    findings.check("spread at which it begins to fall, over R", "1", began, SPREAD, tolerance)
    weight = 2000.0 * 9.81 * 0.3  # of a unit of area
    thrust = -rows["force"] / weight
    travel = np.abs(rows["displacement"])
    opened = (travel > 0.1 * SPREAD) & (travel < 0.2 * SPREAD)
    first = float(np.mean(np.abs(thrust[opened])))
    tolerance = Tolerance(0.02, 0.01, "between 0.1 and 0.2 of the way", "limit analysis")
    quantity = "thrust once the hinges are there"
    findings.check(quantity, "1", first, THRUST[0] + 0.15 * (THRUST[1] - THRUST[0]), tolerance)
    return findings


CASES = tuple(
    Case(
        name=name,
        row="A34",
        title=title,
        area="Friction and stability",
        run=run,
        scene=scene,
        no_problems="it stands or it falls",
    )
    for name, title, run, scene in (
        ("arch-by-thickness", "The thinnest arch that stands", by_thickness, "arch-tilted"),
        ("arch-by-tilt", "An arch that is tilted until it falls", by_tilt, "arch-tilted"),
        ("arch-by-spread", "An arch on supports that spread", by_spread, "arch-spreading"),
    )
)

"""A triplet of rigid units: the middle one is pushed, and both joints resist.

       s s s s s s
      |___________|        F = 2 A tau(u),  tau as of one joint under s
      |___________| -> F   (the upper unit may rise but not slide or turn, the lower one is held)
      |___________|
       ///////////

Reference: eqs (8), (17) of the paper; statics.
"""

import numpy as np

from verification.balance import dissipated
from verification.case import Case, Findings, Line, Tolerance
from verification.fixtures.single_shear import around_the_peak
from verification.references.closed_forms import Joint, dissipated_in_shear, shear
from verification.scene_runs import result_of

AREA, S, LAST = 0.2 * 0.05, 0.5e6, 1e-3
SCENE = "triplet-of-rigid-units"


NEAR = 1e-3
"""Share of the peak within which it counts as reached, on the elastic way up to it."""


def at_every_step(findings: Findings) -> None:
    """A short run with few rows finds the peak of the same run with a row at every step, and its displacement."""
    short = {"settle.steps": 2000, "drive.displacement": "0.03 mm", "drive.steps": 2000}
    rows = findings.note("triplet, a row a step", result_of(SCENE, short | {"solver.rows": 4000})).history.rows
    few = findings.note("triplet, few rows", result_of(SCENE, short | {"solver.rows": 20})).summary
    highest = int(np.argmax(rows["stress"]))
    near = int(np.argmax(rows["stress"] >= (1.0 - NEAR) * rows["stress"].max()))
    for name, key, unit, column, row in (
        ("peak stress", "peak_stress_pa", "Pa", "stress", highest),
        ("displacement at the peak", "displacement_at_peak_m", "m", "displacement", near),
    ):
        tolerance = Tolerance(1e-12, 1e-13, "the same step: rounding of sums")
        findings.check(f"{name}, of the row that has it", unit, few[key], rows[column][row], tolerance)


def run() -> Findings:
    """Force on the middle unit, and what both joints dissipate."""
    findings, joint = Findings(), Joint()
    result = findings.note("triplet", result_of(SCENE))
    rows = result.history.rows
    moved = rows["displacement"] > 0.0
    slip, force = rows["displacement"][moved], AREA * rows["stress"][moved]
    wanted = 2 * AREA * shear("exponential", joint, slip, S)
    peak = 2 * AREA * float(joint.peak(S))
    dissipated_energy = dissipated(result.summary)
    gone = 2 * AREA * float(dissipated_in_shear("exponential", joint, slip[-1], S))
    missed, rough = around_the_peak("exponential", joint, S, rows)
    rough *= 2 * AREA / gone
    at = (1.0 - NEAR) * float(joint.peak(S)) / joint.ks
    k = int(np.searchsorted(slip, at))
    step = float((slip[k] - slip[k - 1]) / (rows["step"][moved][k] - rows["step"][moved][k - 1]))
    tolerance = Tolerance(missed, 0.5 * missed, "the step that misses the peak, at most du k_s q/(k_s + q)")
    findings.check("peak force", "N", AREA * result.summary["peak_stress_pa"], peak, tolerance)
    tolerance = Tolerance(1e-12, 1e-13, "what the settled confinement still swings by, and rounding")
    value = np.abs(force - wanted).max()
    findings.check("force at every slip, largest deviation", "N", value, 0.0, tolerance, scale=peak)
    tolerance = Tolerance(1e-12, 1e-13, "nothing that could hold back a force moves along x: rounding")
    quantity = "force of the supports at every slip, largest deviation from that of the drive"
    findings.check(
        quantity, "N", AREA * np.abs(rows["support_stress"] - rows["stress"])[moved].max(), 0.0, tolerance, scale=peak
    )
    tolerance = Tolerance(step / at, 0.5 * step / at, "the step in which the force comes within 0.1 % of the peak")
    findings.check("displacement at the peak", "m", result.summary["displacement_at_peak_m"], at, tolerance)
    tolerance = Tolerance(1e-12, 1e-13, "what the scene asks for; a sum of 20,000 steps: rounding")
    findings.check("displacement at the end", "m", slip[-1], LAST, tolerance)
    tolerance = Tolerance(
        3 * rough, rough, "the trapezoid: of the envelope, and of the corner at the peak that no step hits"
    )
    findings.check("dissipated by both joints", "J", dissipated_energy, gone, tolerance)
    at_every_step(findings)
    some = slice(None, None, 20)
    lines = (
        Line("triplet", 1e3 * slip, 1e-3 * force),
        Line("2 A tau", 1e3 * slip[some], 1e-3 * wanted[some], "points"),
    )
    findings.plot("Triplet under 0.5 MPa", "slip (mm)", "force (kN)", *lines)
    return findings


CASE = Case(
    "triplet",
    "A8",
    "Triplet of rigid units",
    area="Contact laws",
    run=run,
    quick=True,
    scene=SCENE,
    problems=("triplet",),
)

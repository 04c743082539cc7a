"""One joint of two rigid blocks that is opened, closed, pressed and opened again by the solver.

    stress   .   envelope              path 0, 20, 0, -8, 0, 20, 40 um
            /| \\
           / |  \\___ 40 um             secant:   back along t/kappa to 0, all of k_n below
          / /                          elastic:  back along k_n, an opening stays
     ____/_/________ u
        /                              dissipated: W(kappa) less what the way back returns

Each place is a turning point of the drive; rest at each of them, and all that moves is prescribed.

Reference: eqs (12), (14), (16) of the paper for the envelopes, straight lines between.
"""

import numpy as np

from verification.case import Case, Findings, Line, Tolerance
from verification.fixtures.single_tension import CYCLE
from verification.references.closed_forms import Joint, dissipated_in_tension, unloaded
from verification.scene_runs import result_of

LAWS = ("linear", "polynomial", "exponential")
JOINT, AREA = Joint(), 0.2 * 0.05
KEYS = {
    "confinement": "0 Pa",
    "settle.steps": 1,
    "specimen.points_per_edge": 1,
    "support.1.fix": ["x", "y", "rotation"],
    "drive.direction": "z",
    "drive.history": [f"{float(place)!r} m" for place in CYCLE[1:]],
}


def cycled(findings: Findings, law: str, unloading: str) -> None:
    """One run beside its closed form."""
    of = f"{law}, {unloading}"
    keys = {**KEYS, "law": law, "contact.unit_unit.unloading": unloading}
    result = findings.note(of, result_of("couplet", keys))
    rows = result.history.rows
    place, widest = rows["displacement"], np.maximum.accumulate(rows["displacement"])
    wanted = np.array([float(unloaded(law, JOINT, x, w, unloading)) for x, w in zip(place, widest, strict=True)])
    gone = AREA * float(dissipated_in_tension(law, JOINT, float(widest[-1]), unloading))
    booked = Tolerance(1e-12, 1e-14, "differences of the area under the envelope: rounding")
    if unloading == "elastic" and law != "linear":
        booked = Tolerance(1e-5, 2e-6, "the opening that stays is booked by the trapezoid: second order in the step")
    tolerance = Tolerance(1e-12, 2e-14, "the law sees every turn, and each place to the last bits: rounding")
    value = np.abs(rows["stress"] - wanted).max()
    findings.check(f"curve, {of}, largest deviation", "Pa", value, 0.0, tolerance, scale=JOINT.fT)
    findings.check(f"dissipated, {of}", "J", rows["fracture_mode_1"][-1], gone, booked)
    findings.plot(f"Joint, {of}", "opening (um)", "normal stress (MPa)", Line(of, 1e6 * place, 1e-6 * rows["stress"]))


def run() -> Findings:
    """Three laws, and both ways to unload."""
    findings = Findings()
    for law in LAWS:
        for unloading in ("secant", "elastic"):
            cycled(findings, law, unloading)
    return findings


CASE = Case(
    "joint-that-closes",
    "2.1",
    "Joint opened, pressed and opened again by the solver",
    area="Contact laws",
    run=run,
    no_problems="the drive prescribes all that moves: exact at any setting",
)

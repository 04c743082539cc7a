"""The couplet of the paper with rigid units: shear stress against slip in closed form.

         s  s  s  s  s
       __v__v__v__v__v__          tau = k_s u up to tau_m = c0 + s tan0, then the law's envelope down to tau_r
      |     unit        | -> u    three laws, three confinements, Table 1; beta of the polynomial law by confinement
      |_________________|         dissipated: A (area under tau(u) - tau^2/(2 k_s))
      |     unit        |
      |_________________|         The upper unit may not turn, so the normal stress is uniform.
       /////////////////

A rigid unit is where the drive puts it, so tau is the law's own at that slip. The peak is looked for at every step and
missed by less than one: with slopes k_s up and q down, by du k_s q/(k_s + q) at most.

Reference: eqs (8), (13), (15), (17) of the paper.
"""

import numpy as np

from verification.balance import dissipated
from verification.case import Case, Findings, Line, Tolerance
from verification.fixtures.single_shear import around_the_peak
from verification.references.closed_forms import Joint, dissipated_in_shear, shear
from verification.scene_runs import result_of

LAWS = ("linear", "polynomial", "exponential")
BETA = {0.1: 2.1, 0.5: 2.1 + 0.8 * 4 / 9, 1.0: 2.9}
STEPS, AREA = 20000, 0.2 * 0.05


def sheared(findings: Findings, law: str, mpa: float) -> tuple[Line, Line]:
    """One run, its checks, and the curves for the plot."""
    words = f"{law}, {mpa:g} MPa"
    joint, s = Joint(beta=BETA[mpa]), 1e6 * mpa
    keys = {"law": law, "confinement": f"{mpa} MPa", "drive.steps": STEPS, "solver.rows": 600}
    result = findings.note(words, result_of("couplet", keys))
    rows = result.history.rows
    moved = rows["displacement"] > 0.0
    slip, stress = rows["displacement"][moved], rows["stress"][moved]
    wanted, peak = shear(law, joint, slip, s), joint.c0 + s * joint.tan0
    missed, rough = around_the_peak(law, joint, s, rows)
    dissipated_energy = dissipated(result.summary)
    gone = AREA * float(dissipated_in_shear(law, joint, slip[-1], s))
    rough *= AREA / gone
    tolerance = Tolerance(missed, 0.5 * missed, "the step that misses the peak, at most du k_s q/(k_s + q)")
    findings.check(f"peak, {words}", "Pa", result.summary["peak_stress_pa"], peak, tolerance)
    tolerance = Tolerance(1e-12, 1e-13, "what the settled confinement still swings by, and rounding")
    value = np.abs(stress - wanted).max()
    findings.check(f"curve, {words}, largest deviation", "Pa", value, 0.0, tolerance, scale=peak)
    findings.check(f"residual, {words}", "Pa", stress[-1], wanted[-1], tolerance)
    tolerance = Tolerance(
        3 * rough, rough, "the trapezoid: of the envelope, and of the corner at the peak that no step hits"
    )
    findings.check(f"dissipated, {words}", "J", dissipated_energy, gone, tolerance)
    some = slice(None, None, 20)
    return (
        Line(words, 1e3 * slip, 1e-6 * stress),
        Line(f"closed form, {mpa:g} MPa", 1e3 * slip[some], 1e-6 * wanted[some], "points"),
    )


def run() -> Findings:
    """Three laws at three confinements."""
    findings = Findings()
    for law in LAWS:
        lines = [line for mpa in BETA for line in sheared(findings, law, mpa)]
        findings.plot(f"Couplet, {law} law", "slip (mm)", "shear stress (MPa)", *lines)
    return findings


CASE = Case(
    "couplet",
    "A8",
    "Couplet of the paper, rigid units",
    area="Contact laws",
    run=run,
    quick=True,
    scene="couplet",
    problems=(
        "couplet",
        "couplet-exponential-01",
        "couplet-exponential-10",
        "couplet-linear-05",
        "couplet-polynomial-05",
    ),
)

"""The couplet sheared back and forth with the other laws, and with the path of plastic slip as softening variable.

    softening by displacement:  on along the envelope by the way made while it slides (see couplet-back-and-forth)
    softening by plastic slip:  tau = tau(r), r = path slid either way; each way back softens from its first slip on

Reference: by hand from eqs (8), (13), (15), (17) of the paper (verification/references/cyclic_forms.py).
"""

from verification.case import Case, Findings, Tolerance
from verification.cases.fracture.couplet_back_and_forth import ROUNDING
from verification.fixtures.sheared_in_cycles import cycled


def run() -> Findings:
    """Two laws by displacement, one by plastic slip."""
    findings = Findings()
    for law in ("linear", "polynomial"):
        cycled(findings, law, "displacement", ROUNDING)
    curve = "the plastic slip of a step is found by secants: what they leave"
    energy = "booked by the trapezoid: second order in steps of up to 1 um"
    cycled(findings, "exponential", "plastic", Tolerance(1e-10, 1e-11, curve), Tolerance(1e-6, 1e-7, energy))
    return findings


CASE = Case(
    "couplet-back-and-forth-by-law",
    "A8",
    "Couplet sheared back and forth, other laws and softening by plastic slip",
    area="Contact laws",
    run=run,
    no_problems="the drive prescribes all that moves; the step of plastic slip follows from the accuracy",
)

"""The couplet of the paper with rigid units, sheared back and forth under constant confinement.

    tau      /\\
            /  \\___                 out:   k_s u, then the envelope
       ____/___/___\\___ u           back:  slope k_s down to minus the strength left, on along the mirrored
          /   /                             envelope from where it was left
     ____/___/                      a cycle dissipates its area

The strength falls along the envelope with all that the joint slips, either way; on the elastic ways between it stays.
So mode II takes no more than the area above the residual. Amplitudes 0.1, 0.2 and 0.4 mm.

Reference: by hand from eqs (8) and (17) of the paper (verification/references/cyclic_forms.py).
"""

from verification.case import Case, Findings, Tolerance
from verification.fixtures.sheared_in_cycles import cycled

ROUNDING = Tolerance(1e-12, 1e-14, "a rigid unit is where the drive puts it, and the law sees every turn: rounding")


def run() -> Findings:
    """The scene as shipped."""
    findings = Findings()
    cycled(findings, "exponential", "displacement", ROUNDING)
    return findings


CASE = Case(
    "couplet-back-and-forth",
    "A8",
    "Couplet of the paper sheared back and forth",
    area="Contact laws",
    run=run,
    quick=True,
    scene="couplet-cyclic",
    no_problems="the drive prescribes all that moves: exact at any setting",
)

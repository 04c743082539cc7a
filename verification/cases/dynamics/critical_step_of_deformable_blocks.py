"""The largest stable step of affine blocks and of tets.

    leapfrog     bounded up to dt = 2/w_max; beyond, the fastest mode grows by exp(2 acosh(w dt/2)) a step
    damping      2/(w_max sqrt(1 + xi))

w_max from the eigenvalues of a stiffness that is assembled apart from the program (`assembled.py`): springs at the
contact points, one strain in each affine block and in each tet.

Reference: leapfrog, by hand; ARPACK.
"""

from verification.case import Case, Findings
from verification.checks import critical


def run() -> Findings:
    """A stack on a held rigid block, of each kind."""
    found = Findings()
    for kind in ("affine", "tets"):
        critical.study(found, ["rigid", kind, kind], kind)
    return found


CASE = Case(
    "critical-step-of-deformable-blocks",
    "A20",
    "The largest stable step of affine blocks and tets",
    area="Dynamics",
    run=run,
    no_ladders="the limit of the step itself: what a shorter one costs is a knob of most ladders",
)

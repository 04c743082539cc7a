"""One contact in shear under constant compression s, brittle: up to tau_m with k_s, then tau_r at once.

    tau                     tau_m = c0 + s tan0    tau_r = cres + s tanr    d = tau_m - tau_r
    tau_m .  /|
            / |_________
           /            u

The drop costs what the spring held above tau_r less the friction over the slip that it makes at once: d^2/(2 k_s).
It falls into one step du, and costs d du/2 more there.

Reference: eqs (7), (8) of the paper.
"""

from verification.case import Case, Check, Findings
from verification.fixtures.single_shear import COMPRESSIONS, STEP, envelope, slid
from verification.references.closed_forms import Joint

JOINT = Joint()
LAST = 0.1e-3


def run() -> Findings:
    """Envelope, and the energy of the drop."""
    found = Findings()
    envelope(found, "brittle", JOINT)
    for s in COMPRESSIONS:
        top, rest = JOINT.c0 + s * JOINT.tan0, s * JOINT.tan_res
        us0 = top / JOINT.ks
        walked = slid("brittle", s, us0, LAST)
        du = (LAST - us0) / -(-(LAST - us0) // STEP)
        wanted = (top - rest) ** 2 / (2 * JOINT.ks) + rest * (LAST - rest / JOINT.ks) + 0.5 * (top - rest) * du
        found.checks.append(
            Check(f"dissipated at 0.1 mm at {s / 1e6:g} MPa", "J/m2", float(walked.dissipated[-1]), wanted,
                  "closed form", 1e-12, 1e-14, "the drop in one step is exact with its d du/2: rounding of 1000 sums")
        )  # fmt: skip
    return found


CASE = Case(
    "shear-brittle",
    "2.2",
    "One contact in shear, brittle",
    area="Contact laws",
    run=run,
    ladders=("couplet",),
)

"""One contact in shear under constant compression s, linear law.

    tau                              tau_m = c0 + s tan0       tau_r = cres + s tanr      d = tau_m - tau_r
    tau_m . /\\                      u_p = tau_m/k_s
           /   \\                    u_l = 2 G_II/d + tau_r/k_s
    tau_r . /  G  \\_________        tau falls straight from (u_p, tau_m) to (u_l, tau_r), then stays
          /                 u

The area above tau_r, elastic part included, is G_II exactly; dissipated at U >= u_l: G_II + tau_r (U - tau_r/k_s).
Brittle limit: G_II > d^2/(2 k_s), refused below; where a compression brings a contact there while it runs, it drops to
tau_r and never gains strength.

Reference: eq. (13) of the paper; areas by hand.
"""

from verification.case import Case, Check, Findings
from verification.fixtures.single_shear import energies, envelope, slid
from verification.fixtures.single_tension import least_accepted
from verification.references.closed_forms import Joint

JOINT = Joint()


def run() -> Findings:
    """Envelope, energies, the least energy accepted, and a compression beyond the brittle limit."""
    found = Findings()
    envelope(found, "linear", JOINT)
    energies(found, "linear", JOINT, lambda s: JOINT.G_II + JOINT.G_II_slope * s)
    least = JOINT.c0**2 / (2 * JOINT.ks)
    given = least_accepted("linear", "fracture_energy_mode_2", 580.0, fracture_energy_mode_2_slope=0.0)
    found.checks.append(
        Check("least energy that is accepted", "N/m", given, least, "closed form", 1e-13, 1e-15,
              "bisection of a comparison: rounding")
    )  # fmt: skip
    compression, limit = 20e6, {"fracture_energy_mode_2": 1.01 * least, "fracture_energy_mode_2_slope": 0.0}
    top = JOINT.c0 + compression * JOINT.tan0
    beyond = slid("linear", compression, top / JOINT.ks, 2e-3, most=1e-6, **limit)
    found.checks += [
        Check("largest stress beyond the brittle limit", "Pa", float(beyond.tau.max()), top, "closed form", 1e-12,
              1e-14, "strength never grows: rounding"),
        Check("stress after the drop", "Pa", float(beyond.tau[-1]), compression * JOINT.tan_res, "closed form", 1e-12,
              1e-14, "the residual friction: rounding"),
    ]  # fmt: skip
    return found


CASE = Case(
    "shear-linear",
    "2.2",
    "One contact in shear, linear law",
    area="Contact laws",
    run=run,
    quick=True,
    ladders=("couplet-linear-05", "triplet"),
)

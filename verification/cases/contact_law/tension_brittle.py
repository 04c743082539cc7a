"""One contact in tension, brittle: up to f_T with k_n, then nothing.

    t(u) = k_n u up to u0 = f_T/k_n, 0 beyond

What it costs is the elastic triangle f_T^2/(2 k_n), however long the step. The drop falls into one step du, so the
trapezoid of the work adds f_T du/2 at most. Closing gives k_n in compression.

Reference: eq. (7) of the paper.
"""

from verification.case import Case, Check, Findings
from verification.fixtures.single_tension import UM, cycle, envelope, opened
from verification.references.closed_forms import Joint

JOINT = Joint()


def run() -> Findings:
    """Envelope, the energy of a break, and the cycle."""
    found = Findings()
    envelope(found, "brittle", JOINT)
    cycle(found, "brittle", JOINT)
    triangle = JOINT.fT**2 / (2 * JOINT.kn)
    for most in (1.0 * UM, 0.01 * UM):
        broken = opened("brittle", JOINT.opening_at_peak, 5 * UM, most=most)
        rest = (5 * UM - JOINT.opening_at_peak) / -(-(5 * UM - JOINT.opening_at_peak) // most)
        found.checks += [
            Check(f"energy of a break, steps of {1e6 * most:g} um", "J/m2", float(broken.dissipated[-1]), triangle,
                  "closed form", 1e-12, 1e-14, "a closed area at any step: rounding"),
            Check(f"trapezoid of its work, steps of {1e6 * most:g} um", "J/m2", float(broken.work[-1]),
                  triangle + 0.5 * JOINT.fT * rest, "closed form", 1e-12, 1e-14,
                  "half the drop times the step in which it falls, exactly"),
        ]  # fmt: skip
    return found


CASE = Case(
    "tension-brittle",
    "2.1",
    "One contact in tension, brittle",
    area="Contact laws",
    run=run,
    no_ladders="one contact point, driven by displacement: exact at any setting",
)

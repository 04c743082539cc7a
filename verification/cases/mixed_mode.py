"""One contact opened and slid at once: what yields first, and the strength that is left.

    slip |        . cone  k_s x = c0 - k_n z tan0
         |     .    |
         |  path    | cut-off  k_n z = f_T      path: (x, z) = l (cos a, sin a), a = 0, 15 ... 90 degrees
         |/_________|__ opening

First yield at l = min(f_T/(k_n sin a), c0/(k_s cos a + k_n sin a tan0)). Beyond it no stress leaves what is left
of the cut-off and of the cone. Where the cone ends below the cut-off (c0/tan0 < f_T), tension ends at its apex.

Reference: eqs (7), (8) of the paper.
"""

import numpy as np

from verification.case import Case, Check, Findings, Line, Plot
from verification.closed_forms import Joint
from verification.rigs.one_contact import along, law, walk
from verification.rigs.single_tension import ROUNDING, UM

JOINT = Joint()
WEAK = 0.3e6
"""Pa: a cohesion whose cone ends below the cut-off."""
ANGLES = (0, 15, 30, 45, 60, 75, 90)
LAWS = ("linear", "polynomial", "exponential")


def first_yield(chosen: tuple, direction: np.ndarray) -> float:
    """How far (m) a contact can go at once before anything but its springs answers."""
    low, high = 0.0, 100 * UM
    for _ in range(60):
        middle = 0.5 * (low + high)
        seen = walk(chosen, middle * direction[None])
        yields = seen.intact_n[0] < 1 or seen.intact_s[0] < 1 or seen.slip.any() or seen.dissipated[0] > 0
        low, high = (low, middle) if yields else (middle, high)
    return low


def run() -> Findings:
    """First yield at each angle, the strength left beyond it, and the apex of the cone."""
    found, stress, limit = Findings(), [], []
    for name in LAWS:
        chosen, worst, beyond = law(name), 0.0, 0.0
        for angle in np.radians(ANGLES):
            c, s = float(np.cos(angle)), float(np.sin(angle))
            wanted = min(
                JOINT.fT / (JOINT.kn * s) if s > 0 else np.inf,
                JOINT.c0 / (JOINT.ks * c + JOINT.kn * s * JOINT.tan0),
            )
            direction = np.array([c, 0.0, s])
            had = first_yield(chosen, direction)
            worst = max(worst, abs(had / wanted - 1.0))
            stress.append((JOINT.kn * had * s, JOINT.ks * had * c))
            limit.append((JOINT.kn * wanted * s, JOINT.ks * wanted * c))
            walked = walk(chosen, along([(0, 0, 0), 60 * UM * direction], 0.05 * UM))
            left = walked.intact_n * walked.intact_s
            cone = left * np.maximum(JOINT.c0 - walked.sigma * JOINT.tan0, 0.0)
            beyond = max(beyond, *(walked.sigma - left * JOINT.fT), *(walked.tau - cone))
        found.checks += [
            Check(f"first yield, {name}, largest deviation over all angles", "1", worst, 0.0, "closed form", 1e-12,
                  1e-14, "bisection of a comparison of stresses: rounding", 1.0),
            Check(f"stress beyond the strength left, {name}", "Pa", float(max(beyond, 0.0)), 0.0, "closed form", 1e-12,
                  1e-15, "the return ends on the cone: " + ROUNDING, JOINT.fT),
        ]  # fmt: skip
        apex = WEAK / JOINT.tan0
        weak = walk(law(name, cohesion=WEAK), along([(0, 0, 0), (0, 0, apex / JOINT.kn), (0, 0, 3 * UM)], 0.1 * UM))
        pulled = weak.sigma.max()
        found.checks.append(
            Check(f"most tension, cone below the cut-off, {name}", "Pa", float(pulled), apex, "closed form",
                  1e-12, 1e-15, "the path comes to the apex: rounding")
        )  # fmt: skip
    yields, wanted_at = 1e-6 * np.array(stress), 1e-6 * np.array(limit[: len(ANGLES)])
    lines = (
        Line("first yield", yields[:, 0], yields[:, 1], "points"),
        Line("cone and cut-off", wanted_at[:, 0], wanted_at[:, 1], "dashed"),
    )
    found.plots.append(Plot("First yield", "normal stress (MPa)", "shear stress (MPa)", lines))
    return found


CASE = Case(
    "mixed-mode",
    "2.2",
    "One contact opened and slid at once",
    area="Contact laws",
    run=run,
    quick=True,
    no_ladders="one contact point, driven by displacement: exact at any setting",
)

"""One contact in shear under constant compression, whichever its law: envelope, energies, strengths.

The contact slides along paths by the compiled sweep; the closed forms are those of `closed_forms`, and the catalogue's
areas are written out in the cases.
"""

from collections.abc import Callable

import numpy as np

from verification.case import Check, Findings, Line, Plot
from verification.closed_forms import Joint, dissipated_in_shear, shear
from verification.rigs.one_contact import Walk, along, law, walk
from verification.rigs.single_tension import ROUNDING, UM

COMPRESSIONS = (0.1e6, 0.5e6, 1.0e6)
LAST = 1e-3
STEP = 0.1 * UM


def slid(name: str, compression: float, *corners: float, most: float = STEP, **changes) -> Walk:
    """A contact of Table 1 under a compression (Pa), slid along x through the corners (m)."""
    z = -compression / changes.get("normal_stiffness", 150e9)
    return walk(law(name, **changes), along([(x, 0.0, z) for x in (0.0, *corners)], most))


def envelope(findings: Findings, name: str, joint: Joint, compressions: tuple[float, ...] = COMPRESSIONS) -> None:
    """Stress at every slip up to 1 mm, its peak and its residual."""
    lines = []
    for compression in compressions:
        us0 = float(joint.peak(compression)) / joint.ks
        found = slid(name, compression, us0, LAST)
        slip = found.path[:, 0]
        wanted = shear(name, joint, slip, compression)
        peak = joint.c0 + compression * joint.tan0
        off, at = float(np.abs(found.stress[:, 0] - wanted).max()), f"at {compression / 1e6:g} MPa"
        findings.checks += [
            Check(f"stress on the envelope {at}, largest deviation", "Pa", off, 0.0, "closed form", 1e-12, 1e-14,
                  ROUNDING, peak),
            Check(f"peak stress {at}", "Pa", float(found.tau.max()), peak, "closed form", 1e-12, 1e-14,
                  "the path hits the slip at the peak: rounding"),
        ]  # fmt: skip
        some = slice(0, None, 400)
        lines += [
            Line(f"contact, {compression / 1e6:g} MPa", 1e3 * slip, 1e-6 * found.tau),
            Line("closed form", 1e3 * slip[some], 1e-6 * wanted[some], "points"),
        ]
    findings.plots.append(Plot(f"Shear, {name} law", "slip (mm)", "shear stress (MPa)", tuple(lines)))


def energies(findings: Findings, name: str, joint: Joint, area: Callable[[float], float]) -> None:
    """Work at a slip U less what is stored, against `area(compression)` (J/m2, above tau_r, elastic part included) and
    the friction below it, tau_r (U - tau_r/ks); what the contact books; and the order of the first in du.
    """
    kind = "closed form"
    for compression in COMPRESSIONS:
        at = f"at {compression / 1e6:g} MPa"
        residual = joint.c_res + compression * joint.tan_res
        total = float(dissipated_in_shear(name, joint, LAST, compression))
        left = float(shear(name, joint, LAST, compression)) - residual
        tail = left**2 / (2 * joint.ks) + left * residual / joint.ks  # of the elastic part that is not yet given back
        wanted = area(compression) + residual * (LAST - residual / joint.ks) - tail
        us0 = float(joint.peak(compression)) / joint.ks
        off = []
        for most in (40 * STEP, 20 * STEP, STEP):
            found = slid(name, compression, us0, LAST, most=most)
            off.append(float(found.work[-1] - found.stored[-1]) - wanted)
        slip = np.concatenate([[0.0], found.path[:, 0]])
        trapezoid = float(np.trapezoid(shear(name, joint, slip, compression), slip))
        expected = abs(trapezoid - (left + residual) ** 2 / (2 * joint.ks) - total) / total
        friction = residual * float(found.slip[-1, 0])
        findings.checks += [
            Check(f"dissipated at 1 mm {at}", "J/m2", wanted + off[2], wanted, kind, 3 * expected, expected,
                  "three times the error of the trapezoid of the closed form"),
            Check(f"booked as spent at 1 mm {at}", "J/m2", float(found.dissipated[-1]), wanted, kind, 3 * expected,
                  expected, "booked by the same trapezoid"),
            Check(f"booked as friction {at}", "J/m2", float(found.spent[-1, 2]), friction, kind, 1e-12, 1e-13,
                  "tau_r times the plastic slip, a sum of 10,000 terms: rounding"),
        ]  # fmt: skip
        if name != "linear":
            coarse, fine = (np.ceil((LAST - us0) / (k * STEP)) for k in (40, 20))
            order = float(np.log(off[0] / off[1]) / np.log(fine / coarse))
            why = "the trapezoid of a smooth curve whose corner is hit; the next order is some (du c0/G)^2/60 of it"
            findings.checks.append(
                Check(f"order of the dissipation in du {at}", "1", order, 2.0, kind, 3e-4, 1e-4, why)
            )


def around_the_peak(law: str, joint: Joint, compression: float, rows: dict[str, np.ndarray]) -> tuple[float, float]:
    """What the largest of stresses seen at every step misses of the peak at most, as a share of it; and what the
    trapezoid of all steps misses of the work (J/m2), about. Rows of a drive along the slip: displacement (m), step.

    Between two steps du apart the curve rises by ks and falls by its first softening slope q.
    """
    peak, place = float(joint.peak(compression)), rows["displacement"]
    at = peak / joint.ks
    steps = np.diff(place) / np.maximum(np.diff(rows["step"]), 1)
    k = int(np.searchsorted(place, at))
    du = float(steps[max(k - 2, 0) : k + 1].max())
    fall = float(peak - shear(law, joint, at + du, compression)) / du
    rough = joint.ks * du**2 / 8 + peak * float(steps.max()) ** 2 * joint.c0 / joint.G_II / 12
    return du * joint.ks * fall / (joint.ks + fall) / peak, rough

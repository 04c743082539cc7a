"""One contact in tension, whichever its law: envelope, works, first softening slope, and the cycle of unloading.

The contact is taken along paths of opening by the compiled sweep; the closed forms are those of `closed_forms`.
"""

import numpy as np

from masonry.errors import SceneError
from verification.case import Check, Findings, Line, Plot
from verification.closed_forms import Joint, dissipated_in_tension, tension, tension_work, unloaded
from verification.rigs.one_contact import Walk, along, law, walk

UM = 1e-6
CYCLE = np.array([0.0, 20.0, 0.0, -8.0, 0.0, 20.0, 40.0]) * UM
WIDEST = 20 * UM
STEP = 0.05 * UM
ROUNDING = "the sweep evaluates the same formula: rounding of some operations"


def opened(name: str, *corners: float, most: float = STEP, **changes) -> Walk:
    """A contact of Table 1 opened through the corners (m), in steps of at most `most` (m)."""
    return walk(law(name, **changes), along([(0.0, 0.0, z) for z in (0.0, *corners)], most))


def envelope(findings: Findings, name: str, joint: Joint, **changes) -> None:
    """Stress at every opening up to 60 um, on the closed form."""
    found = opened(name, 60 * UM, **changes)
    wanted = tension(name, joint, found.path[:, 2])
    off = float(np.abs(found.sigma - wanted).max())
    findings.checks.append(
        Check(
            "stress on the envelope, largest deviation", "Pa", off, 0.0, "closed form", 1e-12, 1e-14, ROUNDING, joint.fT
        )  # fmt: skip
    )
    x, some = 1e6 * found.path[:, 2], slice(0, None, 40)
    lines = (Line("contact", x, 1e-6 * found.sigma), Line("closed form", x[some], 1e-6 * wanted[some], "points"))
    findings.plots.append(Plot(f"Tension, {name} law", "opening (um)", "normal stress (MPa)", lines))


def works(findings: Findings, name: str, joint: Joint, last: float, total: float, post_peak: float) -> None:
    """Work up to an opening `last` (m) against the catalogue's formula (J/m2), by the trapezoid of the stress, whose
    error is that of the trapezoid of the closed form; and what the contact itself books as spent, with no such error.
    """
    peak = joint.opening_at_peak
    off = []
    for most in (4 * STEP, 2 * STEP):
        found = opened(name, peak, last, most=most)
        off.append(float(found.work[-1]) - total)
    opening = np.concatenate([[0.0], found.path[:, 2]])
    expected = abs(float(np.trapezoid(tension(name, joint, opening), opening)) - total) / total
    kind = "closed form"
    if expected < 1e-12:
        reason = "the stress is piecewise linear and the increments hit its corners, so the trapezoid has no error"
        tolerance, expected = 1e-12, 1e-14
    else:
        reason, tolerance = "three times the error of the trapezoid of the closed form, O(du^2)", 3.0 * expected
        order = float(np.log2(off[0] / off[1]))
        why = "the trapezoid of a smooth curve whose corner is hit; the next order is (du f_T/G)^2 of it"
        findings.checks.append(Check("order of the work in du", "1", order, 2.0, kind, 3e-4, 3e-5, why))
    findings.checks += [
        Check("total work", "J/m2", total + off[1], total, kind, tolerance, expected, reason),
        Check("work after the peak", "J/m2", total + off[1] - 0.5 * joint.fT * peak, post_peak, kind,
              tolerance if tolerance == 1e-12 else tolerance * total / post_peak, expected, reason),
        Check("energy booked as spent", "J/m2", float(found.dissipated[-1] + found.stored[-1]), total, kind, 1e-12,
              1e-14, "areas under the envelope in closed form: " + ROUNDING),
    ]  # fmt: skip


def first_slope(findings: Findings, name: str, joint: Joint, slope: float, third: float) -> None:
    """Slope (Pa/m) with which the stress falls first, by a one-sided difference of second order.

    third  third derivative of the envelope over its slope there, in (f_T/G)^2
    """
    h = 0.01 * UM
    peak = joint.opening_at_peak
    found = opened(name, peak, peak + h, peak + 2 * h, most=1.0)
    at = [tuple(found.path[:, 2]).index(peak + k * h) for k in (0, 1, 2)]
    fall = float(np.dot([1.5, -2.0, 0.5], found.sigma[at]) / h)
    expected = third * (h * joint.fT / joint.G_I) ** 2 / 3.0
    reason = "three times the h^2 term of the difference" if third else "a straight line: cancellation in h = 0.01 um"
    findings.checks.append(
        Check("first softening slope", "Pa/m", fall, slope, "closed form", 3.0 * expected or 1e-11, expected or 2e-13,
              reason)
    )  # fmt: skip


def cycle(findings: Findings, name: str, joint: Joint, unloading: str = "secant") -> Walk:
    """0, 20, 0, -8, 0, 20, 40 um: stress, dissipation, and what is given back."""
    path = along(np.outer([0.0, joint.opening_at_peak, *CYCLE[1:]], [0.0, 0.0, 1.0]), 0.1 * UM)
    found = walk(law(name, unloading=unloading), path)
    opening = path[:, 2]
    first = int(np.argmax(opening >= WIDEST)) + 1
    wanted = np.concatenate(
        [tension(name, joint, opening[:first]), unloaded(name, joint, opening[first:], WIDEST, unloading)]
    )
    kind, of = "closed form", f"{name}, {unloading} unloading"
    off = float(np.abs(found.sigma - wanted).max())
    fall = float(np.diff(found.dissipated).min())
    findings.checks += [
        Check(f"stress in the cycle ({of}), largest deviation", "Pa", off, 0.0, kind, 1e-12, 1e-14, ROUNDING,
              float(np.abs(wanted).max())),
        Check(f"dissipation never falls ({of}), largest fall", "J/m2", min(fall, 0.0), 0.0, kind, 1e-12, 1e-14,
              "the history only grows; " + ROUNDING, joint.G_I),
    ]  # fmt: skip
    for um, at in ((20.0, first - 1), (40.0, len(opening) - 1)):
        gone = dissipated_in_tension(name, joint, um * UM, unloading)
        exact = unloading == "secant"
        expected = 1e-14 if exact else _elastic_error(name, joint, opening[: at + 1], gone)
        rough = expected > 1e-12
        reason = "three times the error of the trapezoid over the opening that stays" if rough else ROUNDING
        findings.checks.append(
            Check(f"dissipated up to {um:g} um ({of})", "J/m2", float(found.dissipated[at]), gone, kind,
                  3.0 * expected if rough else 1e-12, expected, reason, joint.G_I)
        )  # fmt: skip
    lines = (
        Line("contact", 1e6 * opening, 1e-6 * found.sigma),
        Line("closed form", 1e6 * opening[::40], 1e-6 * wanted[::40], "points"),
    )
    findings.plots.append(Plot(f"Cycle, {of}", "opening (um)", "normal stress (MPa)", lines))
    return found


def recoverable(findings: Findings, name: str, joint: Joint) -> None:
    """Work less dissipation is what the contact holds, at every step of the cycle; the trapezoid leaves O(du^2)."""
    off = []
    for most in (0.1 * UM, 0.05 * UM):
        corners = [0.0, joint.opening_at_peak, *CYCLE[1:]]
        found = walk(law(name), along(np.outer(corners, [0.0, 0.0, 1.0]), most))
        off.append(float(np.abs(found.gap).max()))
        trapezoid = np.concatenate([[0.0], found.path[:, 2]])
        grown = np.maximum.accumulate(trapezoid)
        exact = np.diff(tension_work(name, joint, grown))
        made = 0.5 * (tension(name, joint, grown)[1:] + tension(name, joint, grown)[:-1]) * np.diff(grown)
        expected = float(np.abs(np.cumsum(made - exact)).max()) / joint.G_I
    findings.checks.append(
        Check("work less dissipated less stored in the cycle, largest", "J/m2", off[1], 0.0, "closed form",
              3.0 * expected if expected > 1e-13 else 1e-12, max(expected, 1e-14),
              "three times the error of the trapezoid of the closed form", joint.G_I)
    )  # fmt: skip


def least_accepted(name: str, key: str, most: float, **changes: float) -> float:
    """Least value (SI) of a property that a law accepts, by bisection between 0 and `most`."""
    low, high = 0.0, most
    for _ in range(60):
        middle = 0.5 * (low + high)
        try:
            law(name, **{**changes, key: middle})
            high = middle
        except SceneError:
            low = middle
    return high


def _elastic_error(name: str, joint: Joint, opening: np.ndarray, gone: float) -> float:
    """Error (1) of booking each increment of the opening that stays by the trapezoid of the stress."""
    opening = np.union1d(np.maximum.accumulate(opening), [0.0])
    stress = tension(name, joint, opening)
    stay = opening - stress / joint.kn
    booked = float(np.sum(0.5 * (stress[1:] + stress[:-1]) * np.diff(stay)))
    return max(abs(booked - gone) / joint.G_I, 1e-14)

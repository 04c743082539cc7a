"""The claims of section 7 of the paper on what walls carry in horizontal bending, each held against ours."""

import numpy as np

from verification.paper.bending.runs import ASSUMED, GAUGE, POINTS, SCENES, STRENGTHS, WEAKER, label, name_of, walls
from verification.paper.bending.strength_map import wall_by_hand
from verification.paper.experiment import Claim, Done, claim

FREE, PRESSED = SCENES
HIGHER, ALIKE, FALLEN = 0.01, 0.01, 0.6
"""Least rise of the capacity that counts, most change by contact points that does not, most force left later."""


def claims(done: Done) -> list[Claim]:
    """A row for each sentence that can be held against a number."""
    made = [capacity_rises(done), trend(done), level(done), by_hand(done)]
    return made if done.quick else [*made, points(done), mode_2_energy(done)]


def capacity_rises(done: Done) -> Claim:
    """Force with over force without pre-compression."""
    rise = {p: done.peak(label(p, PRESSED)) / done.peak(label(p, FREE)) - 1.0 for p in (ASSUMED, WEAKER)}
    force = {s: done[label(ASSUMED, s)].summary["peak_force_n"] * 1e-3 for s in SCENES}
    return claim("Pre-compression raises the capacity in horizontal bending", "7, Fig. 21",
                 f"peak at 0.25 MPa over that at 0, less 1: > {HIGHER:.0%} with both pairs of strengths",
                 f"{force[FREE]:.1f} to {force[PRESSED]:.1f} kN: +{rise[ASSUMED]:.1%} as assumed, +{rise[WEAKER]:.1%} "
                 f"with {name_of(WEAKER)}",
                 min(rise.values()) > HIGHER, "bed joints do not turn where the crack runs straight")  # fmt: skip


def trend(done: Done) -> Claim:
    """The force falls past the peak, and does not vanish."""
    remaining = {}
    for name in (label(*wall) for wall in walls()):
        rows, at = done[name].history.rows, done[name].summary["gauges"][GAUGE]["at_peak_m"]
        remaining[name] = float(np.interp(3.0 * at, rows[GAUGE], rows["force"]) / rows["force"].max())
    return claim("The curves have the same trend with and without pre-compression", "7, Fig. 21",
                 f"at three times the deflection of the peak between 0 and {FALLEN:.0%} of it is left, in all four "
                 "walls",
                 ", ".join(f"{value:.0%} ({name})" for name, value in remaining.items()),
                 all(0.0 < value < FALLEN for value in remaining.values()),
                 "the force does not fall, or vanishes")  # fmt: skip


def level(done: Done) -> Claim:
    """Our forces, beside which no test can be drawn."""
    shown = []
    for sigma in SCENES:
        summary = done[label(ASSUMED, sigma)].summary
        at = summary["gauges"][GAUGE]["at_peak_m"]
        shown.append(f"{sigma}: {summary['peak_force_n'] * 1e-3:.1f} kN at {at * 1e3:.2f} mm")
    return claim("Trend and capacity are similar to those of the tests", "7, Fig. 21",
                 "peak force and its mid-span deflection beside those of Willis",
                 "; ".join(shown),
                 None, "the curves of Fig. 21 are lost, and so are the strengths that set the peak")  # fmt: skip


def by_hand(done: Done) -> Claim:
    """Peaks against the two estimates by hand."""
    places, outside = [], []
    for name in (label(*wall) for wall in (walls() if done.quick else walls(STRENGTHS))):
        peak, (low, high) = done.peak(name), wall_by_hand(done, name).bounds()
        places.append((peak - low) / (high - low))
        outside += [] if low < peak < high else [name]
    return claim("The capacity follows from strengths of joints and units", "hand estimate",
                 "each peak lies above the least brittle and below the least plastic estimate over all ways of "
                 "cracking",
                 f"{len(places) - len(outside)} of {len(places)}; {min(places):.0%} to {max(places):.0%} of the way "
                 "between",
                 not outside, f"outside: {', '.join(outside)}")  # fmt: skip


def points(done: Done) -> Claim:
    """Fewer and more contact points through the thickness."""
    moved = {
        f"{n} points, {sigma}": done.peak(label(ASSUMED, sigma, f"{n} points")) / done.peak(label(ASSUMED, sigma)) - 1.0
        for n in POINTS
        for sigma in SCENES
    }
    return claim("Ten contact points through the thickness give a proper flexural stress distribution", "7",
                 f"the peak moves by less than {ALIKE:.0%} with 6 and with 14",
                 ", ".join(f"{value:+.2%} ({name})" for name, value in moved.items()),
                 max(map(abs, moved.values())) < ALIKE, "the peak depends on the number of points")  # fmt: skip


def mode_2_energy(done: Done) -> Claim:
    """The energy of Table 5 under pre-compression against that without."""
    more, less = done.peak(label(ASSUMED, PRESSED)), done.peak(label(ASSUMED, PRESSED, "GII 40 N/m"))
    return claim("The higher mode II energy of 90 N/m addresses the influence of pre-compression", "7, Table 5",
                 f"with 40 N/m the peak under 0.25 MPa is lower, {name_of(ASSUMED)}",
                 f"{1e-6 * more:.3f} MPa with 90, {1e-6 * less:.3f} MPa with 40 N/m: {more / less - 1.0:+.1%}",
                 more > 1.001 * less, "the peak comes before bed joints have softened")  # fmt: skip

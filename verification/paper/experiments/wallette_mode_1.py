"""Section 5.1: a wallette of strong units and weak joints, pulled along its bed joints (Table 3, Figs. 9 to 12)."""

import numpy as np

from masonry import scene
from masonry.assembly.assemble import joined
from masonry.drawings.geometry_picture import geometry_figure
from masonry.pictures.style import MEGA
from verification.html import page
from verification.html.page import percent
from verification.paper import pictures
from verification.paper.experiment import Claim, Done, Experiment, Run, Section, claim
from verification.paper.walls.common import (
    AFFINE,
    HINGE,
    HINGED,
    MODE_1,
    PAPERS_RATE,
    RATE,
    SHIPPED,
    mpa,
    plates_claim,
    quick_enough,
    rate_claim,
    table_of_runs,
)
from verification.paper.walls.curve_shape import apart, peak_place, stress_at
from verification.paper.walls.stepped_crack import ALL_AT_PEAK, HEADS_GONE
from verification.paper.walls.stepped_crack import claims as claims_on_the_crack

DILATION = "contact.unit_unit.dilation_angle"
ANGLES = (0, 2, 4)
CUTOFF = "contact.unit_unit.dilation_cutoff"
CUTOFFS = ("0.02 mm", "0.1 mm", "0.2 mm", "0.46 mm")
"""Slips at which dilation ends, beside the shipped one; at the last 1 % of the cohesion is left."""
WIDER = (
    "at 4 degrees the crack takes a wider way, with a head joint on each side of the middle, and slides less far on "
    "each bed"
)
PLATES = (
    "the paper does not say it in so many words. Rates set at all gridpoints of a side hold it upright, as this scene "
    "is shipped, and the curve falls smoothly to its residual. On a hinge the crack opens from one edge, one half of "
    "the wall after the other, and the stress rests before it falls once more. Peak, crack and fracture energy are "
    "nearly the same"
)
LOST_CUTOFF = (
    "the slip at which dilation ends is not given. It is the largest assumption of this failure mode: the peak does "
    "not feel it, the stress that is left does"
)


def runs(quick: bool) -> dict[str, Run]:
    """Angles of dilation, upright and on a hinge; in full also ends of dilation, affine units and the paper's rate."""
    made: dict[str, Run] = {}
    for angle in ANGLES:
        given = {DILATION: f"{angle} deg"} if angle != 2 else {}
        made[dilated(angle)] = Run(MODE_1, given, pace_check=True)
        if angle == 2 or not quick:
            made[dilated(angle, True)] = Run(MODE_1, {**HINGED, **given}, pace_check=True)
    if not quick:
        made |= {ended(cutoff): Run(MODE_1, {CUTOFF: cutoff}) for cutoff in CUTOFFS}
        made |= {
            "affine units": Run(MODE_1, AFFINE),
            "affine units, right plate on a hinge": Run(MODE_1, {**AFFINE, **HINGED}, pace_check=True),
            RATE: Run(MODE_1, PAPERS_RATE),
        }
    return quick_enough(made, quick)


def ended(cutoff: str) -> str:
    """The label of a run by the slip at which its dilation ends."""
    return f"dilation ends at {cutoff}"


def dilated(angle: int, hinge: bool = False) -> str:
    """The label of a run by its angle of dilation in degrees, 2 as shipped, and whether its plate is on a hinge."""
    if angle == 2:
        return HINGE if hinge else SHIPPED
    return f"dilation {angle} degrees" + (f", {HINGE}" if hinge else "")


def plates(quick: bool) -> dict[bool, str]:
    """Whether the plate is on a hinge where dilation is varied -> the words for it."""
    return {False: SHIPPED} if quick else {False: SHIPPED, True: HINGE}


def show(done: Done) -> Section:
    """Geometry, curves, cracks, dilation."""
    specimen, joints = joined(given := scene.load(MODE_1))
    geometry = geometry_figure(given, specimen, joints)
    beside = [label for label in done.asked if label in (SHIPPED, HINGE, RATE) or label.startswith("affine")]
    lines = [pictures.stress_line(label, done[label]) for label in beside]
    angles = {
        f"Fig. 12: {name}": [pictures.stress_line(f"dilation {a} degrees", done[dilated(a, hinge)]) for a in ANGLES]
        for hinge, name in plates(done.quick).items()
    }
    if not done.quick:
        by_cutoff = [pictures.stress_line(name, done[label]) for name, label in cutoffs().items()]
        angles["2 degrees, to a slip of"] = by_cutoff
    drawn = pictures.curves({"Fig. 10": lines, **angles})
    for bound in (HEADS_GONE, ALL_AT_PEAK):
        drawn.axes[0].axhline(bound, color="0.5", linewidth=0.9, linestyle=":")
    gallery = pictures.cracks({label: done[label] for label in (SHIPPED, HINGE)}, at_peak=True)
    parts = [
        page.picture(geometry, "Fig. 9, ours: the wallette, its plates and its drive.", "half", pixels=True),
        page.picture(drawn, "Figs. 10 and 12, ours. Dotted: the bounds of the peak by hand, 0.114 and 0.214 MPa."),
        page.picture(gallery, "Fig. 11, ours: cracks at the peak and at the end.", pixels=True),
        *table_of_runs(done, [label for label in done.asked if done.has(label)]),
    ]
    return Section(parts, claims(done))


def claims(done: Done) -> list[Claim]:
    """Claims of section 5.1, and what is known beforehand."""
    shipped, hinge = done[SHIPPED], done[HINGE]
    peaks = {label: mpa(done[label]) for label in done.asked if done.has(label)}
    made = [*claims_on_the_crack(peaks, shipped, hinge), *dilation_claims(done), plates_claim(hinge, shipped, PLATES)]
    if done.has(RATE):
        made += [rate_claim(shipped, done[RATE], "5.1"), cutoff_claim(done)]
    return made


def cutoffs() -> dict[str, str]:
    """The slips at which dilation ends in words -> labels of their runs."""
    ends = {cutoff: ended(cutoff) for cutoff in CUTOFFS}
    return {CUTOFFS[0]: ends.pop(CUTOFFS[0]), "0.05 mm, as shipped": SHIPPED, **ends}


def cutoff_claim(done: Done) -> Claim:
    """Effect of the slip at which dilation ends."""
    shown = [
        f"{name}: {mpa(done[label]):.4f}, {float(done[label].summary['final_stress_pa']) * MEGA:.4f} MPa"
        for name, label in cutoffs().items()
    ]
    return claim("Dilation remains approximately constant, then goes down to zero", "5.1",
                 "peak, and stress at 0.5 mm, with dilation that ends at some slip",
                 "; ".join(shown),
                 None, LOST_CUTOFF)  # fmt: skip


def dilation_claims(done: Done) -> list[Claim]:
    """Effect of the angle of dilation before and after the peak, however the plates are held."""
    before, after = [], []
    for hinge in plates(done.quick):
        by_angle = [done[dilated(angle, hinge)] for angle in ANGLES]
        peak_at, end = peak_place(by_angle[1]), float(by_angle[1].history.rows["displacement"][-1])
        before += [apart(r, by_angle[1], 0.0, peak_at) for r in by_angle]
        after.append([float(stress_at(r, np.linspace(2.0 * peak_at, end, 200)).mean()) * MEGA for r in by_angle])
    shown = [" / ".join(f"{value:.4f}" for value in means) for means in after]
    return [
        claim("Dilation is not felt before the ultimate stress", "5.1, Fig. 12",
              "curves of 0 and 4 degrees differ from that of 2 by < 1 % of the peak on average, up to the peak",
              f"at most {percent(max(before))}; peaks {' / '.join(f'{mpa(done[dilated(a)]):.4f}' for a in ANGLES)} MPa",
              max(before) < 0.01, "felt before the peak"),
        claim("Its effect beyond that is pronounced: the more dilation, the more stress", "5.1, Fig. 12",
              "mean stress from twice the displacement of the peak to the end rises by > 5 % with each 2 degrees",
              f"; {HINGE}: ".join(shown) + " MPa at 0 / 2 / 4 degrees",
              all(b > 1.05 * a for means in after for a, b in zip(means, means[1:], strict=False)), WIDER),
    ]  # fmt: skip


EXPERIMENT = Experiment(
    "wallette-mode-1", "Wallette in tension: stepped crack (Table 3, Figs. 9 to 12)", 30, runs, show
)

"""Section 5.1: a wallette of strong units and weak joints, pulled along its bed joints (Table 3, Figs. 9 to 12)."""

import numpy as np

from masonry import scene
from masonry.assembly import joined
from masonry.geometry_picture import geometry_figure
from verification.paper import pictures
from verification.paper.experiment import Claim, Done, Experiment, Run, Section
from verification.paper.walls.common import (
    AFFINE,
    CLAMPED,
    HELD,
    MEGA,
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
from verification.paper.walls.stepped_crack import (
    ALL_AT_PEAK,
    HEADS_GONE,
    pattern_claim,
    peak_claim,
    residual_claims,
    units_claim,
)
from verification.report import page
from verification.report.page import percent

DILATION = "contact.unit_unit.dilation_angle"
ANGLES = (0, 2, 4)
WIDER = (
    "it rises on the hinge. Plates that do not turn press on beds that dilate: at 4 degrees the crack takes a wider "
    "way, with a head joint on each side of the middle, and slides less far on each bed"
)
PLATES = (
    "the paper does not say whether its plates turn. Rates set at all gridpoints of a side would hold it upright, "
    "and then "
    "the curve falls smoothly to its residual. On a hinge the crack opens from one edge, one half of the wall after "
    "the "
    "other: the stress rests on a plateau and falls once more. Peak, crack and fracture energy are nearly the same; "
    "the "
    "scene ships with the hinge because failure mode 2, in the same rig, then has the single crack that the paper shows"
)


def runs(quick: bool) -> dict[str, Run]:
    """Angles of dilation, with plates that turn and that do not; in full also affine units and the paper's rate."""
    made: dict[str, Run] = {}
    for angle in ANGLES:
        given = {DILATION: f"{angle} deg"} if angle != 2 else {}
        made[dilated(angle)] = Run(MODE_1, given, True)
        if angle == 2 or not quick:
            made[dilated(angle, True)] = Run(MODE_1, {**CLAMPED, **given}, True)
    if not quick:
        made |= {
            "affine units": Run(MODE_1, AFFINE, True),
            "affine units, plates do not turn": Run(MODE_1, {**AFFINE, **CLAMPED}, True),
            RATE: Run(MODE_1, PAPERS_RATE),
        }
    return quick_enough(made, quick)


def dilated(angle: int, held: bool = False) -> str:
    """The label of a run by its angle of dilation in degrees, 2 as shipped, and whether its plates are held upright."""
    if angle == 2:
        return HELD if held else SHIPPED
    return f"dilation {angle} degrees" + (f", {HELD}" if held else "")


def ways(quick: bool) -> dict[bool, str]:
    """Whether plates are held upright where dilation is varied -> the words for it."""
    return {False: SHIPPED} if quick else {False: SHIPPED, True: HELD}


def show(done: Done) -> Section:
    """Geometry, curves, cracks, dilation."""
    specimen, joints = joined(given := scene.load(MODE_1))
    geometry = geometry_figure(given, specimen, joints)
    beside = [label for label in done if label in (SHIPPED, HELD, RATE) or label.startswith("affine")]
    lines = [pictures.stress_line(label, done[label]) for label in beside]
    angles = {
        f"Fig. 12: {name}": [pictures.stress_line(f"dilation {a} degrees", done[dilated(a, held)]) for a in ANGLES]
        for held, name in ways(done.quick).items()
    }
    drawn = pictures.curves({"Fig. 10": lines, **angles})
    for bound in (HEADS_GONE, ALL_AT_PEAK):
        drawn.axes[0].axhline(bound, color="0.5", linewidth=0.9, linestyle=":")
    gallery = pictures.cracks({label: done[label] for label in (SHIPPED, HELD)}, at_peak=True)
    parts = [
        page.picture(geometry, "Fig. 9, ours: the wallette, its plates and its drive.", "half", pixels=True),
        page.picture(drawn, "Figs. 10 and 12, ours. Dotted: the bounds of the peak by hand, 0.114 and 0.214 MPa."),
        page.picture(gallery, "Fig. 11, ours: cracks at the peak and at the end.", pixels=True),
        *table_of_runs(done, [label for label in done if done.has(label)]),
    ]
    return Section(parts, claims(done))


def claims(done: Done) -> list[Claim]:
    """What section 5.1 says, and what is known beforehand."""
    shipped, held = done[SHIPPED], done[HELD]
    peaks = {label: mpa(done[label]) for label in done if done.has(label)}
    made = [peak_claim(peaks), pattern_claim(shipped), units_claim(shipped), *residual_claims(shipped, held)]
    made += [*dilation_claims(done), plates_claim(shipped, held, PLATES)]
    if done.has(RATE):
        made.append(rate_claim(shipped, done[RATE], "5.1"))
    return made


def dilation_claims(done: Done) -> list[Claim]:
    """What the angle of dilation does before and after the peak, however the plates are held."""
    before, after = [], []
    for held in ways(done.quick):
        by_angle = [done[dilated(angle, held)] for angle in ANGLES]
        peak_at, end = peak_place(by_angle[1]), float(by_angle[1].history.rows["displacement"][-1])
        before += [apart(r, by_angle[1], 0.0, peak_at) for r in by_angle]
        after.append([float(stress_at(r, np.linspace(2.0 * peak_at, end, 200)).mean()) * MEGA for r in by_angle])
    rising = all(b > 1.05 * a for means in after for a, b in zip(means, means[1:], strict=False))
    shown = [" / ".join(f"{value:.4f}" for value in means) for means in after]
    return [
        Claim(
            "Dilation is not felt before the ultimate stress",
            "5.1, Fig. 12",
            "curves of 0 and 4 degrees differ from that of 2 by < 1 % of the peak on average, up to the peak",
            f"at most {percent(max(before))}; peaks {' / '.join(f'{mpa(done[dilated(a)]):.4f}' for a in ANGLES)} MPa",
            max(before) < 0.01,
            "" if max(before) < 0.01 else "felt before the peak",
        ),
        Claim(
            "Its effect beyond that is pronounced: the more dilation, the more stress",
            "5.1, Fig. 12",
            "mean stress from twice the displacement of the peak to the end rises by > 5 % with each 2 degrees",
            f"; {HELD}: ".join(shown) + " MPa at 0 / 2 / 4 degrees",
            rising,
            "" if rising else WIDER,
        ),
    ]


EXPERIMENT = Experiment(
    "wallette-mode-1", "Wallette in tension: stepped crack (Table 3, Figs. 9 to 12)", 30, runs, show
)

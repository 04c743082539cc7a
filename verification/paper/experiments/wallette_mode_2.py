"""Section 5.2: a wallette of weak units and strong joints, pulled along its bed joints (Table 4, Figs. 13 and 14)."""

from collections.abc import Mapping

from masonry.laboratory.result import Result
from masonry.pictures.style import MILLI
from verification.html import page
from verification.html.page import percent
from verification.paper import pictures
from verification.paper.experiment import Claim, Done, Experiment, Run, Section, claim
from verification.paper.walls.common import (
    AFFINE,
    CLAMPED,
    HELD,
    MODE_1,
    MODE_2,
    PAPERS_RATE,
    RATE,
    SHIPPED,
    mpa,
    plates_claim,
    quick_enough,
    rate_claim,
    table_of_runs,
)
from verification.paper.walls.crack_path import crack_path
from verification.paper.walls.curve_shape import energy_per_section, fall_to, left_after, stress_at
from verification.paper.walls.straight_crack import ALL_AT_PEAK, path_claims, peak_claim, sliding_claim

BY_HAND = 8.0
"""N/m of section: fracture energy of one straight crack, all of it in tension."""
CELLS, FIRST = "218 cells", "failure mode 1"
PLATES = (
    "the paper does not say it in so many words. Rates set at all gridpoints of a side would hold it upright; then "
    "three sections (at 125, 250 and 375 mm) compete, and in the regular grid two share the wall until one wins. How "
    "often one section has the crack to itself, see the size of the blocks. On a hinge it nearly always has, and so it "
    "is shipped"
)


def runs(quick: bool) -> dict[str, Run]:
    """As shipped, plates that do not turn, random cells, and mode 1 to compare; in full affine units and 1 mm/s."""
    made = {
        SHIPPED: Run(MODE_2, pace_check=True),
        HELD: Run(MODE_2, CLAMPED, pace_check=True),
        CELLS: Run(f"{MODE_2}-218", pace_check=True),
        FIRST: Run(MODE_1),
    }
    if quick:
        return quick_enough(made, quick)
    return made | {"affine units": Run(MODE_2, AFFINE, pace_check=True), RATE: Run(MODE_2, PAPERS_RATE)}


def show(done: Done) -> Section:
    """Curves, cracks, numbers."""
    second = [label for label in done.asked if done.runs[label].scene.startswith(MODE_2) and done.has(label)]
    lines = [pictures.stress_line(label, done[label]) for label in second]
    both = [pictures.stress_line("failure mode 2", done[SHIPPED]), pictures.stress_line(FIRST, done[FIRST])]
    drawn = pictures.curves({"Fig. 13": lines, "Both failure modes": both})
    drawn.axes[0].axhline(ALL_AT_PEAK, color="0.5", linewidth=0.9, linestyle=":")
    gallery = pictures.cracks({label: done[label] for label in (SHIPPED, CELLS, HELD)}, columns=3)
    parts = [
        page.picture(drawn, f"Fig. 13, ours. Dotted: the bound of the peak by hand, {ALL_AT_PEAK} MPa."),
        page.picture(gallery, "Fig. 14, ours: cracks at the end.", pixels=True),
        *table_of_runs(done, second),
    ]
    return Section(parts, claims(done, second))


def claims(done: Done, second: list[str]) -> list[Claim]:
    """Claims of section 5.2."""
    shipped, cells, first = done[SHIPPED], done[CELLS], done[FIRST]
    both = {SHIPPED: shipped, CELLS: cells}
    made = [peak_claim({label: mpa(done[label]) for label in second}), softening_claim(both, first)]
    made += [*path_claims(both), sliding_claim(both)]
    made += [tension_claim(shipped, cells), plates_claim(shipped, done[HELD], PLATES)]
    if done.has(RATE):
        made.append(rate_claim(shipped, done[RATE], "5.2"))
    return made


def softening_claim(second: Mapping[str, Result], first: Result) -> Claim:
    """How much steeper than mode 1 it falls; what is left far on depends on where dilation ends in mode 1."""
    half = {label: fall_to(r, 0.5) * MILLI for label, r in second.items()}
    remaining = {label: left_after(r, 2.0) for label, r in second.items()}
    before = fall_to(first, 0.5) * MILLI, left_after(first, 2.0)
    end = min(float(r.history.rows["displacement"][-1]) for r in second.values())
    late = {n: float(stress_at(r, end)) / r.summary["peak_stress_pa"] for n, r in {**second, FIRST: first}.items()}
    return claim("A completely different curve from the first failure mode: steep softening", "5.2, Fig. 13",
                 "falls to half the peak in < half the displacement of mode 1; at twice that of the peak less is left",
                 f"{'; '.join(f'{n}: {half[n]:.3f} mm, {percent(remaining[n])}' for n in second)}; mode 1: "
                 f"{before[0]:.3f} mm, {percent(before[1])}. Left at {end * MILLI:.1f} mm: "
                 + ", ".join(f"{percent(fraction)} ({n})" for n, fraction in late.items()),
                 max(half.values()) < 0.5 * before[0] and max(remaining.values()) < before[1],
                 "not as steep")  # fmt: skip


def tension_claim(grid: Result, cells: Result) -> Claim:
    """Most energy goes into tension, and as much as one section takes."""
    dissipated, rough = energy_per_section(grid), energy_per_section(cells)
    fractions = [s["mode I"] / s["fracture"] for s in (dissipated, rough)]
    whole = dissipated["fracture"]
    return claim("The governing mechanism is the tensile response of joints and bricks", "5.2",
                 f"> 50 % of the fracture energy by mode I; of the regular grid within 10 % of {BY_HAND:g} N/m of "
                 "section",
                 f"grid {100 * fractions[0]:.0f} % of {whole:.2f} N/m, {crack_path(grid).sections():.2f} of the "
                 f"section broken at the end; 218 cells {100 * fractions[1]:.0f} % of {rough['fracture']:.1f} N/m: "
                 "their faces are rough and slide on each other",
                 min(fractions) > 0.5 and abs(whole / BY_HAND - 1.0) < 0.1, "another mechanism takes part")  # fmt: skip


EXPERIMENT = Experiment(
    "wallette-mode-2", "Wallette in tension: crack through units (Table 4, Figs. 13, 14)", 31, runs, show
)

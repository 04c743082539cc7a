"""The claims on a stepped crack: what it goes through, what it carries at the end, and the energy that it takes."""

from collections.abc import Mapping

import numpy as np

from masonry.laboratory.result import Result
from masonry.pictures.style import MEGA, MILLI
from verification.html.page import percent
from verification.paper.experiment import Claim, claim
from verification.paper.walls.crack_path import crack_path
from verification.paper.walls.curve_shape import energy_per_section

HEADS_GONE, ALL_AT_PEAK = 0.114, 0.214
"""MPa. Least peak: head joints gone, bed joints at full cohesion; greatest: all joints at their peaks at once."""
BY_HAND = 16.4
"""N/m of section: fracture energy of one stepped crack, by hand."""
ALIKE = 0.1
"""Share of the stress at the end that something else than bed joints may carry."""
BEDS = 3 * 125.0 / 492.0
"""Area of the bed joints in one stepped crack over the section: half a unit between each two courses."""


def claims(peaks: Mapping[str, float], shipped: Result, hinge: Result) -> list[Claim]:
    """Claims of section 5.1 on the crack, and what is known of it beforehand; peaks in MPa by run."""
    return [peak_claim(peaks), pattern_claim(shipped), units_claim(shipped), *residual_claims(shipped, hinge)]


def peak_claim(peaks: Mapping[str, float]) -> Claim:
    """Peaks in MPa by run, between what the joints must carry and what they can."""
    low, high = min(peaks.values()), max(peaks.values())
    return claim("The capacity is that of the joints", "limit analysis",
                 f"every peak between {HEADS_GONE} MPa (head joints gone) and {ALL_AT_PEAK} MPa (all joints at their "
                 "peaks)",
                 f"{low:.4f} to {high:.4f} MPa in {len(peaks)} runs",
                 all(HEADS_GONE < p < ALL_AT_PEAK for p in peaks.values()),
                 "a peak beyond what the joints can carry, or below what they must")  # fmt: skip


def pattern_claim(result: Result) -> Claim:
    """Head joints in tension and bed joints in shear, one stepped crack."""
    crack = crack_path(result)
    fractions, frame = crack.fractions(), crack.frame
    led = frame.damage_tension >= frame.damage_shear
    head, bed = crack.broken & crack.head, crack.broken & crack.bed
    opened, slid = (float(np.average(m, weights=crack.area[c])) for m, c in ((led[head], head), (~led[bed], bed)))
    return claim("Tensile cracks at the head joints together with shear failure at the bed joints", "5.1, Fig. 11",
                 f"broken: one head joint a course (1.00 of the section) by tension, {BEDS:.2f} of bed joints by "
                 "shear, each > 90 %",
                 f"{fractions['head joints']:.2f}, {percent(opened)} led by tension; {fractions['bed joints']:.2f}, "
                 f"{percent(slid)} by shear",
                 abs(fractions["head joints"] - 1) < 0.05 and abs(fractions["bed joints"] - BEDS) < 0.05
                 and min(opened, slid) > 0.9, "another pattern")  # fmt: skip


def units_claim(result: Result) -> Claim:
    """Units stay whole."""
    maximum = max(float(f.damage[crack_path(result, f).unit].max()) for f in result.history.frames)
    return claim("No damage is recorded in the bricks before or after the peak", "5.1",
                 "largest damage within units in any frame is 0",
                 f"{maximum:.2g}",
                 maximum == 0.0, "units are damaged")  # fmt: skip


def residual_claims(shipped: Result, hinge: Result) -> list[Claim]:
    """Stress carried at the end, and the energy that it took."""
    ends = [float(r.summary["final_stress_pa"]) * MEGA for r in (shipped, hinge)]
    sheared = [(c := crack_path(r)).stress_carried(c.bed) * MEGA for r in (shipped, hinge)]
    dissipated = [energy_per_section(r)["fracture"] for r in (shipped, hinge)]
    return [
        claim("The mechanism yields a residual stress, from shear of the bed joints", "5.1, Fig. 10",
              f"stress at the end > 0, and within {percent(ALIKE)} of the shear of broken bed joints over the section",
              f"{ends[0]:.4f} MPa, bed joints {sheared[0]:.4f} MPa; on a hinge: {ends[1]:.4f}, {sheared[1]:.4f}",
              all(abs(a / b - 1.0) < ALIKE for a, b in zip(ends, sheared, strict=True)) and min(ends) > 0.0,
              "something else carries load"),
        claim("Energy to full separation, from Table 3", "Table 3, by hand",
              f"fracture energy of one stepped crack within 10 % of {BY_HAND} N/m of section; friction comes on top",
              f"{dissipated[0]:.1f} N/m and {energy_per_section(shipped)['friction']:.1f} N/m of friction at "
              f"{float(shipped.history.rows['displacement'][-1]) * MILLI:.2g} mm; on a hinge: {dissipated[1]:.1f} N/m",
              all(abs(s / BY_HAND - 1.0) < 0.1 for s in dissipated), "more or less than one stepped crack"),
    ]  # fmt: skip

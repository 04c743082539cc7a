"""The claims on the size of blocks: what changes with it, held against what changes with the seed."""

from collections.abc import Mapping

import numpy as np

from masonry.pictures.style import MILLI
from verification.html.page import percent
from verification.paper.experiment import Claim, claim
from verification.paper.sizes.families import (
    BRITTLE,
    FIRST,
    HELD,
    SECOND,
    SECTIONS,
    SIZES,
    Results,
    curves_apart,
    peaks,
    straight,
)
from verification.paper.sizes.spread import spread_of
from verification.paper.walls.common import mpa
from verification.paper.walls.curve_shape import energy_per_section
from verification.paper.walls.straight_crack import STRAIGHT


def claims(families: Mapping[str, Results], quick: bool) -> list[Claim]:
    """Claims of section 6 and the conclusions on size."""
    made = [curves_claim(families, FIRST, 0.05, "No response change in failure mode 1")]
    made.append(curves_claim(families, SECOND, 0.05, "Slightly different curves of the same trend in failure mode 2"))
    made += [pattern_claim(families), place_claim(families)]
    made += [capacity_claim(families, name, quick) for name in (FIRST, SECOND)]
    made.append(coarse_claim(families))
    return made if quick else [*made, brittle_claim(families)]


def curves_claim(families: Mapping[str, Results], name: str, limit: float, says: str) -> Claim:
    """The curves of the sizes against each other, beside what seeds do."""
    sizes, seeds = curves_apart(families[name])
    return claim(says, "6, Fig. 15",
                 f"{name}: mean curves of 335 and 540 cells within {percent(limit)} of the peak of that of 218 cells",
                 f"{percent(sizes)}; seeds of one size differ from its mean curve by {percent(seeds)}",
                 sizes < limit, "the curve after the peak depends on the paths that the division offers, "
                 "at every size")  # fmt: skip


def pattern_claim(families: Mapping[str, Results]) -> Claim:
    """One almost vertical crack at every size."""
    narrow, _, count = straight(families[SECOND])
    held = (
        f"; plates that do not turn: {straight(families[HELD])[0]} of {straight(families[HELD])[2]}"
        if HELD in families
        else ""
    )
    return claim("No difference in the fracture pattern: an almost vertical crack", "6, Fig. 16",
                 f"failure mode 2: spread of the crack along the wall < {STRAIGHT * MILLI:.0f} mm in every run",
                 f"{narrow} of {count}{held}",
                 narrow == count, "some cracks change from one section to another, or share the wall "
                 "with a second")  # fmt: skip


def place_claim(families: Mapping[str, Results]) -> Claim:
    """Whether it stands at mid-length."""
    narrow, middle, _ = straight(families[SECOND])
    return claim("The crack is at the mid-length of the specimen", "6, Fig. 16",
                 f"failure mode 2: middle of the crack within {STRAIGHT * MILLI:.0f} mm of {SECTIONS[1] * MILLI:.0f} "
                 "mm",
                 f"{middle} of {narrow}",
                 middle == narrow > 0, "the sections at 125, 250 and 375 mm each hold two head joints "
                 "and two mid-lengths of units, and are equally strong: the cells decide. The units' "
                 "mid-length is met in all of them")  # fmt: skip


def capacity_claim(families: Mapping[str, Results], name: str, quick: bool) -> Claim:
    """How far peaks differ by size, and whether it is chance."""
    by_size = peaks(families[name])
    means = {size: float(np.mean(values)) for size, values in by_size.items()}
    reach = (max(means.values()) - min(means.values())) / float(np.mean(list(means.values())))
    told = ""
    if not quick:
        spread = spread_of(by_size)
        told = (
            f"; by seed ± {percent(spread.within / spread.mean)}, by size ± {percent(spread.between / spread.mean)} "
            f"beyond chance (p = {spread.chance:.2g})"
        )
    return claim(f"No severe block size dependency and capacity difference, {name}", "6, conclusion 2",
                 "mean peaks of the three sizes within 5 % of each other",
                 " / ".join(f"{m:.4f}" for m in means.values()) + f" MPa, {percent(reach)} apart{told}",
                 reach < 0.05, "the peak depends on the size")  # fmt: skip


def coarse_claim(families: Mapping[str, Results]) -> Claim:
    """Coarse against fine cells: peak and energy."""
    errors = []
    for name in (FIRST, SECOND):
        coarse, fine = families[name][SIZES[0]], families[name][SIZES[-1]]
        dissipated = [np.mean([energy_per_section(r)["fracture"] for r in results]) for results in (coarse, fine)]
        top = [np.mean([mpa(r) for r in results]) for results in (coarse, fine)]
        errors += [float(top[0] / top[1] - 1.0), float(dissipated[0] / dissipated[1] - 1.0)]
    return claim("Coarse blocks give enough accuracy", "6",
                 "218 against 540 cells: mean peak and fracture energy within 10 %",
                 f"mode 1: {100 * errors[0]:+.2g} % and {100 * errors[1]:+.2g} %; mode 2: {100 * errors[2]:+.2g} % and "
                 f"{100 * errors[3]:+.2g} %",
                 max(abs(value) for value in errors) < 0.1,
                 "cracks along coarse cells need more energy, because their faces are rougher")  # fmt: skip


def brittle_claim(families: Mapping[str, Results]) -> Claim:
    """The brittle law depends on blocks more."""
    soft, hard = (spread_of(peaks(families[name])) for name in (SECOND, BRITTLE))
    whole = [float(np.ptp([p for v in peaks(families[n]).values() for p in v])) for n in (SECOND, BRITTLE)]
    more = [hard.reach / soft.reach, whole[1] / hard.mean / (whole[0] / soft.mean)]
    return claim("Dependency on the blocks, known of brittle models, is considerably minimised by the fracture "
                 "energies", "conclusion 2",
                 "failure mode 2: peaks are further apart with the brittle law, between mean peaks of sizes and over "
                 "all runs",
                 f"sizes: {percent(hard.reach)} against {percent(soft.reach)}; all: {percent(whole[1] / hard.mean)} "
                 f"against {percent(whole[0] / soft.mean)}; mean peak {hard.mean:.4f} against {soft.mean:.4f} MPa",
                 min(more) > 1.0, "not here")  # fmt: skip

"""The claims on the size of blocks: what changes with it, held against what changes with the seed."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from masonry.results import Result
from verification.paper.crack_path import crack_path
from verification.paper.curve_shape import stress_at
from verification.paper.experiment import Claim, Done
from verification.paper.spread import spread_of
from verification.paper.straight_crack import STRAIGHT
from verification.paper.wallettes import MEGA, MILLI, crack_spread, mpa
from verification.report.page import percent

SIZES = (218, 335, 540)
FIRST, SECOND = "failure mode 1", "failure mode 2"
HELD, BRITTLE = "failure mode 2, plates do not turn", "failure mode 2, brittle"
SECTIONS = (0.125, 0.25, 0.375)
"""m: where a straight crack meets two head joints and two mid-lengths of units; all three are equally strong."""
POINTS = 300


@dataclass(frozen=True)
class Cells:
    """A division of the units into cells."""

    size: int
    seed: int

    def label(self, family: "Family") -> str:
        """The name of its run."""
        return f"{family.name}, {self.size} cells, seed {self.seed}"


@dataclass(frozen=True)
class Family:
    """A scene that is looked at with every division: its name, and a run's settings."""

    name: str
    scene: str
    settings: Mapping[str, Any] = field(default_factory=dict)
    halve: bool = False
    sudden: bool = False


Found = dict[int, list[Result]]
"""The results of a family by size."""


def gathered(done: Done, family: Family, divisions: Iterable[Cells]) -> Found:
    """All results of a family. Raises Missing where one did not come through."""
    found: Found = {}
    for cells in divisions:
        found.setdefault(cells.size, []).append(done[cells.label(family)])
    return found


def peaks(found: Found) -> dict[str, list[float]]:
    """Peaks in MPa by size."""
    return {str(size): [mpa(r) for r in results] for size, results in found.items()}


def mean_curve(results: list[Result], u: np.ndarray) -> np.ndarray:
    """Stress (Pa) at displacements u (m), the mean of all seeds."""
    return np.asarray(np.mean([stress_at(r, u) for r in results], axis=0))


def displacements(found: Found) -> np.ndarray:
    """Equal displacements (m) that all runs of a family made."""
    ends = [float(r.history.rows["displacement"][-1]) for results in found.values() for r in results]
    return np.linspace(0.0, min(ends), POINTS)


def curves_apart(found: Found) -> tuple[float, float]:
    """(sizes, seeds): mean difference of a size's curve from the coarsest one's, and of a seed's from its size's.

    Both over the peak; the worst size, and the mean seed.
    """
    u = displacements(found)
    mean = {size: mean_curve(results, u) for size, results in found.items()}
    peak = float(np.mean([p for values in peaks(found).values() for p in values])) / MEGA
    sizes = max(float(np.abs(mean[size] - mean[SIZES[0]]).mean()) for size in SIZES[1:])
    seeds = np.mean([np.abs(stress_at(r, u) - mean[size]).mean() for size, results in found.items() for r in results])
    return sizes / peak, float(seeds) / peak


def straight(found: Found) -> tuple[int, int, int]:
    """(cracks with a spread below a tenth of a unit, those of them at mid-length, all runs)."""
    spreads = [(crack_spread(r), r) for results in found.values() for r in results]
    narrow = [r for spread, r in spreads if spread < STRAIGHT]
    middle = sum(abs(crack_path(r).place()[0] - SECTIONS[1]) < STRAIGHT for r in narrow)
    return len(narrow), middle, len(spreads)


def claims(found: Mapping[str, Found], quick: bool) -> list[Claim]:
    """What section 6 and the conclusions say on size."""
    made = [curves_claim(found, FIRST, 0.05, "No response change in failure mode 1")]
    made.append(curves_claim(found, SECOND, 0.05, "Slightly different curves of the same trend in failure mode 2"))
    made += [pattern_claim(found), place_claim(found)]
    made += [capacity_claim(found, name, quick) for name in (FIRST, SECOND)]
    made.append(coarse_claim(found))
    return made if quick else [*made, brittle_claim(found)]


def curves_claim(found: Mapping[str, Found], name: str, limit: float, says: str) -> Claim:
    """The curves of the sizes against each other, beside what seeds do."""
    sizes, seeds = curves_apart(found[name])
    fine = sizes < limit
    return Claim(
        says,
        "6, Fig. 15",
        f"{name}: mean curves of 335 and 540 cells within {percent(limit)} of the peak of that of 218 cells",
        f"{percent(sizes)}; seeds of one size differ from its mean curve by {percent(seeds)}",
        fine,
        "" if fine else "the curve past the peak goes with the path that the division offers, at every size",
    )


def pattern_claim(found: Mapping[str, Found]) -> Claim:
    """One almost vertical crack at every size."""
    narrow, _, count = straight(found[SECOND])
    held = (
        f"; plates that do not turn: {straight(found[HELD])[0]} of {straight(found[HELD])[2]}" if HELD in found else ""
    )
    return Claim(
        "No difference in the fracture pattern: an almost vertical crack",
        "6, Fig. 16",
        f"failure mode 2: spread of the crack along the wall < {STRAIGHT * MILLI:.0f} mm in every run",
        f"{narrow} of {count}{held}",
        narrow == count,
        "" if narrow == count else "some cracks change from one section to another, or share the wall with a second",
    )


def place_claim(found: Mapping[str, Found]) -> Claim:
    """Whether it stands at mid-length."""
    narrow, middle, _ = straight(found[SECOND])
    fine = middle == narrow > 0
    return Claim(
        "The crack is at the mid-length of the specimen",
        "6, Fig. 16",
        f"failure mode 2: middle of the crack within {STRAIGHT * MILLI:.0f} mm of {SECTIONS[1] * MILLI:.0f} mm",
        f"{middle} of {narrow}",
        fine,
        ""
        if fine
        else "the sections at 125, 250 and 375 mm each hold two head joints and two mid-lengths of units, and are "
        "equally "
        "strong: the cells decide. The units' mid-length is met in all of them",
    )


def capacity_claim(found: Mapping[str, Found], name: str, quick: bool) -> Claim:
    """How far peaks differ by size, and whether it is chance."""
    by_size = peaks(found[name])
    means = {size: float(np.mean(values)) for size, values in by_size.items()}
    reach = (max(means.values()) - min(means.values())) / float(np.mean(list(means.values())))
    told = ""
    if not quick:
        spread = spread_of(by_size)
        told = (
            f"; by seed ± {percent(spread.within / spread.mean)}, by size ± {percent(spread.between / spread.mean)} "
            f"beyond chance (p = {spread.chance:.2g})"
        )
    return Claim(
        f"No severe block size dependency and capacity difference, {name}",
        "6, conclusion 2",
        "mean peaks of the three sizes within 5 % of each other",
        " / ".join(f"{m:.4f}" for m in means.values()) + f" MPa, {percent(reach)} apart{told}",
        reach < 0.05,
        "" if reach < 0.05 else "the peak goes with the size",
    )


def coarse_claim(found: Mapping[str, Found]) -> Claim:
    """Coarse against fine cells: peak and energy."""
    off = []
    for name in (FIRST, SECOND):
        coarse, fine = found[name][SIZES[0]], found[name][SIZES[-1]]
        spent = [np.mean([_fracture(r) for r in results]) for results in (coarse, fine)]
        top = [np.mean([mpa(r) for r in results]) for results in (coarse, fine)]
        off += [float(top[0] / top[1] - 1.0), float(spent[0] / spent[1] - 1.0)]
    good = max(abs(value) for value in off) < 0.1
    return Claim(
        "Coarse blocks give enough accuracy",
        "6",
        "218 against 540 cells: mean peak and fracture energy within 10 %",
        f"mode 1: {100 * off[0]:+.2g} % and {100 * off[1]:+.2g} %; mode 2: {100 * off[2]:+.2g} % and "
        f"{100 * off[3]:+.2g} %",
        good,
        "" if good else "coarse cells cost more energy: their faces are rougher",
    )


def brittle_claim(found: Mapping[str, Found]) -> Claim:
    """The brittle law depends on blocks more."""
    soft, hard = (spread_of(peaks(found[name])) for name in (SECOND, BRITTLE))
    whole = [float(np.ptp([p for v in peaks(found[n]).values() for p in v])) for n in (SECOND, BRITTLE)]
    more = [hard.reach / soft.reach, whole[1] / hard.mean / (whole[0] / soft.mean)]
    fine = min(more) > 1.0
    return Claim(
        "Dependency on the blocks, known of brittle models, is considerably minimised by the fracture energies",
        "conclusion 2",
        "failure mode 2: peaks are further apart with the brittle law, between mean peaks of sizes and over all runs",
        f"sizes: {percent(hard.reach)} against {percent(soft.reach)}; all: {percent(whole[1] / hard.mean)} against "
        f"{percent(whole[0] / soft.mean)}; mean peak {hard.mean:.4f} against {soft.mean:.4f} MPa",
        fine,
        "" if fine else "not here",
    )


def _fracture(result: Result) -> float:
    energy = result.summary["energy_j"]
    return float(energy["fracture_mode_1"] + energy["fracture_mode_2"])

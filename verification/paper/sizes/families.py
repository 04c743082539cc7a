"""Runs of one scene with blocks of several sizes and seeds: their names, their mean curves, where they cracked."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from masonry.laboratory.result import Result
from masonry.pictures.style import MEGA
from verification.paper.experiment import Done
from verification.paper.walls.common import crack_spread, mpa
from verification.paper.walls.crack_path import crack_path
from verification.paper.walls.curve_shape import stress_at
from verification.paper.walls.straight_crack import STRAIGHT

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
    pace_check: bool = False
    sudden: str = ""


Results = dict[int, list[Result]]
"""The results of a family by size."""


def gathered(done: Done, family: Family, divisions: Iterable[Cells]) -> Results:
    """All results of a family. Raises Missing where one did not come through."""
    by_division: Results = {}
    for cells in divisions:
        by_division.setdefault(cells.size, []).append(done[cells.label(family)])
    return by_division


def peaks(by_division: Results) -> dict[str, list[float]]:
    """Peaks in MPa by size."""
    return {str(size): [mpa(r) for r in results] for size, results in by_division.items()}


def mean_curve(results: list[Result], u: np.ndarray) -> np.ndarray:
    """Stress (Pa) at displacements u (m), the mean of all seeds."""
    return np.asarray(np.mean([stress_at(r, u) for r in results], axis=0))


def displacements(by_division: Results) -> np.ndarray:
    """Equal displacements (m) that all runs of a family made."""
    ends = [float(r.history.rows["displacement"][-1]) for results in by_division.values() for r in results]
    return np.linspace(0.0, min(ends), POINTS)


def curves_apart(by_division: Results) -> tuple[float, float]:
    """(sizes, seeds): mean difference of a size's curve from the coarsest one's, and of a seed's from its size's.

    Both over the peak; the worst size, and the mean seed.
    """
    u = displacements(by_division)
    mean = {size: mean_curve(results, u) for size, results in by_division.items()}
    peak = float(np.mean([p for values in peaks(by_division).values() for p in values])) / MEGA
    sizes = max(float(np.abs(mean[size] - mean[SIZES[0]]).mean()) for size in SIZES[1:])
    seeds = np.mean(
        [np.abs(stress_at(r, u) - mean[size]).mean() for size, results in by_division.items() for r in results]
    )
    return sizes / peak, float(seeds) / peak


def straight(by_division: Results) -> tuple[int, int, int]:
    """(cracks with a spread below a tenth of a unit, those of them at mid-length, all runs)."""
    spreads = [(crack_spread(r), r) for results in by_division.values() for r in results]
    narrow = [r for spread, r in spreads if spread < STRAIGHT]
    middle = sum(abs(crack_path(r).place()[0] - SECTIONS[1]) < STRAIGHT for r in narrow)
    return len(narrow), middle, len(spreads)

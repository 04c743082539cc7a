"""The stochastic sequel: what the paper leaves out, strengths and energies that differ from joint to joint."""

from typing import Any

import numpy as np

from masonry.pictures.style import MEGA
from verification.html import page
from verification.html.page import percent
from verification.paper.ensembles.bands import bands, frequencies
from verification.paper.ensembles.claims import claims, paths_text
from verification.paper.ensembles.realisations import Ensemble, ensemble
from verification.paper.experiment import ACCURACY, Done, Experiment, Run, Section

SCENES = {"failure mode 1": "wallette-mode-1", "failure mode 2": "wallette-mode-2"}
VARIATION = {"unit_unit": 0.3, "within_units": 0.2}
"""Coefficients of variation, of strengths and energies alike: an assumption."""
PROPERTIES = ("tensile_strength", "cohesion", "fracture_energy_mode_1", "fracture_energy_mode_2")
KINDS = {"correlated": 1.0, "independent": 0.0}
"""Correlation of the logarithms of the properties of one joint."""
COUNTS, QUICK_COUNTS = {"correlated": 30, "independent": 15}, {"correlated": 4, "independent": 2}
"""Walls of each kind."""
PACE = {ACCURACY: "2 %"}
"""From 1 % on it moves the peak of a wall by 0.1 %, where the scatter moves it by over 10 %."""
SUDDEN = {
    ("failure mode 2", "correlated", 8): "6.0, 4.1, 2.7, 2.4, 2.3 % at accuracies of 1, 0.5, 0.25, 0.15, 0.1 %, and a "
    "peak within 0.2 %: the jump is the wall's own"
}
"""Walls in which a crack runs by itself, and how that is known."""
CHECKED = 3
"""Correlated walls of each scene that are made again with twice the loading error."""
INTRODUCTION = (
    "In the paper all joints have the same properties: variation is 'not taken into consideration'. Here each joint "
    "(a pair of units that meet) draws its strengths and fracture energies, and each unit its own, from lognormal "
    "distributions around the values of Tables 3 and 4, with coefficients of variation of 30 % for joints and 20 % for "
    "units. These are assumptions: the bond of brickwork is commonly found to vary by about 0.3, with which "
    "probabilistic studies of brick walls, such as reference 41 of the paper, work; of the paper's own bricks no "
    "variation is known. Once all properties of a joint go together (correlated), once each is drawn for itself "
    "(independent)."
)
HEADER = (
    *("scene", "properties", "walls", "peak without scatter [MPa]", "mean peak [MPa]", "5 to 95 % of the peaks [MPa]"),
    *("variation of the peak", "cracks", "crack patterns", "mode I of fracture energy (without scatter)"),
)


def settings(kind: str, seed: int) -> dict[str, Any]:
    """A wall whose joints and units draw their properties."""
    drawn = {f"scatter.{group}.{key}": v for group, v in VARIATION.items() for key in PROPERTIES}
    return {"scatter.seed": seed, **drawn, **{f"scatter.{group}.correlation": KINDS[kind] for group in VARIATION}}


def walls(mode: str, kind: str, quick: bool) -> list[str]:
    """The labels of the walls that scatter."""
    return [f"{mode}, {kind}, seed {seed}" for seed in range(1, 1 + (QUICK_COUNTS if quick else COUNTS)[kind])]


def runs(quick: bool) -> dict[str, Run]:
    """Each scene once without scatter, and its walls."""
    made = {mode: Run(scene, PACE) for mode, scene in SCENES.items()}
    for mode, scene in SCENES.items():
        for kind in KINDS:
            for seed, label in enumerate(walls(mode, kind, quick), 1):
                pace_check = kind == "correlated" and seed <= CHECKED
                sudden = SUDDEN.get((mode, kind, seed), "")
                made[label] = Run(scene, {**settings(kind, seed), **PACE}, pace_check, sudden)
    return made


def show(done: Done) -> Section:
    """Bands, distributions and crack frequencies, each mode beside its wall without scatter."""
    modes = {
        mode: (ensemble(done, [mode]), {kind: ensemble(done, walls(mode, kind, done.quick)) for kind in KINDS})
        for mode in SCENES
    }
    made = Section([page.paragraph(INTRODUCTION)])
    made.parts += [
        page.picture(bands(modes), "Above: stress at each displacement, of most walls. Below: their peaks in order."),
        page.picture(frequencies(modes), "How often each joint, and each face within a unit, is broken at the end."),
        page.table(HEADER, [line(mode, kind, *both) for mode, both in modes.items() for kind in KINDS]),
    ]
    made.claims += claims(modes)
    for mode, (alone, kinds) in modes.items():
        for kind, results in kinds.items():
            label = walls(mode, kind, done.quick)[0]
            made.records.append(
                done.record(
                    label, f"mean peak, {kind}", float(results.peaks.mean()), "Pa", alone.peaks[0], "no scatter"
                )
            )
    return made


def line(mode: str, kind: str, alone: Ensemble, kinds: dict[str, Ensemble]) -> list[str]:
    """A row of the table."""
    results = kinds[kind]
    low, high = np.quantile(results.peaks, [0.05, 0.95]) * MEGA
    opening = np.mean([wall.by_opening for wall in results.walls])
    return [
        *(mode, kind, f"{len(results.walls)}", f"{alone.peaks[0] * MEGA:.4f}", f"{results.peaks.mean() * MEGA:.4f}"),
        *(f"{low:.4f} to {high:.4f}", percent(results.variation), paths_text(results), f"{results.patterns}"),
        f"{100.0 * opening:.0f} % ({100.0 * alone.walls[0].by_opening:.0f} %)",
    ]


EXPERIMENT = Experiment("scatter", "The stochastic sequel: joints that differ in strength", 90, runs, show)

"""Claims of the paper on variation, held against walls whose properties scatter."""

from collections.abc import Mapping

import numpy as np

from verification.html.page import percent
from verification.paper.ensembles.realisations import Ensemble
from verification.paper.experiment import Claim, claim

WIDE = 0.1
"""Of the mean peak: a band that one test, or one run, cannot stand for."""
FEW = 10
"""Walls of which nothing can be told."""
ONE_PATH = (
    "the sentence is about walls in bending; in these two scenes one way is far weaker than the other, by hand (bed "
    "joints by their cohesion, heads and units by their tensile strength) 0.25 MPa stepped against 0.77 straight in "
    "mode 1, 0.5 against 0.225 in mode 2, and scatter of 20 to 30 % does not make up for it"
)
Modes = Mapping[str, tuple[Ensemble, Mapping[str, Ensemble]]]


def each(modes: Modes) -> list[tuple[str, Ensemble, Ensemble]]:
    """(name, the wall without scatter, walls with it) for each mode and kind."""
    return [(f"{mode}, {kind}", alone, w) for mode, (alone, kinds) in modes.items() for kind, w in kinds.items()]


def told(modes: Modes, says: str, source: str, check: str, measured: str, holds: bool, why: str) -> Claim:
    """A claim, or where there are few walls (a quick look) one that cannot be decided."""
    minimum = min(len(w.walls) for _, _, w in each(modes))
    if minimum < FEW:
        return claim(says, source, check, measured, None, f"{minimum} walls are too few to tell")
    return claim(says, source, check, measured, holds, why)


def paths_text(walls: Ensemble) -> str:
    """ "28 straight, 2 mixed"."""
    return ", ".join(f"{count} {path}" for path, count in walls.paths.items() if count)


def envelope_claim(modes: Modes) -> Claim:
    """Peaks differ by more than a tenth, and so do the places that break."""
    widths = {name: float(np.ptp(np.quantile(w.peaks, [0.05, 0.95])) / w.peaks.mean()) for name, _, w in each(modes)}
    patterns = {name: w.patterns for name, _, w in each(modes)}
    shown = "; ".join(f"{name}: {percent(widths[name])}, {patterns[name]} patterns" for name in widths)
    holds = min(widths.values()) > WIDE and min(patterns.values()) > 1
    return told(modes, "Properties vary so much that an envelope of test results and fracture patterns should be "
                "obtained", "7",
                f"5 to 95 % of the peaks span over {percent(WIDE)} of their mean, and more than one set of places "
                "breaks",
                shown,
                holds, "the peak hardly depends on which joints are weak")  # fmt: skip


def qualitative_claim(modes: Modes) -> Claim:
    """Most walls with scatter crack along the path of the one without."""
    alike = {name: w.paths[alone.walls[0].path] / len(w.walls) for name, alone, w in each(modes)}
    holds = min(alike.values()) > 0.8
    return told(modes, "Variation is not considered; the crack patterns found without it are satisfying qualitatively",
                "6",
                "over 80 % of the walls with scatter crack in the same way (stepped, straight, mixed) as the one "
                "without",
                "; ".join(f"{name}: {100.0 * alike[name]:.0f} % {alone.walls[0].path} as without"
                for name, alone, _ in each(modes)),
                holds, "which way a crack goes depends on which joints and units are weak")  # fmt: skip


def mixed_claim(modes: Modes) -> Claim:
    """Within a scene cracks are stepped, straight or both, by what was drawn."""
    paths = {
        mode: {path for w in kinds.values() for path in w.paths if w.paths[path]} for mode, (_, kinds) in modes.items()
    }
    holds = any(len(found) > 1 for found in paths.values())
    return told(modes, "Stepped and straight cracks occur at once or by themselves, among other things because "
                "properties vary", "6",
                "walls of one scene that differ by what is drawn alone crack in more than one way",
                "; ".join(f"{name}: {paths_text(w)}" for name, _, w in each(modes)),
                holds, ONE_PATH)  # fmt: skip


def weakest_claim(modes: Modes) -> Claim:
    """A wall is weaker than its mean joint: the mean peak falls by more than chance explains."""
    falls, sure = {}, {}
    for name, alone, w in each(modes):
        falls[name] = 1.0 - float(w.peaks.mean() / alone.peaks[0])
        sure[name] = 2.0 * w.variation / np.sqrt(len(w.walls))
    holds = all(falls[name] > sure[name] for name in falls)
    return told(modes, "Scatter costs strength: weak joints break first and hand on their load", "beyond the paper",
                "the mean peak is below that without scatter by more than twice its standard error",
                "; ".join(f"{name}: lower by {percent(falls[name])} (± {percent(sure[name])})" for name in falls),
                holds, f"too few walls to tell, or no loss, in "
                f"{', '.join(n for n in falls if falls[n] <= sure[n])}")  # fmt: skip


def averaging_claim(modes: Modes) -> Claim:
    """Several joints carry together: peaks vary less than joints do."""
    variations = {name: w.variation for name, _, w in each(modes)}
    holds = max(variations.values()) < 0.3
    return told(modes, "A wall varies less than its joints, which share the load", "beyond the paper",
                "variation of the peak below the 30 % of the joints",
                "; ".join(f"{name}: {percent(value)}" for name, value in variations.items()),
                holds, "the peak depends on single joints")  # fmt: skip


def claims(modes: Modes) -> list[Claim]:
    """All of them."""
    return [
        claim_on(modes) for claim_on in (envelope_claim, qualitative_claim, mixed_claim, weakest_claim, averaging_claim)
    ]

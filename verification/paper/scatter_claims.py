"""What the paper says of variation, held against walls whose properties scatter."""

from collections.abc import Mapping

import numpy as np

from verification.paper.experiment import Claim
from verification.paper.realisations import Ensemble
from verification.report.page import percent

MEGA = 1e-6
WIDE = 0.1
"""Of the mean peak: a band that one test, or one run, cannot stand for."""
Modes = Mapping[str, tuple[Ensemble, Mapping[str, Ensemble]]]


def each(modes: Modes) -> list[tuple[str, Ensemble, Ensemble]]:
    """(name, the wall without scatter, walls with it) for each mode and kind."""
    return [(f"{mode}, {kind}", alone, w) for mode, (alone, kinds) in modes.items() for kind, w in kinds.items()]


def envelope_claim(modes: Modes) -> Claim:
    """Peaks differ by more than a tenth, and so do the places that break."""
    widths = {name: float(np.ptp(np.quantile(w.peaks, [0.05, 0.95])) / w.peaks.mean()) for name, _, w in each(modes)}
    patterns = {name: w.patterns for name, _, w in each(modes)}
    shown = "; ".join(f"{name}: {percent(widths[name])}, {patterns[name]} patterns" for name in widths)
    holds = min(widths.values()) > WIDE and min(patterns.values()) > 1
    return Claim(
        "Properties vary so much that an envelope of test results and fracture patterns should be obtained",
        "7",
        f"5 to 95 % of the peaks span over {percent(WIDE)} of their mean, and more than one set of places breaks",
        shown,
        holds,
        "" if holds else "the peak hardly feels which joints are weak",
    )


def qualitative_claim(modes: Modes) -> Claim:
    """The wall without scatter is a usual one among those with it."""
    above = {name: float(np.mean(w.peaks < alone.peaks[0])) for name, alone, w in each(modes)}
    holds = all(0.05 <= share <= 0.95 for share in above.values())
    return Claim(
        "Without variation of the properties the results are satisfying qualitatively",
        "6",
        "the peak without scatter is among the middle 90 % of the peaks with it",
        "; ".join(f"{name}: above {percent(share)} of the walls" for name, share in above.items()),
        holds,
        "" if holds else "one strength for all joints is more than walls with weak and strong ones reach",
    )


def mixed_claim(mode: tuple[Ensemble, Mapping[str, Ensemble]]) -> Claim:
    """Cracks take joints alone, units alone or both, by what was drawn."""
    ways = {kind: w.ways for kind, w in mode[1].items()}
    seen = np.sum(list(ways.values()), axis=0)
    shown = "; ".join(f"{kind}: {a} / {b} / {c}" for kind, (a, b, c) in ways.items())
    holds = bool(np.count_nonzero(seen) > 1)
    return Claim(
        "Stepped and straight cracks occur at once or by themselves, due among other things to varying properties",
        "6",
        "among walls of one scene (failure mode 2) that differ by what is drawn alone, more than one kind is found",
        f"through joints alone / both / units alone: {shown} walls",
        holds,
        "" if holds else "all cracks are of one kind here",
    )


def weakest_claim(modes: Modes) -> Claim:
    """A wall is weaker than its mean joint: the mean peak falls by more than chance explains."""
    falls, sure = {}, {}
    for name, alone, w in each(modes):
        falls[name] = 1.0 - float(w.peaks.mean() / alone.peaks[0])
        sure[name] = 2.0 * w.variation / np.sqrt(len(w.walls))
    holds = all(falls[name] > sure[name] for name in falls)
    return Claim(
        "Scatter costs strength: weak joints break first and hand on their load",
        "beyond the paper",
        "the mean peak is below that without scatter by more than twice its standard error",
        "; ".join(f"{name}: lower by {percent(falls[name])} (± {percent(sure[name])})" for name in falls),
        holds,
        "" if holds else f"too few walls to tell, or no loss, in {', '.join(n for n in falls if falls[n] <= sure[n])}",
    )


def averaging_claim(modes: Modes) -> Claim:
    """Several joints carry together: peaks vary less than joints do."""
    variations = {name: w.variation for name, _, w in each(modes)}
    holds = max(variations.values()) < 0.3
    return Claim(
        "A wall varies less than its joints, which share the load",
        "beyond the paper",
        "variation of the peak below the 30 % of the joints",
        "; ".join(f"{name}: {percent(value)}" for name, value in variations.items()),
        holds,
        "" if holds else "the peak hangs on single joints",
    )

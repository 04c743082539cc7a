"""How sound runs are: energy balance, forces at both ends, and how far twice the loading error moves a peak."""

from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np

from masonry.laboratory.result import Result
from verification.paper.experiment import COARSER, Claim, Done, claim

IMBALANCE, MISMATCH, MOVED = 1e-6, 0.02, 0.01
NAMED = 4
"""Of the runs beyond a limit, the worst."""


def soundness(done: Done) -> list[Claim]:
    """A claim each on the runs that ended, on energy, on end forces, and on the pace where runs were made twice."""
    fine = [label for label in done if done.has(label)]
    failed = [f"{label} ({done.rows[label]['reason']})" for label in done if not done.has(label)]
    made = [
        claim(
            "Every run comes to its end",
            "this program",
            "no run is refused or stopped",
            f"{len(fine)} of {len(done.runs)}",
            not failed,
            "; ".join(failed),
        )
    ]
    if not fine:
        return made
    made.append(_largest(_column(done, fine, "energy_imbalance"), IMBALANCE, "The energy balance closes",
                         "imbalance over work"))  # fmt: skip
    ends, differ = "difference over the peak", ends_that_differ(done)
    if done.refined:
        ends += f" (of which {len(done.refined)} were made again with less loading error)"
    steady = {label: mismatch for label, mismatch in differ.items() if not done.runs[label].sudden}
    if steady:
        made.append(_largest(steady, MISMATCH, "Both ends carry the same force", ends))
    sudden = {label: mismatch for label, mismatch in differ.items() if done.runs[label].sudden}
    if sudden:
        reasons = "; ".join(sorted({done.runs[label].sudden for label in sudden}))
        before = _largest(sudden, MISMATCH, "So do they before the peak where a specimen gives way at once", ends)
        made.append(replace(before, why="; ".join(filter(None, (before.why, f"at once: {reasons}")))))
    if moved := peaks_that_move(done):
        made.append(_largest(moved, MOVED, "Twice the loading error hardly moves a peak", "change of the peak"))
    return made


def careless(done: Done) -> list[str]:
    """The runs that are to be loaded more carefully: their ends differ, or twice their loading error moves the peak."""
    exceeding = [label for label, mismatch in ends_that_differ(done).items() if mismatch >= MISMATCH]
    exceeding += [label for label, error in peaks_that_move(done).items() if error >= MOVED]
    return [label for label in dict.fromkeys(exceeding) if done.runs[label].refinable]


def ends_that_differ(done: Done) -> dict[str, float]:
    """Largest difference between the forces of the two ends of each run, over its peak: of a specimen that gives way at
    once before the peak. Runs against which a peak is held are left out.
    """
    fine = [label for label in done.asked if done.has(label)]
    differ = _column(done, [label for label in fine if not done.runs[label].sudden], "reaction_mismatch_max")
    return differ | {label: mismatch_before_peak(done[label]) for label in fine if done.runs[label].sudden}


def peaks_that_move(done: Done) -> dict[str, float]:
    """By how much twice the loading error moves the peak of each run that asks for it, as a share."""
    peaks = _column(done, [label for label in done if done.has(label)], "peak_stress_pa")
    pairs = {label: COARSER.format(label) for label in done if done.runs[label].pace_check}
    return {
        label: abs(peaks[coarser] / peaks[label] - 1.0)
        for label, coarser in pairs.items()
        if label in peaks and coarser in peaks
    }


def mismatch_before_peak(result: Result) -> float:
    """Largest difference of the stresses at drive and support before the row of the peak, over the peak."""
    rows = result.history.rows
    until = max(int(np.argmax(rows["stress"])), 1)
    apart = np.abs(rows["stress"] - rows["support_stress"])[:until]
    return float(apart.max() / rows["stress"].max())


def _column(done: Done, labels: list[str], key: str) -> dict[str, float]:
    return {label: float(done.rows[label][key]) for label in labels if key in done.rows[label]}


def _largest(values: Mapping[str, float], limit: float, says: str, what: str) -> Claim:
    """The largest of the values against a limit; says whose it is."""
    show: Callable[[float], str] = lambda v: f"{v:.1e}" if limit < 1e-3 else f"{100.0 * v:.2g} %"  # noqa: E731
    order = sorted(values, key=lambda label: -values[label])
    exceeding = [f"{label} ({show(values[label])})" for label in order if values[label] >= limit]
    more = f" and {len(exceeding) - NAMED} more" if len(exceeding) > NAMED else ""
    return claim(says, "this program",
                 f"{what} < {show(limit)} in each of {len(values)} runs",
                 f"at most {show(values[order[0]])} ({order[0]})",
                 not exceeding, f"beyond it: {', '.join(exceeding[:NAMED])}{more}" if exceeding else "")  # fmt: skip

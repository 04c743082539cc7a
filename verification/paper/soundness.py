"""How sound runs are: the energy balance, the forces at both ends, and how far half the loading error moves a peak."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from masonry.laboratory.result import Result
from verification.paper.experiment import Claim, Done, claim

IMBALANCE, MISMATCH, MOVED = 1e-6, 0.02, 0.01
NAMED = 4
"""Of the runs beyond a limit, the worst."""
HALVED = "{}, at half the accuracy"
"""The label of a run made again with half the error of loading."""


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
    rows = {label: done.rows[label] for label in fine}
    made.append(_within(rows, "energy_imbalance", IMBALANCE, "The energy balance closes", "imbalance over work"))
    steady = {label: row for label, row in rows.items() if not done.runs[label].sudden}
    ends = "difference over the peak"
    if steady:
        made.append(_within(steady, "reaction_mismatch_max", MISMATCH, "Both ends carry the same force", ends))
    sudden = {label: mismatch_before_peak(done[label]) for label in rows if done.runs[label].sudden}
    if sudden:
        reasons = "; ".join(sorted({done.runs[label].sudden for label in sudden}))
        before = _largest(sudden, MISMATCH, "So do they before the peak where a specimen gives way at once", ends)
        made.append(replace(before, why="; ".join(filter(None, (before.why, f"at once: {reasons}")))))
    moved = {
        label: abs(done.peak(label) / done.peak(HALVED.format(label)) - 1.0)
        for label in fine
        if done.runs[label].halve and done.has(HALVED.format(label))
    }
    if moved:
        made.append(_largest(moved, MOVED, "Half the loading error hardly moves a peak", "change of the peak"))
    return made


def mismatch_before_peak(result: Result) -> float:
    """Largest difference of the stresses at drive and support before the row of the peak, over the peak."""
    rows = result.history.rows
    until = max(int(np.argmax(rows["stress"])), 1)
    apart = np.abs(rows["stress"] - rows["support_stress"])[:until]
    return float(apart.max() / rows["stress"].max())


def _within(rows: Mapping[str, Mapping[str, Any]], key: str, limit: float, says: str, what: str) -> Claim:
    return _largest({label: float(row[key]) for label, row in rows.items()}, limit, says, what)


def _largest(values: Mapping[str, float], limit: float, says: str, what: str) -> Claim:
    """The largest of the values against a limit; says whose it is."""
    show: Callable[[float], str] = lambda v: f"{v:.1e}" if limit < 1e-3 else f"{100.0 * v:.2g} %"  # noqa: E731
    order = sorted(values, key=lambda label: -values[label])
    beyond = [f"{label} ({show(values[label])})" for label in order if values[label] >= limit]
    more = f" and {len(beyond) - NAMED} more" if len(beyond) > NAMED else ""
    return claim(says, "this program",
                 f"{what} < {show(limit)} in each of {len(values)} runs",
                 f"at most {show(values[order[0]])} ({order[0]})",
                 not beyond, f"beyond it: {', '.join(beyond[:NAMED])}{more}" if beyond else "")  # fmt: skip

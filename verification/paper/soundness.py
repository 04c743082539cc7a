"""How sound runs are: the energy balance, the forces at both ends, and how far half the loading error moves a peak."""

from collections.abc import Callable, Mapping
from typing import Any

from verification.paper.experiment import Claim, Done

IMBALANCE, MISMATCH, MOVED = 1e-6, 0.02, 0.01
HALVED = "{}, at half the accuracy"
"""The label of a run made again with half the error of loading."""


def soundness(done: Done) -> list[Claim]:
    """A claim each on the runs that ended, on energy, on end forces, and on the pace where runs were made twice."""
    fine = [label for label in done if done.has(label)]
    failed = [f"{label} ({done.rows[label]['reason']})" for label in done if not done.has(label)]
    made = [
        Claim(
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
    ends = {label: end_mismatch(done, label) for label in fine}
    made.append(_largest(ends, MISMATCH, "Both ends carry the same force", "difference over the peak"))
    moved = {
        label: abs(done.peak(label) / done.peak(HALVED.format(label)) - 1.0)
        for label in fine
        if done.runs[label].halve and done.has(HALVED.format(label))
    }
    if moved:
        made.append(_largest(moved, MOVED, "Half the loading error hardly moves a peak", "change of the peak"))
    return made


def end_mismatch(done: Done, label: str) -> float:
    """Largest difference between the forces of both ends over the peak; of sudden runs before their peak."""
    if not done.runs[label].sudden:
        return float(done.rows[label]["reaction_mismatch_max"])
    rows = done[label].history.rows
    until = slice(0, max(int(rows["stress"].argmax()), 1))
    return float(abs(rows["stress"] - rows["support_stress"])[until].max() / done.peak(label))


def _within(rows: Mapping[str, Mapping[str, Any]], key: str, limit: float, says: str, what: str) -> Claim:
    return _largest({label: float(row[key]) for label, row in rows.items()}, limit, says, what)


def _largest(values: Mapping[str, float], limit: float, says: str, what: str) -> Claim:
    """The largest of the values against a limit; says whose it is."""
    show: Callable[[float], str] = lambda v: f"{v:.1e}" if limit < 1e-3 else f"{100.0 * v:.2g} %"  # noqa: E731
    worst = max(values, key=lambda label: values[label])
    beyond = [label for label, value in values.items() if value >= limit]
    return Claim(
        says,
        "this program",
        f"{what} < {show(limit)} in each of {len(values)} runs",
        f"at most {show(values[worst])} ({worst})",
        not beyond,
        f"beyond it: {', '.join(f'{label} ({show(values[label])})' for label in beyond)}" if beyond else "",
    )

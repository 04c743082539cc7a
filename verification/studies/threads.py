"""The knob of threads: seconds may change with their number, and no bit of the results."""

from collections.abc import Mapping, Sequence

import numpy as np

from verification import timed_run
from verification.html import page
from verification.records import Record
from verification.scene_runs import SceneRun
from verification.studies.refinement import Study
from verification.timed_run import THREADS


def apart(runs: Mapping[str, SceneRun]) -> dict[str, float]:
    """Setting -> largest difference of any row from the first's, over the largest value of its kind; 0.0 if none."""
    first, *others = runs.items()
    return {label: _difference(first[1], run) for label, run in others}


def _difference(first: SceneRun, second: SceneRun) -> float:
    if not (first.ok and second.ok) or any(len(first.rows[key]) != len(second.rows[key]) for key in first.rows):
        return float("inf")
    worst = 0.0
    for key, values in first.rows.items():
        gap = float(np.abs(second.rows[key] - values).max(initial=0.0))
        size = float(np.abs(values).max(initial=0.0))
        worst = max(worst, gap / size if size else gap)
    return worst


def records(study: Study) -> list[Record]:
    """One for each number of threads beyond the first."""
    runs = study.runs.get(THREADS, {})
    return [
        timed_run.record(runs[label], "rows against those of one thread", value, 0.0, "invariance", 1.0)
        | {"case": study.problem.name, "knob": THREADS, "rung": label}
        for label, value in (apart(runs) if runs else {}).items()
    ]


def verdict(studies: Sequence[Study]) -> list[page.Verdict]:
    """Whether all problems with this knob give the same bits, and what more threads gain; nothing where none has it."""
    sentences, worst = [], 0.0
    for study in studies:
        runs = list(study.runs.get(THREADS, {}).values())
        if runs:
            worst = max(worst, *apart(study.runs[THREADS]).values())
            sentences.append(f"{study.problem.title} {runs[0].seconds / runs[-1].seconds:.2g}")
    if not sentences:
        return []
    same = "gives the same bits in every row" if worst == 0.0 else f"changes rows by up to {worst:.0e} of the largest"
    sentence = f"Another number of threads {same}. Two are quicker than one by a factor of: {'; '.join(sentences)}."
    return [page.Verdict("Threads", "ok" if worst == 0.0 else "bad", sentence)]

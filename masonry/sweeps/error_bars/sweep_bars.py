"""Bars of a sweep: a few of its runs are refined, and the others take theirs from the nearest of these."""

from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from masonry.runtime.progress import Tell
from masonry.scene import Scene, changed, load
from masonry.sweeps.convergence.convergence import Runner
from masonry.sweeps.convergence.error_record import record_in_base
from masonry.sweeps.convergence.refinement.campaign import Campaign
from masonry.sweeps.convergence.refinement.numerical_errors import NumericalError
from masonry.sweeps.job import Job, names
from masonry.sweeps.pictures.varied_keys import keys_that_vary
from masonry.sweeps.planned_runs import Planned
from masonry.sweeps.read import Sweep
from masonry.sweeps.run_store import Row
from masonry.sweeps.sweep_run import Running
from masonry.sweeps.sweep_table import ERROR_BAR
from masonry.sweeps.work import OK

REFINED = "refined"


def refining(sweep: Sweep, running: Running) -> Running:
    """The same, with bars of as many runs as a sweep asks for."""
    return running._replace(refine=partial(bar_columns, sweep.error_bars))


def bar_columns(
    count: int, folder: Path, planned: Sequence[Planned], rows: Sequence[Row], running: Running, tell: Tell | None
) -> dict[str, list[Any]]:
    """Columns of the bars of a sweep whose runs are done, after refining `count` of them into the same folder.

    How a run has come to its bars, then `KEY limit` and `KEY half_width` (SI) of each number; None where there is none.
    """
    places = places_of(planned)
    ended = [number for number, row in enumerate(rows) if row["status"] == OK]
    chosen = farthest_apart(places, ended, count)
    refined: dict[int, list[NumericalError]] = {}
    called = names([planned[number].job for number in chosen])
    for number, name in zip(chosen, called, strict=True):
        if tell is not None:
            tell(f"run {number}, {name}, is refined")
        errors = _errors_of(planned[number].job, folder, running, tell)
        if errors:
            refined[number] = errors
    return carried_over(places, rows, refined)


def _errors_of(job: Job, folder: Path, running: Running, tell: Tell | None) -> list[NumericalError]:
    """The errors of the numbers of a run that is in the folder; none where nothing can be refined."""
    campaign = Campaign(
        changed(job.scene, job.settings) if isinstance(job.scene, Scene) else load(job.scene, job.settings)
    )
    if not campaign.resolutions:
        return []
    runner = Runner(folder, (), workers=running.workers, executor=running.executor, tell=tell)
    errors, done = runner.measured(campaign)
    record_in_base(folder, errors, done)
    return errors


def places_of(planned: Sequence[Planned]) -> np.ndarray:
    """(N, K), by run and key that varies: the place of its value among those of this key, from 0 to 1; values that are
    no numbers in the order in which they come."""
    columns = []
    for key in keys_that_vary(planned):
        values: Sequence[Any] = key.texts if key.numbers is None else key.numbers
        distinct = list(dict.fromkeys(values)) if key.numbers is None else sorted(set(values))
        columns.append([distinct.index(value) / max(len(distinct) - 1, 1) for value in values])
    return np.array(columns, dtype=float).T.reshape(len(planned), -1)


def farthest_apart(places: np.ndarray, ended: Sequence[int], count: int) -> list[int]:
    """Numbers of so many runs among those that ended: the one in the middle where one is asked for; else one at an
    end, then always the run that is farthest from all that are chosen."""
    if not ended:
        return []
    here = places[list(ended)]
    middle = np.linalg.norm(here - 0.5, axis=1)
    chosen = [int(np.argmin(middle) if count == 1 else np.argmax(middle))]
    while len(chosen) < min(count, len(ended)):
        gaps = np.min([np.linalg.norm(here - here[k], axis=1) for k in chosen], axis=0)
        gaps[chosen] = -1.0
        chosen.append(int(np.argmax(gaps)))
    return sorted(ended[k] for k in chosen)


def carried_over(
    places: np.ndarray, rows: Sequence[Row], refined: dict[int, list[NumericalError]]
) -> dict[str, list[Any]]:
    """The columns of bars: those of runs that were refined, and relative to their numbers those of the nearest of these
    for all others that ended."""
    bars = [_bars_of(number, row, places, refined) for number, row in enumerate(rows)]
    keys = dict.fromkeys(error.answer.key for errors in refined.values() for error in errors)
    columns = [
        f"{name} {word}" for name in keys if any(name in row for row in rows) for word in ("limit", "half_width")
    ]
    return {name: [bar.get(name) for bar in bars] for name in (ERROR_BAR, *columns)}


def _bars_of(number: int, row: Row, places: np.ndarray, refined: dict[int, list[NumericalError]]) -> dict[str, Any]:
    if row["status"] != OK or not refined:
        return {}
    nearest = min(refined, key=lambda other: (float(np.linalg.norm(places[other] - places[number])), other))
    if number in refined:
        nearest = number  # several runs may stand at one place
    bar: dict[str, Any] = {ERROR_BAR: REFINED if nearest == number else f"as of run {nearest}"}
    for error in refined[nearest]:
        value = row.get(error.answer.key)
        if isinstance(value, int | float) and error.value:
            scale = value / error.value
            bar[f"{error.answer.key} limit"] = scale * error.limit
            bar[f"{error.answer.key} half_width"] = abs(scale) * error.half_width
    return bar

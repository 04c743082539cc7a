"""Runs many jobs, in processes here, on a Dask cluster or by an executor; what is done already is not run again."""

import math
from collections.abc import Generator, Sequence
from contextlib import closing
from pathlib import Path
from typing import Any

from masonry.errors import SceneError
from masonry.runtime.lock import sole
from masonry.runtime.processes import Lost, work
from masonry.runtime.progress import ProgressLines, Tell
from masonry.sweeps.job import Job, names
from masonry.sweeps.run_store import Row, Store
from masonry.sweeps.sweep_folder import DOING
from masonry.sweeps.work import ERROR, OK, ModesTask, RunEnd, compute

WORKERS = 2


def run(
    jobs: Sequence[Job], folder: Path, workers: int = WORKERS, tell: Tell | None = None, executor: Any = None
) -> list[Row]:
    """One row a job, in order; each run that ends leaves `folder/runs/KEY/` for `masonry.load_result`.

    workers   processes on this machine, with one thread each; 0: one run after the other in this process
    tell      is called with a line for each run that ends
    executor  address of a Dask scheduler, a Dask client or an executor of concurrent.futures, which then does the runs
    A row holds key, status (OK, REFUSED, STOPPED, ERROR), reason, seconds, verdict, doubts (their names) and the
    numbers of summary.json by dotted name. A run that failed leaves failure.json. What ended is not run again, but for
    an ERROR (a process that died, no memory), which is tried again; jobs of the same key run once.
    Raises SceneError before anything is written if a scene is wrong, and if another process runs into this folder.
    """
    for job in jobs:
        job.key()
    with sole(folder, DOING):
        return run_alone(jobs, folder, workers, tell, executor)


def run_alone(
    jobs: Sequence[Job],
    folder: Path,
    workers: int = WORKERS,
    tell: Tell | None = None,
    executor: Any = None,
    needs_first: bool = False,
) -> list[Row]:
    """As `run`, for one who holds the folder already (`lock.sole`).

    needs_first  all other runs end, and have no row, where the first one does not come to its end
    """
    store = Store(folder)
    wanted = {job.key(): job for job in jobs}
    rows = {key: row for key in wanted if (row := store.row(key)) is not None}
    missing = [job for key, job in wanted.items() if key not in rows or rows[key]["status"] == ERROR]
    first = jobs[0].key() if needs_first else None
    if first in rows and rows[first]["status"] not in (OK, ERROR):
        return [rows[first]]
    if rows and tell is not None:
        tell(f"{len(wanted) - len(missing)} of {len(wanted)} runs are done already")
    called = dict(zip(wanted, names(list(wanted.values())), strict=True))
    tally = ProgressLines((called[job.key()] for job in missing), tell)
    try:
        with closing(_ends([job.task for job in missing], workers, executor)) as ends:
            for number, ended in ends:
                job = missing[number]
                row = rows[job.key()] = store.keep(job.key(), ended)
                tally.ended(called[job.key()], row["status"], row["seconds"])
                if job.key() == first and row["status"] != OK:
                    return [row]
    finally:
        store.sweep_up()
    return [dict(rows[job.key()]) for job in jobs]


def _ends(tasks: list[str | ModesTask], workers: int, executor: Any) -> Generator[tuple[int, RunEnd]]:
    """Number of each task and what became of it, as they end."""
    if not tasks:
        return
    if workers < 0:
        raise SceneError(f"{workers} workers: 0 (all in this process) or more")
    ends: Generator[tuple[int, Any]]
    if executor is not None:
        from masonry.sweeps.cluster import work_on

        ends = work_on(executor, compute, tasks)
    elif workers == 0:
        ends = ((number, compute(task)) for number, task in enumerate(tasks))
    else:
        ends = work(compute, tasks, workers, math.inf)
    for number, end in ends:
        yield number, RunEnd(ERROR, end.reason, end.seconds) if isinstance(end, Lost) else end

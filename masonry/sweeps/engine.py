"""Runs many jobs, in processes here or on a Dask cluster; what is done already is not run again."""

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
from masonry.sweeps.work import ERROR, RunEnd, compute

WORKERS = 2


def run(
    jobs: Sequence[Job], folder: Path, workers: int = WORKERS, tell: Tell | None = None, scheduler: str | None = None
) -> list[Row]:
    """One row a job, in order; each run that ends leaves `folder/runs/KEY/` for `masonry.load_result`.

    workers    processes on this machine, with one thread each
    tell       is called with a line for each run that ends
    scheduler  address of a Dask scheduler, whose workers then do the runs
    A row holds key, status (OK, REFUSED, STOPPED, ERROR), reason, seconds, verdict, doubts (their names) and the
    numbers of summary.json by dotted name. A run that failed leaves failure.json. What ended is not run again, but for
    an ERROR (a process that died, no memory), which is tried again; jobs of the same key run once.
    Raises SceneError before anything is written if a scene is wrong, and if another process runs into this folder.
    """
    for job in jobs:
        job.key()
    with sole(folder, DOING):
        return run_alone(jobs, folder, workers, tell, scheduler)


def run_alone(
    jobs: Sequence[Job], folder: Path, workers: int = WORKERS, tell: Tell | None = None, scheduler: str | None = None
) -> list[Row]:
    """As `run`, for one who holds the folder already (`lock.sole`)."""
    store = Store(folder)
    wanted = {job.key(): job for job in jobs}
    rows = {key: row for key in wanted if (row := store.row(key)) is not None}
    missing = [job for key, job in wanted.items() if key not in rows or rows[key]["status"] == ERROR]
    if rows and tell is not None:
        tell(f"{len(wanted) - len(missing)} of {len(wanted)} runs are done already")
    called = dict(zip(wanted, names(list(wanted.values())), strict=True))
    tally = ProgressLines((called[job.key()] for job in missing), tell)
    try:
        with closing(_ends([job.resolved for job in missing], workers, scheduler)) as ends:
            for number, ended in ends:
                job = missing[number]
                row = rows[job.key()] = store.keep(job.key(), ended)
                tally.ended(called[job.key()], row["status"], row["seconds"])
    finally:
        store.sweep_up()
    return [dict(rows[job.key()]) for job in jobs]


def _ends(scenes: list[str], workers: int, scheduler: str | None) -> Generator[tuple[int, RunEnd]]:
    """Number of each scene and what became of its run, as they end."""
    if not scenes:
        return
    if workers < 1:
        raise SceneError(f"{workers} workers: 1 or more")
    ends: Generator[tuple[int, Any]]
    if scheduler is None:
        ends = work(compute, scenes, workers, math.inf)
    else:
        from masonry.sweeps.cluster import work_on

        ends = work_on(scheduler, compute, scenes)
    for number, end in ends:
        yield number, RunEnd(ERROR, end.reason, end.seconds) if isinstance(end, Lost) else end

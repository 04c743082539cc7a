"""Runs cases, in two processes at a time by default: so that one computes while the other compiles."""

import time
from collections.abc import Callable, Sequence
from multiprocessing.connection import wait

from masonry.progress import duration
from verification.case import Case, Findings
from verification.outcome import Outcome
from verification.worker import Worker, run_case

WORKERS = 2
LIMIT = 1200.0
"""Seconds after which a case is given up."""
Tell = Callable[[str], None]


def run(cases: Sequence[Case], workers: int = WORKERS, tell: Tell | None = None, limit: float = LIMIT) -> list[Outcome]:
    """The outcome of every case, in the order given; never raises but at Ctrl-C.

    workers  processes; 0 runs all cases in this one
    tell     is called with a line for each case that ends
    limit    seconds after which a case is an error; kept by worker processes only
    """
    watch = Watch(cases, tell)
    if workers <= 0:
        return [watch.seen(run_case(case)) for case in cases]
    done: dict[str, Outcome] = {}
    waiting = sorted(cases, key=lambda case: case.quick)  # the long ones first, so that no worker idles at the end
    crew = [Worker() for _ in range(min(workers, len(cases)))]
    try:
        for worker in crew:
            worker.begin(waiting.pop(0))
        while busy := [worker for worker in crew if worker.case is not None]:
            ready = wait([worker.pipe for worker in busy], timeout=1.0)
            for worker in busy:
                late = time.perf_counter() - worker.begun > limit
                if worker.pipe not in ready and not late:
                    continue
                outcome = worker.finish() if worker.pipe in ready else given_up(worker, limit)
                done[outcome.case.name] = watch.seen(outcome)
                if not worker.process.is_alive():
                    crew[crew.index(worker)] = worker = Worker() if waiting else worker
                if waiting:
                    worker.begin(waiting.pop(0))
    finally:
        for worker in crew:
            worker.stop()
    return [done[case.name] for case in cases]


def given_up(worker: Worker, limit: float) -> Outcome:
    """What is left of a case that takes too long: an error, and a worker that was stopped."""
    assert worker.case is not None
    case, worker.case = worker.case, None
    worker.stop()
    return Outcome(case, Findings(), "ERROR", f"no result after {duration(limit)}", limit)


class Watch:
    """Counts what is done and says how much time is left, from the time that the others took."""

    def __init__(self, cases: Sequence[Case], tell: Tell | None) -> None:
        self.total, self.tell = len(cases), tell
        self.margin = max((len(case.name) for case in cases), default=0)
        self.seconds: list[float] = []
        self.begun = time.perf_counter()

    def seen(self, outcome: Outcome) -> Outcome:
        """Tell one line, and hand the outcome on."""
        self.seconds.append(outcome.seconds)
        if self.tell is not None:
            count, left = len(self.seconds), self.total - len(self.seconds)
            passed = time.perf_counter() - self.begun
            rest = f"about {duration(passed / count * left)} left" if left else f"{duration(passed)} in all"
            width = len(str(self.total))
            self.tell(
                f"[{count:>{width}}/{self.total}] {outcome.case.name:<{self.margin}}  {outcome.status:<9} "
                f"{duration(outcome.seconds):>11}   {rest}"
            )
        return outcome

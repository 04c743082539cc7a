"""Runs cases, in two processes at a time by default: so that one computes while the other compiles."""

from collections.abc import Sequence
from contextlib import closing
from typing import Any

from masonry.runtime.ending import code_of
from masonry.runtime.processes import Lost, work
from masonry.runtime.progress import ProgressLines, Tell
from verification.case import Case, Findings
from verification.outcome import CaseOutcome, answer, run_case

WORKERS = 2
LIMIT = 1200.0
"""Seconds after which a case is given up."""


class CutShort(Exception):
    """A run of cases that was told to end: what is done by then, and the exit code."""

    def __init__(self, done: list[CaseOutcome], code: int) -> None:
        super().__init__(f"{len(done)} cases are done")
        self.done, self.code = done, code


def run(
    cases: Sequence[Case], workers: int = WORKERS, tell: Tell | None = None, limit: float = LIMIT
) -> list[CaseOutcome]:
    """The outcome of every case, in the order given. Raises Cut where it is told to end, by Ctrl-C or a signal.

    workers  processes; 0 runs all cases in this one
    tell     is called with a line for each case that ends
    limit    seconds after which a case is an error; kept by worker processes only
    """
    tally = ProgressLines((case.name for case in cases), tell)
    done: dict[str, CaseOutcome] = {}

    def keep(outcome: CaseOutcome) -> None:
        done[outcome.case.name] = outcome
        tally.ended(outcome.case.name, outcome.status, outcome.seconds)

    try:
        if workers <= 0:
            for case in cases:
                keep(run_case(case))
        else:
            longest_first = sorted(cases, key=lambda case: case.quick)  # so that no worker idles at the end
            with closing(work(answer, longest_first, workers, limit)) as ends:
                for number, end in ends:
                    keep(_outcome(longest_first[number], end))
    except KeyboardInterrupt as ended:
        raise CutShort(list(done.values()), code_of(ended)) from None
    return [done[case.name] for case in cases]


def _outcome(case: Case, end: Any) -> CaseOutcome:
    if isinstance(end, Lost):
        return CaseOutcome(case, Findings(), "ERROR", end.reason, end.seconds)
    return CaseOutcome(case, *end)

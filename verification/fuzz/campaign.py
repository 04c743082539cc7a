"""Many inputs of all kinds, in processes that are watched: one that hangs or dies costs its input only."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import closing
from pathlib import Path

from masonry.runtime.processes import Lost, work
from verification.fuzz.kind import Kind
from verification.fuzz.trial import HANG, Trial
from verification.fuzz.worker import Task, act, warm

LIMIT = 600.0
"""Seconds for an input with the start of its process, which ends itself long before."""
DIED, HUNG = -2, -3


def shared_out(inputs: int, chosen: Sequence[Kind]) -> dict[str, int]:
    """How many inputs of each kind, by their shares, at least one; the largest kind takes what rounding leaves."""
    whole = sum(kind.share for kind in chosen)
    counts = {kind.name: max(1, int(inputs * kind.share / whole)) for kind in chosen}
    largest = max(counts, key=lambda name: counts[name])
    counts[largest] += max(inputs - sum(counts.values()), 0)
    return counts


def tasks_of(counts: dict[str, int], seed: int, root: Path) -> list[Task]:
    """All inputs, the kinds mixed evenly, so that a part of the campaign is one of all kinds."""
    found = [(n / count, Task(seed, name, n, str(root))) for name, count in counts.items() for n in range(count)]
    return [task for _, task in sorted(found)]


def compiled() -> None:
    """Compile first, in a process of its own, so that no input seems to hang for it."""
    with closing(work(warm, ["wallette-mode-1"], 1)) as ends:
        list(ends)


def run(tasks: Sequence[Task], workers: int, tell: Callable[[Trial], None]) -> list[Trial]:
    """Every input tried, in the order in which they end; `tell` is called with each."""
    done = []
    for trial in _trials(tasks, workers):
        tell(trial)
        done.append(trial)
    return done


def _trials(tasks: Sequence[Task], workers: int) -> Iterator[Trial]:
    with closing(work(act, tasks, workers, LIMIT)) as ends:
        for number, end in ends:
            yield _lost(tasks[number], end) if isinstance(end, Lost) else end


def _lost(task: Task, end: Lost) -> Trial:
    stacks = [path.read_text(encoding="utf-8") for path in Path(task.root).glob(f"*/{task.kind}-{task.number}.stack")]
    hung = any("Timeout" in stack for stack in stacks) or end.reason.startswith("no result")
    what = f"hangs: no end after {HANG:g} s" if hung else end.reason
    return Trial(task.kind, task.number, HUNG if hung else DIED, end.seconds, 0, faults=[what])

"""`python -m verification.fuzz`: bad input by the thousand, and what the program made of it. Exit code 1 at a fault."""

import shutil
import sys
import tempfile
import time
from pathlib import Path

from geometry.blocks import GeometryError
from masonry.errors import SceneError
from masonry.runtime.shell import USAGE, Parser, complain
from verification.fuzz.campaign import compiled, run, shared_out, tasks_of
from verification.fuzz.kind import all_kinds, kind_of
from verification.fuzz.table import faults_text, table_text, verdict
from verification.fuzz.trial import Trial
from verification.fuzz.worker import Task

EVERY = 10.0
"""Seconds between two lines of progress."""


def parser() -> Parser:
    """The words that the command knows."""
    words = Parser(prog="python -m verification.fuzz", description=__doc__)
    words.add_argument("--inputs", type=int, default=10_000, metavar="N", help="how many, over all kinds (10000)")
    words.add_argument("--seed", type=int, default=1, metavar="N", help="other inputs (1)")
    words.add_argument("--kind", metavar="KIND,...", help=f"of these kinds only: {', '.join(all_kinds())}")
    words.add_argument("--only", type=int, metavar="N", help="the input of this number only; its folder is kept")
    words.add_argument("--workers", type=int, default=2, metavar="N", help="processes (2)")
    words.add_argument("--atheris", metavar="KIND", help="search for inputs by what code they reach; needs atheris")
    words.add_argument("--seconds", type=int, default=60, metavar="S", help="how long --atheris searches (60)")
    return words


def main(arguments: list[str] | None = None) -> int:
    """Run the campaign; returns the exit code."""
    words = parser().parse_args(arguments)
    if words.atheris:
        from verification.fuzz.coverage import search

        return search(kind_of(words.atheris), words.seconds)
    chosen = [kind_of(name) for name in words.kind.split(",")] if words.kind else list(all_kinds().values())
    if words.inputs < 1 or words.workers < 1:
        raise SceneError("--inputs and --workers must be 1 or more")
    root = Path(tempfile.mkdtemp(prefix="masonry-fuzz-"))
    tasks = tasks_of(shared_out(words.inputs, chosen), words.seed, root)
    if words.only is not None:
        tasks = [Task(words.seed, kind.name, words.only, str(root)) for kind in chosen]
    compiled()
    begun = time.perf_counter()
    trials = run(tasks, words.workers, _Telling(len(tasks), begun))
    print(table_text(trials))
    print(verdict(trials, time.perf_counter() - begun))
    if words.only is not None:
        print("\n".join(t.said for t in trials))
    if not any(t.faults for t in trials):
        shutil.rmtree(root, ignore_errors=True)
        return 0
    print(f"{faults_text(trials, words.seed)}\nthe inputs are in '{root}'")
    return 1


class _Telling:
    """A line now and then, and one for each fault."""

    def __init__(self, total: int, begun: float) -> None:
        self.total, self.begun, self.said, self.count, self.faults = total, begun, begun, 0, 0

    def __call__(self, trial: Trial) -> None:
        self.count += 1
        self.faults += bool(trial.faults)
        now = time.perf_counter()
        if trial.faults and self.faults <= 20:
            self._say(f"{trial.kind} {trial.number}: {'; '.join(trial.faults)[:300]}")
        if now - self.said > EVERY:
            self.said = now
            left = (now - self.begun) / self.count * (self.total - self.count)
            self._say(f"[{self.count}/{self.total}] {self.faults} faults, about {left:.0f} s left")

    @staticmethod
    def _say(line: str) -> None:
        print(line, file=sys.stderr, flush=True)


if __name__ == "__main__":
    try:
        code = main()
    except (SceneError, GeometryError) as error:
        code = complain(str(error), USAGE)
    sys.exit(code)

"""`python -m verification.faults --kills 100`: runs killed at random moments, resumed, and compared bit by bit."""

import argparse
import random
import sys
import tempfile
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from verification.faults.kills import MOMENTS, Alone, Killed, kill_and_resume, leave_alone
from verification.faults.trials import TRIALS


def main() -> int:
    """0 if every resumed run has the bits of the run that was left alone."""
    words = argparse.ArgumentParser(prog="python -m verification.faults", description=__doc__)
    words.add_argument("--kills", type=int, default=100, metavar="N")
    words.add_argument("--seed", type=int, default=1, metavar="N")
    words.add_argument("--workers", type=int, default=2, metavar="N", help="runs at the same time")
    given = words.parse_args()
    with tempfile.TemporaryDirectory(prefix="masonry-faults-") as root, ThreadPoolExecutor(given.workers) as pool:
        alone = {trial.name: leave_alone(trial, Path(root) / f"alone-{k}") for k, trial in enumerate(TRIALS)}
        tasks = [pool.submit(_one, alone, Path(root) / f"kill-{k}", k, given.seed) for k in range(given.kills)]
        killed = []
        for task in tasks:
            killed.append(task.result())
            for line in killed[-1].differs:
                print(f"{killed[-1].trial}, killed at {killed[-1].moment}: {line}", flush=True)
            print(f"{len(killed)} of {given.kills}", file=sys.stderr, flush=True)
    print(table(killed))
    return 1 if any(one.differs for one in killed) else 0


def _one(alone: dict[str, Alone], folder: Path, number: int, seed: int) -> Killed:
    trial = TRIALS[number % len(TRIALS)]
    moment = MOMENTS[number // len(TRIALS) % len(MOMENTS)]
    return kill_and_resume(trial, alone[trial.name], folder, moment, random.Random(1000 * seed + number))


def table(killed: list[Killed]) -> str:
    """A line for each run: kills, in what state they were found, and how many came to the same bits."""
    states = ("nothing yet", "a checkpoint", "half a checkpoint")
    lines = [f"{'':<30}{'kills':>8}{'no checkpoint':>16}{'checkpoint':>12}{'half a one':>12}{'same bits':>12}"]
    for name in dict.fromkeys(one.trial for one in killed):
        own = [one for one in killed if one.trial == name]
        lines.append(_line(name, own, Counter(one.found for one in own), states))
    return "\n".join([*lines, _line("all", killed, Counter(one.found for one in killed), states)])


def _line(name: str, own: list[Killed], found: Counter[str], states: tuple[str, ...]) -> str:
    none, whole, half = (found[state] for state in states)
    same = sum(not one.differs for one in own)
    return f"{name:<30}{len(own):>8}{none:>16}{whole:>12}{half:>12}{same:>12}"


if __name__ == "__main__":
    sys.exit(main())

"""Kill a run at a random moment, go on with it, and compare the results with those of a run that was left alone."""

import random
import shutil
import signal
from dataclasses import dataclass
from pathlib import Path

from tests.faults.compare import differences
from tests.faults.process import Process, half_written, states
from tests.faults.trials import Trial

MOMENTS = ("start", "any", "any", "writing")
"""How the moments of the kills are drawn, in turn: before the first checkpoint, any time after it, or as soon as the
file of a certain checkpoint is begun."""


@dataclass(frozen=True)
class Alone:
    """A run that was left alone: its results, seconds to its first checkpoint and to its end, and checkpoints."""

    folder: Path
    first: float
    whole: float
    checkpoints: int


@dataclass(frozen=True)
class Killed:
    """What came of a kill.

    found    "nothing yet", "a checkpoint", or "half a checkpoint" that was being written
    differs  what the results then hold differently
    """

    trial: str
    moment: str
    found: str
    differs: list[str]


def leave_alone(trial: Trial, folder: Path) -> Alone:
    """Run a trial to its end. Raises RuntimeError where it does not get there."""
    process = Process([*trial.words(folder), "--quiet"], folder.parent)
    seen: set[str] = set()
    first = 0.0
    while process.runs:
        seen |= set(states(folder))
        if seen and not first:
            first = process.age
        process.sleep(0.002)
    whole = process.age
    if process.end() != 0 or not seen:
        raise RuntimeError(f"{trial.name} did not run to its end with checkpoints on the way: {process.said}")
    return Alone(folder, first, whole, max(int(name[6:12]) for name in seen))


def kill_once(trial: Trial, alone: Alone, folder: Path, moment: str, draw: random.Random) -> str | None:
    """Run and kill; what is found then, or None where the run was through before."""
    process = Process([*trial.words(folder), "--quiet"], folder.parent)
    share = draw.random()
    if moment == "start":
        process.sleep(share * alone.first)
    elif moment == "any":
        process.wait_for(lambda: bool(states(folder)))
        process.sleep(share * 0.9 * (alone.whole - alone.first))
    else:
        number = f"state-{1 + int(share * 0.8 * alone.checkpoints):06d}"
        process.wait_for(lambda: any(number in name for name in half_written(folder)))
        process.sleep(draw.random() * 0.003)
    process.send(signal.SIGKILL)
    if process.end() != -signal.SIGKILL:
        return None
    if any("state" in name for name in half_written(folder)):
        return "half a checkpoint"
    return "a checkpoint" if states(folder) else "nothing yet"


def kill_and_resume(trial: Trial, alone: Alone, folder: Path, moment: str, draw: random.Random) -> Killed:
    """One kill that hit, and the run taken to its end."""
    while (outcome := kill_once(trial, alone, folder, moment, draw)) is None:
        shutil.rmtree(folder)
    begun = (folder / "checkpoint" / "scene.toml").is_file()
    words = ["resume", str(folder), "--threads", str(trial.threads[1])] if begun else [*trial.words(folder)]
    process = Process([*words, "--quiet"], folder.parent)
    code = process.end()
    differs = [f"exit code {code}: {process.said.strip()}"] if code else differences(alone.folder, folder)
    left = half_written(folder) + states(folder)
    return Killed(trial.name, moment, outcome, differs + [f"left behind: {name}" for name in left])

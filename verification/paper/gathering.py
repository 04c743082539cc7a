"""Runs the experiments: all their runs at once through the sweep engine, each distinct one once."""

from collections.abc import Callable, Sequence
from pathlib import Path

from masonry.sweep import engine
from masonry.sweep.job import Job
from verification.paper.experiment import (
    PERCENT,
    QUICK_PERCENT,
    Claim,
    Done,
    Experiment,
    Missing,
    Run,
    Section,
    Shown,
)
from verification.paper.soundness import HALVED, soundness


def gather(
    experiments: Sequence[Experiment],
    folder: Path,
    quick: bool = False,
    workers: int = 2,
    tell: Callable[[str], None] | None = None,
) -> list[Shown]:
    """Run what is not there yet under `folder`, then let each experiment show its results."""
    wanted = {e.name: with_halved(e.runs(quick), quick) for e in experiments}
    jobs = [Job(run.scene, run.settings, label) for runs in wanted.values() for label, run in runs.items()]
    rows = iter(engine.run(jobs, folder, workers, tell))
    made = []
    for experiment in experiments:
        runs = wanted[experiment.name]
        made.append(shown(experiment, Done(runs, dict(zip(runs, rows, strict=False)), folder, quick)))
        if tell is not None:
            tell(f"{experiment.name}: drawn")
    return made


def with_halved(runs: dict[str, Run], quick: bool) -> dict[str, Run]:
    """The runs, and those again that ask for it at half the accuracy; a quick look is content with less."""
    if quick:
        return {label: run if run.paced else run.at(QUICK_PERCENT) for label, run in runs.items()}
    again = {HALVED.format(label): run.at(0.5 * PERCENT) for label, run in runs.items() if run.halve}
    return runs | again


def shown(experiment: Experiment, done: Done) -> Shown:
    """What an experiment has to show; where runs that it needs are missing, that."""
    try:
        section = experiment.show(done)
    except Missing as missing:
        failed = Claim(experiment.title, "the paper", "its runs come to their end", "no", False, str(missing))
        section = Section(claims=[failed])
    seconds = sum(float(row["seconds"] or 0.0) for row in done.rows.values())
    return Shown(experiment, section, soundness(done), seconds, len(done.rows))

"""Runs the experiments: all their runs at once through the sweep engine, each distinct one once."""

import itertools
from collections.abc import Callable, Sequence
from pathlib import Path

from masonry.sweep import engine
from masonry.sweep.job import Job
from verification.paper.experiment import QUICK_PERCENT, Done, Experiment, Missing, Run, Section, Shown, claim
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
    order = in_turn(wanted)
    jobs = [Job(wanted[name][label].scene, wanted[name][label].settings, label) for name, label in order]
    rows = dict(zip(order, engine.run(jobs, folder, workers, tell), strict=True))
    made = []
    for experiment in experiments:
        runs = wanted[experiment.name]
        own = {label: rows[experiment.name, label] for label in runs}
        made.append(shown(experiment, Done(runs, own, folder, quick)))
        if tell is not None:
            tell(f"{experiment.name}: drawn")
    return made


def in_turn(wanted: dict[str, dict[str, Run]]) -> list[tuple[str, str]]:
    """(experiment, label) of all runs, one of each experiment in turn: those of one experiment mostly need the same
    step, and workers that come to them together all wait while one of them compiles it."""
    lists = [[(name, label) for label in runs] for name, runs in wanted.items()]
    return [pair for pairs in itertools.zip_longest(*lists) for pair in pairs if pair is not None]


def with_halved(runs: dict[str, Run], quick: bool) -> dict[str, Run]:
    """The runs, and those again that ask for it at half the accuracy; a quick look is content with less."""
    if quick:
        return {label: run if run.paced else run.at(QUICK_PERCENT) for label, run in runs.items()}
    again = {HALVED.format(label): run.halved() for label, run in runs.items() if run.halve}
    return runs | again


def shown(experiment: Experiment, done: Done) -> Shown:
    """What an experiment has to show; where runs that it needs are missing, that."""
    try:
        section = experiment.show(done)
    except Missing as missing:
        failed = claim(experiment.title, "the paper", "its runs come to their end", "no", False, str(missing))
        section = Section(claims=[failed])
    seconds = sum(float(row["seconds"] or 0.0) for row in done.rows.values())
    return Shown(experiment, section, soundness(done), seconds, len(done.rows))

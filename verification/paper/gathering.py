"""Runs the experiments: all their runs at once through the sweep engine, each distinct one once; again, at half the
loading error, those that were not loaded carefully enough."""

import itertools
from collections.abc import Callable, Sequence
from pathlib import Path

from masonry.sweeps import engine
from masonry.sweeps.job import Job
from verification.paper.experiment import COARSER, QUICK_PERCENT, Done, Experiment, Missing, Run, Section, Shown, claim
from verification.paper.soundness import careless, soundness

REFINEMENTS = 3
"""Times that a run is made again, at half its loading error each time."""
Tell = Callable[[str], None]
Runs = dict[str, Run]


def gather(
    experiments: Sequence[Experiment], folder: Path, quick: bool = False, workers: int = 2, tell: Tell | None = None
) -> list[Shown]:
    """Run what is not there yet under `folder`, then let each experiment show its results."""
    made = []
    for experiment, done in zip(experiments, results(experiments, folder, quick, workers, tell), strict=True):
        made.append(shown(experiment, done))
        done.loaded.clear()
        if tell is not None:
            tell(f"{experiment.name}: drawn")
    return made


def results(
    experiments: Sequence[Experiment], folder: Path, quick: bool, workers: int, tell: Tell | None
) -> list[Done]:
    """The results of all experiments. Runs that are not loaded carefully enough are made again, with less error."""
    runs = [paced(experiment.runs(quick), quick) for experiment in experiments]
    refined: list[set[str]] = [set() for _ in experiments]
    for refinement in range(REFINEMENTS + 1):
        plans = [plan if quick else with_coarser(plan) for plan in runs]
        order = in_turn(plans)
        jobs = [Job(plans[k][label].scene, plans[k][label].settings, label) for k, label in order]
        rows = dict(zip(order, engine.run(jobs, folder, workers, tell), strict=True))
        done = [
            Done(plan, {label: rows[k, label] for label in plan}, folder, quick, refined=frozenset(refined[k]))
            for k, plan in enumerate(plans)
        ]
        again = [careless(entry) for entry in done]
        if refinement == REFINEMENTS or not any(again):
            break
        if tell is not None:
            tell(f"loaded more carefully: {', '.join(itertools.chain(*again))}")
        for k, labels in enumerate(again):
            refined[k].update(labels)
            runs[k] |= {label: runs[k][label].finer() for label in labels}
    return done


def in_turn(plans: Sequence[Runs]) -> list[tuple[int, str]]:
    """(number of the experiment, label) of all runs, one of each experiment in turn: those of one experiment mostly
    need the same step, and workers that come to them together all wait while one of them compiles it."""
    lists = [[(number, label) for label in runs] for number, runs in enumerate(plans)]
    return [pair for pairs in itertools.zip_longest(*lists) for pair in pairs if pair is not None]


def paced(runs: Runs, quick: bool) -> Runs:
    """The runs; a quick look is content with less where they do not say how fast they are driven."""
    return {label: run.at(QUICK_PERCENT) if quick and not run.paced else run for label, run in runs.items()}


def with_coarser(runs: Runs) -> Runs:
    """The runs, and those again that ask for it with twice the loading error."""
    return runs | {COARSER.format(label): run.coarser() for label, run in runs.items() if run.pace_check}


def shown(experiment: Experiment, done: Done) -> Shown:
    """Presentation of an experiment; where runs that it needs are missing, a claim that says so."""
    try:
        section = experiment.show(done)
    except Missing as missing:
        failed = claim(experiment.title, "the paper", "its runs come to their end", "no", False, str(missing))
        section = Section(claims=[failed])
    seconds = sum(float(row["seconds"] or 0.0) for row in done.rows.values())
    return Shown(experiment, section, soundness(done), seconds, len(done.rows))

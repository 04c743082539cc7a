"""How far the numbers of a scene are from what the same model gives when it is refined without end: run and written."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from math import inf
from pathlib import Path
from typing import Any

from masonry.assembly.growing_loads import require_axles_to_load
from masonry.errors import SceneError
from masonry.runtime.folder import writing
from masonry.runtime.folders.own_files import ResultFiles, remove_own
from masonry.runtime.lock import sole
from masonry.runtime.named_file import FORMATS, remove_pictures, require_format
from masonry.runtime.processors import processors
from masonry.runtime.progress import Tell, duration
from masonry.scene import Scene
from masonry.sweeps import cluster
from masonry.sweeps.convergence import convergence_table
from masonry.sweeps.convergence.beside_resolution import BesideResolution, beside, runs_beside, sentences
from masonry.sweeps.convergence.error_record import record_in_base
from masonry.sweeps.convergence.refinement.analyses import RUN, analysis_of
from masonry.sweeps.convergence.refinement.answers import require_answer
from masonry.sweeps.convergence.refinement.campaign import DRAWN, RIGID, Campaign, Refinement
from masonry.sweeps.convergence.refinement.numerical_errors import NumericalError, error_of, relative_changes
from masonry.sweeps.convergence.refinement.resolutions import not_refined
from masonry.sweeps.convergence.search.chosen_settings import FILE, ChosenSettings, fraction
from masonry.sweeps.convergence.search.settings_search import choose
from masonry.sweeps.engine import run_alone
from masonry.sweeps.run_store import Row
from masonry.sweeps.study_folder import SCENE, begin
from masonry.sweeps.work import OK

PICTURE, CSV, TABLE = "convergence", "convergence.csv", "convergence.json"
DOING = "refines a scene in it"


@dataclass(frozen=True, repr=False)
class Convergence:
    """Result of `masonry converge`; it prints as the command does.

    folder   of the runs, the table (convergence.csv, convergence.json) and the picture (convergence.png)
    errors   of each number of the scene, in SI; empty where its run did not come to its end
    besides  of each of these, differences that are no error of resolution
    runs     what was refined, and the row of its run: the scene as it is first
    remarks  what is not refined, and what is no error of resolution, in sentences
    chosen   settings whose error is small enough, where that was asked for
    form     of the picture
    """

    folder: Path
    errors: list[NumericalError]
    besides: list[BesideResolution]
    runs: list[tuple[Refinement, Row]]
    remarks: list[str]
    chosen: ChosenSettings | None
    form: str

    def __repr__(self) -> str:
        words = [] if self.chosen is None else [self.chosen.words]
        return convergence_table.text(self.errors, self.runs, [*words, *self.remarks])

    @property
    def files(self) -> list[str]:
        """Names of the files in the folder."""
        picture = [f"{PICTURE}.{self.form}"] if self.errors else []
        return [CSV, TABLE, *picture, *([FILE] if self.chosen is not None else [])]

    @property
    def has_come_to_its_end(self) -> bool:
        """Whether the scene as it is has numbers."""
        return bool(self.runs[0][1]["status"] == OK)


def converge(
    scene: Scene,
    out: str | Path | None = None,
    of: Sequence[str] = (),
    to: str | float | None = None,
    cost: float | None = None,
    workers: Any = None,
    tell: Tell | None = None,
    overwrite: bool = False,
    form: str = FORMATS[0],
) -> Convergence:
    """Refine what a scene says of its resolution, in processes side by side, and tell the error of its numbers.

    out      folder, else the next free results/SCENE-convergence-N; what is done of this scene there is kept
    of       numbers of summary.json by dotted name, or frequencies of modes (`frequency_keys`), which need no run;
             peak, displacement there, load factor and so on where none is named
    to       an error, "1 %" or 0.01: settings are chosen by which no number has a larger one, see `ChosenSettings`
    cost     times the scene itself that all other runs may take (default 6, with tets 8)
    workers  processes (default: all processors; 0: one run after the other in this one), or what does the runs in their
             place, as `executor` of `engine.run`
    tell     is called with a line for each run that ends
    form     of the picture, one of FORMATS
    Raises SceneError or GeometryError before anything runs.
    """
    require_format(form)
    count, executor = (workers, None) if workers is None or isinstance(workers, int) else (0, workers)
    if count is not None and count < 0:
        raise SceneError(f"{count} workers: 0 (all in this process) or more")
    if executor is not None:
        cluster.require(executor)
    largest, analysis = require_words(scene, of, to, cost), analysis_of(of)
    if analysis is RUN:
        require_axles_to_load(scene)
    campaign = Campaign(scene, cost, analysis)
    if not campaign.resolutions:
        raise SceneError(f"'{scene.name}' has nothing that could be refined: its answer has no error of resolution")
    others = runs_beside(scene) if analysis.scatters else []
    folder = begin(scene, PICTURE, TABLE, DOING, None if out is None else Path(out), overwrite)
    if tell is not None:
        tell(_forecast(campaign, others, folder))
    with sole(folder, DOING):
        runner = Runner(folder, of, processors() if count is None else count, tell, executor)
        errors, done = runner.measured(campaign, others)
        besides = [item for error in errors if (item := beside(error.answer, done)) is not None]
        remarks = [*sentences(besides, done, scene.moves_in_time), *not_refined(scene)]
        chosen = None
        if largest is not None and errors:
            plan = partial(Campaign, cost=cost, analysis=analysis)
            measure = lambda other: runner.measured(plan(other))  # noqa: E731
            chosen = choose(scene, (errors, done), largest, measure, plan, tell)
        result = Convergence(folder, errors, besides, done, remarks, chosen, form)
        _write(scene, result, form)
    return result


def _forecast(campaign: Campaign, others: Sequence[Refinement], folder: Path) -> str:
    """A line before the runs: how many there are at first, and about how long all of them take, those beside too."""
    seconds = campaign.size.seconds * (1.0 + campaign.limit + sum(trial.cost for trial in others))
    about = f", about {duration(seconds)} of processor in all" if campaign.analysis.is_timed else ""
    return f"{len(campaign.first()) + len(others)} runs at first{about}, results in '{folder}'"


def require_words(scene: Scene, of: Sequence[str], to: str | float | None, cost: float | None) -> float | None:
    """The error asked for, if any; raises SceneError for a number that there is not, and what is out of range."""
    if cost is not None and not 1.0 <= cost < inf:
        raise SceneError(f"cost {cost:g}: times the scene itself that all other runs may take, 1 or more")
    if analysis_of(of) is RUN:
        for number in of:
            require_answer(number, [gauge.name for gauge in scene.gauge])
    return None if to is None else fraction(to)


@dataclass(frozen=True)
class Runner:
    """Runs of campaigns into a folder."""

    folder: Path
    of: Sequence[str]
    workers: int
    tell: Tell | None
    executor: Any = None

    def measured(
        self, campaign: Campaign, others: Sequence[Refinement] = ()
    ) -> tuple[list[NumericalError], list[tuple[Refinement, Row]]]:
        """The error of each number of a scene, and its runs in two rounds: each resolution alone, and others, then what
        these say matters."""
        first = [*campaign.first(), *others]
        done = self._round(campaign, first)
        base, gauges = done[0][1], [gauge.name for gauge in campaign.scene.gauge]
        if base["status"] != OK:
            return [], done
        answers = campaign.analysis.answers(base, gauges, self.of)
        changes, scatter = relative_changes(done, answers)
        spent = sum(trial.cost for trial, row in done[1:] if trial.name not in (DRAWN, RIGID) and row["status"] == OK)
        done += self._round(campaign, campaign.second(first, changes, scatter, spent), base)
        return [error for answer in answers if (error := error_of(answer, done)) is not None], done

    def _round(
        self, campaign: Campaign, trials: Sequence[Refinement], base: Row | None = None
    ) -> list[tuple[Refinement, Row]]:
        """base: the row of the scene as it is; the first of this round where there is none yet"""
        jobs = [campaign.analysis.job(campaign.scene, trial.settings, trial.label) for trial in trials]
        rows = run_alone(jobs, self.folder, self.workers, self.tell, self.executor, base is None) if jobs else []
        rows = campaign.analysis.measured(rows, base or rows[0], self.folder) if rows else []
        return list(zip(trials, rows, strict=False))  # of a scene that does not come to its end there is its own row


def _write(scene: Scene, result: Convergence, form: str) -> None:
    """Table and picture, all or none; the picture is left out where there is no error to draw."""
    from masonry.pictures.style import write_picture
    from masonry.sweeps.convergence.error_picture import figure_of

    with writing(result.folder):
        remove_pictures(result.folder, PICTURE)
        remove_own(result.folder, FILE)
        with ResultFiles(result.folder) as files:
            files.text(CSV, convergence_table.as_csv(result.errors, result.besides))
            files.text(TABLE, convergence_table.as_json(result.errors, result.besides, result.runs, result.remarks))
            if result.errors:
                figure = figure_of(scene.title or scene.name, result.errors, result.runs, result.chosen)
                write_picture(figure, files.new(f"{PICTURE}.{form}"))
            if result.chosen is not None:
                files.text(FILE, result.chosen.as_toml(SCENE))
        record_in_base(result.folder, result.errors, result.runs)

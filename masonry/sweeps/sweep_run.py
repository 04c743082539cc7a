"""A sweep from its tables to its table: planned, checked, run, written; and the result that a user holds."""

from collections import Counter
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from masonry.errors import SceneError, extra, nearest, visible
from masonry.runtime.named_file import FORMATS, require_format
from masonry.runtime.progress import Tell
from masonry.runtime.tables import html_columns
from masonry.sweeps.planned_runs import Planned, plan
from masonry.sweeps.read import FRAGILITY, SCENE, Sweep
from masonry.sweeps.run_store import Row
from masonry.sweeps.sweep_folder import COPY, DOING, folder_for, scene_text
from masonry.sweeps.sweep_table import bars_text, table_of, verdicts_text

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from pandas import DataFrame

    from masonry.laboratory.result import Result
    from masonry.sweeps.fragility.fragility import Fragility
    from masonry.sweeps.fragility.request import FragilityRequest

REFUSED = ("stop", "keep")
"""What becomes of a sweep of which some runs cannot be built."""


@dataclass(frozen=True, repr=False)
class SweepResult:
    """Result of a sweep; it prints as `masonry sweep` does.

    folder     of the runs, the tables and the pictures
    columns    name -> a value for each run, in order; None where a run has none
    fragility  where the sweep asked for it
    files      that were written to the folder, besides those of the runs
    """

    folder: Path
    title: str
    planned: Sequence[Planned]
    outcomes: Sequence[Row]
    columns: dict[str, list[Any]]
    fragility: "Fragility | None"
    files: tuple[str, ...]

    @property
    def rows(self) -> list[dict[str, Any]]:
        """A dictionary for each run: the columns by name."""
        return [dict(zip(self.columns, values, strict=True)) for values in zip(*self.columns.values(), strict=True)]

    @property
    def table(self) -> "DataFrame":
        """A row a run, as a table of pandas; without pandas a SceneError, and `.columns` and `.rows` have the same."""
        try:
            import pandas
        except ImportError:
            raise SceneError(
                f"sweep.table needs pandas; {extra('notebook')}; sweep.columns and sweep.rows have the same"
            ) from None
        return pandas.DataFrame(self.columns)

    def result(self, index: int) -> "Result":
        """The result of a run, by its number from 0. Raises SceneError where it left none."""
        from masonry.laboratory.result import load_result

        if not -len(self.outcomes) <= index < len(self.outcomes):
            raise SceneError(f"run {index}: there are {len(self.outcomes)} runs, numbered from 0")
        row = self.outcomes[index]
        folder = self.folder / "runs" / str(row["key"])
        if not (folder / "history.h5").is_file():
            raise SceneError(f"run {index} left no result: {row['status']}, {row['reason']}")
        return load_result(folder)

    def plot(self, path: Path | str | None = None) -> "Figure":
        """All curves in one picture: a figure, and a PNG, PDF or SVG file where a path is given."""
        from masonry.pictures.style import drawn
        from masonry.sweeps.pictures.sweep_curves import curves_figure

        return drawn(curves_figure(self.folder, self.title, self.planned, self.outcomes), path)

    def map(self, path: Path | str | None = None) -> "Figure":
        """The peak over the two keys that vary: a figure, and a PNG, PDF or SVG file where a path is given.

        Raises SceneError where not just two keys vary, or no run has a peak.
        """
        from masonry.pictures.style import drawn
        from masonry.sweeps.pictures.sweep_map import map_figure

        figure = map_figure(self.title, self.planned, self.outcomes)
        if figure is None:
            raise SceneError("there is no map: it takes two keys that vary, and a run that has a peak")
        return drawn(figure, path)

    def _repr_html_(self) -> str:
        cells = [[_short(value) for value in row.values()] for row in self.rows]
        return html_columns(list(self.columns), cells)

    def __repr__(self) -> str:
        counts = Counter(row["status"] for row in self.outcomes)
        lines = [", ".join(f"{count} {status}" for status, count in counts.items())]
        lines += [verdicts_text(self.outcomes) or "no run has a verdict"]
        lines += [bars] if (bars := bars_text(self.columns)) else []
        lines += [self.fragility.sentence] if self.fragility is not None else []
        return "\n".join([*lines, *(visible(f"{self.folder / name}") for name in self.files)])


def _short(value: Any) -> str:
    """A cell of a table in a notebook."""
    return f"{value:.4g}" if isinstance(value, float) else f"{value}"


class Running(NamedTuple):
    """How the runs of a sweep are done.

    out        folder, else the next free results/NAME-N; what is done of this sweep there is kept
    overwrite  the table of another sweep there is replaced
    workers    processes; 0: one run after the other in this process
    executor   what does the runs in their place: see `engine.run`
    refused    one of REFUSED
    form       of the pictures, one of FORMATS
    refine     makes columns of error bars, of the folder, the runs planned, their rows, this and `tell`
    """

    out: Path | None = None
    overwrite: bool = False
    workers: int = 1
    executor: Any = None
    refused: str = "stop"
    form: str = FORMATS[0]
    refine: Callable[..., dict[str, list[Any]]] | None = None


def run_sweep(
    sweep: Sweep, name: str, running: Running, tell: Tell | None = None, text: str | None = None
) -> SweepResult:
    """Run what a sweep asks for, and write its table and pictures.

    name  of the sweep, or the path of its file
    tell  is called with a line for each run that ends
    text  of its file; made of its tables where there is none
    Raises SceneError before anything is written where a run cannot be planned or built, or nobody is there to run it.
    """
    if running.refused not in REFUSED:
        raise SceneError(f"refused = {running.refused!r:.60}; {nearest(str(running.refused), REFUSED)}")
    require_format(running.form)
    request, planned = planned_of(sweep)
    if running.executor is not None:
        from masonry.sweeps.cluster import require

        require(running.executor)
    folder = folder_for(name, sweep, running.out, running.overwrite)
    if not (folder / COPY).is_file() and running.refused == "stop":
        _require_buildable(sweep.name, planned, running.workers, folder)
    if tell is not None:
        tell(f"{len(planned)} runs, results in '{folder}'")
    return _run(sweep, name, planned, folder, running, tell, request, text)


def _require_buildable(name: str, planned: Sequence[Planned], workers: int, folder: Path) -> None:
    from masonry.sweeps.point_checks import require_buildable

    try:
        require_buildable(name, planned, workers)
    except BaseException:
        with suppress(OSError):  # it holds something
            folder.rmdir()
        raise


def planned_of(sweep: Sweep) -> "tuple[FragilityRequest | None, list[Planned]]":
    """Request of [fragility], None where there is no such table, and every run. Raises SceneError: also where a run has
    no such intensity, or no run can have such a measure."""
    if FRAGILITY not in sweep.raw:
        return None, plan(sweep)
    from masonry.sweeps.fragility.intensity import intensities
    from masonry.sweeps.fragility.request import read_request
    from masonry.sweeps.measured_number import require_measure

    varied = [key for part, keys in sweep.keys_by_part.items() if part != "[settings]" for key in keys]
    request, planned = read_request(sweep.raw[FRAGILITY], f"{sweep.name}: {FRAGILITY}", varied), plan(sweep)
    intensities(request, planned)
    if request.measure is not None:
        require_measure(request.measure, planned)
    return request, planned


def _run(
    sweep: Sweep,
    name: str,
    planned: Sequence[Planned],
    folder: Path,
    running: Running,
    tell: Tell | None,
    request: Any,
    text: str | None,
) -> SweepResult:
    from masonry.runtime.folder import writing
    from masonry.runtime.folders.own_files import remove_own
    from masonry.runtime.lock import sole
    from masonry.sweeps.engine import run_alone
    from masonry.sweeps.pictures.sweep_curves import draw
    from masonry.sweeps.pictures.sweep_map import draw_map
    from masonry.sweeps.sweep_table import PARQUET, TABLE, write_table

    title, form = Path(name).stem, running.form
    with sole(folder, DOING), writing(folder):
        if running.overwrite:
            remove_own(folder, PARQUET, TABLE)
        _write_request(folder, sweep, text)
        rows = run_alone([run.job for run in planned], folder, running.workers, tell, running.executor)
        columns = table_of(planned, rows)
        if running.refine is not None:
            columns |= running.refine(folder, planned, rows, running, tell)
        pictures = [draw(folder, title, planned, rows, form), *draw_map(folder, title, planned, rows, form)]
        files = (*write_table(folder, columns), *pictures)
        fragility, more = _fragility(planned, rows, folder, title, request, form)
    return SweepResult(folder, title, planned, rows, columns, fragility, (*files, *more))


def _write_request(folder: Path, sweep: Sweep, text: str | None) -> None:
    """sweep.toml, which `masonry sweep` runs again, and scene.toml of a scene that no file names."""
    import tomli_w

    from masonry.runtime.folders.own_files import ResultFiles

    with ResultFiles(folder) as files:
        files.text(COPY, tomli_w.dumps(sweep.raw) if text is None else text)
        if scene := scene_text(sweep):
            files.text(SCENE, scene)


def _fragility(
    planned: Sequence[Planned], rows: Sequence[Row], folder: Path, title: str, request: Any, form: str
) -> "tuple[Fragility | None, tuple[str, ...]]":
    """The fragility of what was run, where it was asked for, and its files in the folder."""
    if request is None:
        return None, ()
    from masonry.sweeps.fragility.fragility import fragility_of
    from masonry.sweeps.fragility.fragility_files import write_fragility

    fragility = fragility_of(request, planned, rows)
    return fragility, write_fragility(folder, title, fragility, form)

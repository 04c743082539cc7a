"""`masonry sweep`: runs a scene many times over, and makes one table of it.

Exit codes: 0 all runs ended, the failed ones as rows with their reason; 2 something wrong with the words, the sweep
file or a scene, and nothing was run; 130 interrupted, 143 terminated: what is done stays, and the same command goes on.
"""

from collections import Counter
from pathlib import Path
from typing import Any, NamedTuple

from masonry.errors import SceneError, visible
from masonry.runtime.ending import code_of, word_of
from masonry.runtime.processors import processors
from masonry.runtime.shell import OK, Parser, tell
from masonry.sweeps.read import FRAGILITY, Sweep, read
from masonry.sweeps.sweep_folder import COPY, DOING, folder_for

EPILOG = "What a sweep file holds, with three to copy: docs/sweep.md; the keys of a scene: docs/scene.md."


def parser() -> Parser:
    """The words that the command knows."""
    words = Parser(prog="masonry sweep", description="Run a scene many times over: one row a run.", epilog=EPILOG)
    words.add_argument("sweep", type=Path, metavar="SWEEP.toml", help="what to vary: a grid, a list, a Latin hypercube")
    words.add_argument("--out", type=Path, metavar="DIR", help="folder for the results (default results/SWEEP-N)")
    words.add_argument("--overwrite", action="store_true", help="replace the table of another sweep in DIR")
    words.add_argument("--list", action="store_true", help="say what each run would set, and run nothing")
    words.add_argument("--workers", type=int, default=processors(), metavar="N", help="processes (default: processors)")
    words.add_argument("--scheduler", metavar="ADDRESS", help="run on the Dask cluster of this scheduler instead")
    words.add_argument("--quiet", action="store_true", help="say nothing unless something goes wrong")
    return words


def main(arguments: list[str] | None = None) -> int:
    """Run the command; returns the exit code. Raises SceneError with one message before anything is written."""
    from masonry.sweeps.planned_runs import listing, plan

    words = parser().parse_args(arguments)
    if words.workers < 1:
        raise SceneError(f"--workers {words.workers}: 1 or more")
    sweep = read(words.sweep)
    request = _request(sweep)
    planned = plan(sweep)
    if words.list:
        print(listing(planned))
        return OK
    if words.scheduler is not None:
        from masonry.sweeps.cluster import require

        require(words.scheduler)
    folder = folder_for(words.sweep, sweep, words.out, words.overwrite)
    if not words.quiet:
        tell(f"{len(planned)} runs, results in '{folder}'")
    try:
        return _run(planned, folder, words, request)
    except KeyboardInterrupt as ended:
        tell(f"masonry: {word_of(ended)}; what is done stays in '{folder}', and the same command continues from there")
        return code_of(ended)


def _request(sweep: Sweep) -> Any:
    """What [fragility] asks for; None where there is no such table."""
    from masonry.sweeps.fragility.request import read_request

    if FRAGILITY not in sweep.raw:
        return None
    varied = [key for part, keys in sweep.keys_by_part.items() if part != "[settings]" for key in keys]
    return read_request(sweep.raw[FRAGILITY], f"{sweep.name}: {FRAGILITY}", varied)


def _run(planned: list[Any], folder: Path, words: Any, request: Any) -> int:
    from geometry.files.atomic import WholeFiles
    from masonry.runtime.folder import writing
    from masonry.runtime.lock import sole
    from masonry.sweeps.engine import run_alone
    from masonry.sweeps.pictures.sweep_curves import PICTURE, draw
    from masonry.sweeps.sweep_table import PARQUET, TABLE, table_of, verdicts_text, write_table

    with sole(folder, DOING), writing(folder):
        for stale in (PARQUET, TABLE, PICTURE) if words.overwrite and (folder / "runs").is_dir() else ():
            (folder / stale).unlink(missing_ok=True)
        with WholeFiles(folder) as files:
            files.text(COPY, words.sweep.read_text(encoding="utf-8-sig"))
        say = None if words.quiet else tell
        rows = run_alone([run.job for run in planned], folder, words.workers, say, words.scheduler)
        draw(folder, words.sweep.stem, planned, rows)
        tables = write_table(folder, table_of(planned, rows))
        report = _fragility(planned, rows, folder, words, request)
    if not words.quiet:
        counts = Counter(row["status"] for row in rows)
        print(", ".join(f"{count} {status}" for status, count in counts.items()))
        print(verdicts_text(rows) or "no run has a verdict")
        for sentence in report.sentences:
            print(sentence)
        print("\n".join(visible(f"{folder / name}") for name in (*tables, PICTURE, *report.files)))
    return OK


class _FragilityReport(NamedTuple):
    sentences: tuple[str, ...] = ()
    files: tuple[str, ...] = ()


def _fragility(planned: list[Any], rows: list[Any], folder: Path, words: Any, request: Any) -> _FragilityReport:
    """The fragility of what was run, where it was asked for: its files are in the folder."""
    if request is None:
        return _FragilityReport()
    from masonry.sweeps.fragility.fragility import fragility_of
    from masonry.sweeps.fragility.fragility_files import write_fragility

    fragility = fragility_of(request, planned, rows)
    return _FragilityReport((fragility.sentence,), write_fragility(folder, words.sweep.stem, fragility))

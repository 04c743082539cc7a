"""`masonry sweep`: runs a scene many times over, and makes one table of it.

Exit codes: 0 all runs ended, the failed ones as rows with their reason; 2 something wrong with the words, the sweep
file or a scene, and nothing was run; 3 no run came to its end; 130 interrupted, 143 terminated: what is done stays, and
the same command goes on.
"""

from collections import Counter
from pathlib import Path

from masonry.cli.study_words import require_workers, unless_interrupted
from masonry.runtime.processors import processors
from masonry.runtime.shell import OK, STOPPED, Parser, add_format, complain, tell

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
    words.add_argument(
        "--refused",
        choices=("stop", "keep"),
        default="stop",
        help="runs that cannot be built: run nothing (default), or keep them as rows with their reason",
    )
    add_format(words)
    words.add_argument("--quiet", action="store_true", help="say nothing unless something goes wrong")
    return words


def main(arguments: list[str] | None = None) -> int:
    """Run the command; returns the exit code. Raises SceneError with one message before anything is written."""
    words = parser().parse_args(arguments)
    require_workers(words)
    from masonry.sweeps.planned_runs import listing
    from masonry.sweeps.read import read
    from masonry.sweeps.sweep_run import Running, planned_of, run_sweep
    from masonry.sweeps.work import OK as DONE

    sweep = read(words.sweep)
    if words.list:
        print(listing(planned_of(sweep)[1]))
        return OK
    running = Running(words.out, words.overwrite, words.workers, words.scheduler, words.refused, words.format)
    if sweep.error_bars:
        from masonry.sweeps.error_bars.sweep_bars import refining

        running = refining(sweep, running)
    text = words.sweep.read_text(encoding="utf-8-sig")
    heard = None if words.quiet else tell
    result, code = unless_interrupted(lambda: run_sweep(sweep, str(words.sweep), running, heard, text))
    if result is None:
        return code
    if not words.quiet:
        print(result)
    if all(row["status"] != DONE for row in result.outcomes):
        reason, count = Counter(row["reason"] for row in result.outcomes).most_common(1)[0]
        return complain(f"no run came to its end; of {count} of {len(result.outcomes)} runs: {reason}", STOPPED)
    return OK

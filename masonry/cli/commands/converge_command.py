"""`masonry converge`: a scene is refined, and the error of its numbers told, beside what a smaller one costs.

Exit codes: 0 the table is there; 2 something wrong with the words or the scene, and nothing was run; 3 the scene as it
is did not come to its end; 130 interrupted, 143 terminated: what is done stays, and the same command goes on.
"""

from typing import TYPE_CHECKING

from masonry.cli.study_words import add_folder, add_scene, require_workers, unless_interrupted
from masonry.errors import SceneError, visible
from masonry.runtime.shell import OK, STOPPED, Parser, tell
from masonry.runtime.tables import columns

if TYPE_CHECKING:
    from masonry.scene import Scene

EPILOG = "What is refined and what the table says: docs/converge.md."


def parser() -> Parser:
    """The words that the command knows."""
    words = Parser(
        prog="masonry converge",
        description="Run a scene again with a finer pace, more contact points, smaller tets or a shorter time step: "
        "how far are its numbers from what the same model gives when it is refined without end?",
        epilog=EPILOG,
    )
    add_scene(words)
    words.add_argument("--of", metavar="NUMBERS", help="numbers of summary.json, with commas (default: the usual ones)")
    words.add_argument(
        "--modes", type=int, metavar="N", help="the frequencies of N modes, in place of numbers of a run"
    )
    words.add_argument(
        "--to", metavar="SHARE", help='such as "1 %%": choose settings whose error is smaller, and write converged.toml'
    )
    words.add_argument(
        "--cost", type=float, metavar="N", help="times the scene itself that its runs may take (default 6, with tets 8)"
    )
    words.add_argument("--list", action="store_true", help="say what the first runs would set, and run nothing")
    add_folder(words, "convergence")
    words.add_argument("--scheduler", metavar="ADDRESS", help="run on the Dask cluster of this scheduler instead")
    return words


def main(arguments: list[str] | None = None) -> int:
    """Run the command; returns the exit code. Raises SceneError with one message before anything is written."""
    words = parser().parse_args(arguments)
    require_workers(words)
    if words.of is not None and words.modes is not None:
        raise SceneError("--of names numbers, and --modes the frequencies of so many modes: leave one of them out")
    numbers = [key.strip() for key in words.of.split(",")] if words.of is not None else []

    from masonry import scene
    from masonry.sweeps.convergence.convergence import converge, require_words
    from masonry.sweeps.convergence.refinement.analyses import frequency_keys

    loaded = scene.load(words.scene, words.overrides)
    numbers = numbers if words.modes is None else frequency_keys(words.modes)
    require_words(loaded, numbers, words.to, words.cost)
    if words.list:
        print(_listing(loaded, words.cost, numbers))
        return OK
    heard = None if words.quiet else tell
    result, code = unless_interrupted(
        lambda: converge(
            loaded,
            words.out,
            of=numbers,
            to=words.to,
            cost=words.cost,
            workers=words.scheduler or words.workers,
            tell=heard,
            overwrite=words.overwrite,
            form=words.format,
        )
    )
    if result is None:
        return code
    if not result.has_come_to_its_end:
        tell(f"masonry: the scene as it is: {result.runs[0][1]['reason']}")
        return STOPPED
    if not words.quiet:
        print(f"{result}\n")
        print("\n".join(visible(f"{result.folder / name}") for name in result.files))
    return OK


def _listing(loaded: "Scene", cost: float | None, numbers: list[str]) -> str:
    from masonry.sweeps.convergence.beside_resolution import runs_beside
    from masonry.sweeps.convergence.convergence_table import settings_words
    from masonry.sweeps.convergence.refinement.analyses import analysis_of
    from masonry.sweeps.convergence.refinement.campaign import Campaign

    analysis = analysis_of(numbers)
    trials = [*Campaign(loaded, cost, analysis).first(), *(runs_beside(loaded) if analysis.scatters else [])]
    rows = [(trial.label, settings_words(trial) or "-", f"{trial.cost:.2g} times the scene") for trial in trials]
    return "\n".join(map(visible, columns(rows)))

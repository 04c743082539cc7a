"""`masonry paper`: every experiment of the reference paper, run again; one page with its figures and claims.

Exit codes: 0 the page was written, whatever the claims came to; 1 a run is not sound; 2 wrong words; 130 interrupted,
143 terminated: what is done stays, and the same command goes on.
"""

import time
from pathlib import Path

from geometry.files.atomic import WholeFiles
from masonry.errors import SceneError
from masonry.runtime.ending import code_of, word_of
from masonry.runtime.folder import RESULTS, writing
from masonry.runtime.shell import Parser, tell
from masonry.runtime.tables import columns
from verification.html.cover import require_ours
from verification.paper import catalogue, gathering, page
from verification.paper.experiment import Shown

OUT = RESULTS / "paper"
NAME = "paper.html"
WORKERS = 2
EPILOG = "Runs that the same program has made in the same folder are not made again."


def parser() -> Parser:
    """The words that the command knows."""
    words = Parser(prog="masonry paper", description=(__doc__ or "").partition("\n")[0], epilog=EPILOG)
    words.add_argument("experiments", nargs="*", metavar="EXPERIMENT", help="only these; without any all of them")
    words.add_argument("--quick", action="store_true", help="fewer runs, loaded less carefully: under three minutes")
    words.add_argument("--list", action="store_true", help="name the experiments, and run none")
    words.add_argument("--out", type=Path, default=OUT, metavar="DIR", help=f"folder (default {OUT})")
    words.add_argument("--workers", type=int, default=WORKERS, metavar="N", help=f"processes (default {WORKERS})")
    return words


def main(arguments: list[str] | None = None) -> int:
    """Run the command; returns the exit code. Raises SceneError with one message where the words are wrong."""
    words = parser().parse_args(arguments)
    experiments = catalogue.chosen(words.experiments)
    if words.list:
        print("\n".join(columns([(e.name, e.title) for e in experiments])))
        return 0
    if words.workers < 1:
        raise SceneError(f"--workers {words.workers}: 1 or more")
    require_ours(words.out / NAME)
    begun = time.perf_counter()
    try:
        with writing(words.out):
            shown = gathering.gather(experiments, words.out, words.quick, words.workers, tell)
            with WholeFiles(words.out) as files:
                files.text(NAME, page.html_of(shown, time.perf_counter() - begun, words.quick))
    except KeyboardInterrupt as ended:
        tell(f"masonry: {word_of(ended)}; runs that are done stay in '{words.out}', and the same command goes on there")
        return code_of(ended)
    print(summary(shown))
    print(f"page     {words.out / NAME}")
    return 0 if all(c.holds for s in shown for c in s.soundness) else 1


def summary(shown: list[Shown]) -> str:
    """A line for each claim that does not hold or cannot be decided, and the count."""
    lines = []
    for entry in shown:
        for claim in (c for c in [*entry.section.claims, *entry.soundness] if not c.holds):
            lines.append(f"{entry.experiment.name}: {claim.says}: {page.WORDS[claim.holds][0]}: {claim.measured}")
    return "\n".join([*lines, page.verdict(shown).sentence])

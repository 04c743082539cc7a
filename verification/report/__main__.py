"""`python -m verification.report`: runs all cases and studies, writes results/report.html and results/records.json."""

import argparse
import time
from collections.abc import Callable
from importlib.util import find_spec
from pathlib import Path
from typing import Protocol

from geometry.files.atomic import WholeFiles
from verification import catalogue, records, runner, studies
from verification.html import cover
from verification.html.page import Chapter
from verification.report import cases

Tell = Callable[[str], None]
OUT = Path("results")
CASES, PAPER = "cases", "paper"
PAGE = "report.html"


class StudyChapter(Protocol):
    """Makes the chapter of a study; a quick one asks for less, in the same words."""

    def __call__(self, tell: Tell, *, quick: bool) -> Chapter: ...


def study_chapters() -> dict[str, StudyChapter]:
    """Name -> `chapter` of every module of `verification.studies` that has one, by its ORDER."""
    chosen = sorted((m for m in catalogue.modules_of(studies) if hasattr(m, "chapter")), key=lambda m: m.ORDER)
    return {m.__name__.rpartition(".")[2]: m.chapter for m in chosen}


def write(chapters: list[Chapter], seconds: float, out: Path, name: str = PAGE) -> tuple[Path, Path]:
    """The page, and the records beside those of other versions. Returns both paths."""
    numbers = records.save([records.origin() | {"chapter": c.title} | r for c in chapters for r in c.records], out)
    with WholeFiles(out) as files:
        files.text(name, cover.html_of(chapters, seconds))
    return out / name, numbers


def main(arguments: list[str] | None = None) -> int:
    """The command line; returns the exit code."""
    parser = argparse.ArgumentParser(prog="python -m verification.report", description=__doc__)
    parser.add_argument("--out", type=Path, default=OUT, help="folder to write to (default: results)")
    parts = [
        CASES,
        *study_chapters(),
        *([PAPER] if find_spec("verification.paper") else []),
    ]  # no part of what pip installs
    parser.add_argument("--only", nargs="+", choices=parts, metavar="PART", help=f"of {', '.join(parts)}")
    parser.add_argument("--quick", action="store_true", help="quick cases, less of each study and of the paper")
    words = parser.parse_args(arguments)
    begun = time.perf_counter()

    def tell(text: str) -> None:
        print(f"{time.perf_counter() - begun:5.0f} s  {text}", flush=True)

    cover.require_ours(words.out / PAGE)
    records.require_writable(words.out)
    chapters = []
    if not words.only or CASES in words.only:
        wanted = [case for case in catalogue.catalogue().values() if case.quick or not words.quick]
        outcomes = runner.run(wanted, tell=tell)
        chapters += cases.chapters(outcomes, time.perf_counter() - begun)
    made = {name: chapter for name, chapter in study_chapters().items() if not words.only or name in words.only}
    chapters += [chapter(tell, quick=words.quick) for chapter in made.values()]
    if PAPER in (words.only or parts):
        from verification.paper import catalogue as experiments
        from verification.paper import gathering, page

        every = list(experiments.catalogue().values())
        chapters += page.chapters(gathering.gather(every, words.out / PAPER, words.quick, tell=tell))
    path, numbers = write(chapters, time.perf_counter() - begun, words.out)
    tell(f"{sum(len(c.records) for c in chapters)} records")
    for verdict in (v for c in chapters for v in c.verdicts):
        print(f"{verdict.area:22} {cover.WORDS[verdict.kind]:14} {verdict.sentence}")
    print(f"report   {path}\nrecords  {numbers}")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())

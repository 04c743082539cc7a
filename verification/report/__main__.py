"""`python -m verification.report`: runs the studies, writes results/report.html and results/records.json."""

import argparse
import importlib
import json
import pkgutil
import time
from collections.abc import Callable
from pathlib import Path

from verification import studies
from verification.report import cover
from verification.report.page import Chapter

Tell = Callable[[str], None]
OUT = Path("results")


def found() -> dict[str, Callable[[Tell], Chapter]]:
    """Name -> `chapter` of every module of `verification.studies` that has one, by its ORDER."""
    modules = [
        importlib.import_module(f"{studies.__name__}.{entry.name}") for entry in pkgutil.iter_modules(studies.__path__)
    ]
    chosen = sorted((m for m in modules if hasattr(m, "chapter")), key=lambda m: m.ORDER)
    return {m.__name__.rpartition(".")[2]: m.chapter for m in chosen}


def write(chapters: list[Chapter], seconds: float, out: Path) -> tuple[Path, Path]:
    """The page and the records; the numbers are strict JSON. Returns both paths."""
    out.mkdir(parents=True, exist_ok=True)
    records = [{"chapter": c.title, **entry} for c in chapters for entry in c.records]
    page, numbers = out / "report.html", out / "records.json"
    numbers.write_text(json.dumps(records, indent=1, allow_nan=False) + "\n", encoding="utf-8")
    page.write_text(cover.html_of(chapters, seconds), encoding="utf-8")
    return page, numbers


def main(arguments: list[str] | None = None) -> int:
    """The command line; returns the exit code."""
    parser = argparse.ArgumentParser(prog="python -m verification.report", description=__doc__)
    parser.add_argument("--out", type=Path, default=OUT, help="folder to write to (default: results)")
    parser.add_argument("--only", nargs="+", choices=list(found()), metavar="STUDY", help=f"of {', '.join(found())}")
    words = parser.parse_args(arguments)
    begun = time.perf_counter()

    def tell(text: str) -> None:
        print(f"{time.perf_counter() - begun:5.0f} s  {text}", flush=True)

    chapters = [chapter(tell) for name, chapter in found().items() if not words.only or name in words.only]
    page, numbers = write(chapters, time.perf_counter() - begun, words.out)
    tell(f"{sum(len(c.records) for c in chapters)} records")
    for verdict in (v for c in chapters for v in c.verdicts):
        print(f"{verdict.area:15} {cover.WORDS[verdict.kind]:14} {verdict.sentence}")
    print(f"report   {page}\nrecords  {numbers}")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())

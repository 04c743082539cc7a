"""`masonry verify`: is what the program computes right? Runs cases with known answers and says how far off it is.

Exit codes: 0 all cases hold, 1 one does not (or there is none that is built; or, compared with older records, a number
moved), 2 wrong words, 130 interrupted.
"""

import json
import time
from argparse import Namespace
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from masonry.errors import SceneError
from masonry.runtime.progress import Tell
from masonry.runtime.shell import Parser, complain, tell
from verification import catalogue, records, runner, text
from verification.case import Case
from verification.comparison import compare, last_version
from verification.html.cover import require_ours
from verification.outcome import CaseOutcome

HOLDS, FAILS = 0, 1
PAGE = "verify.html"
FORMATS = {"text": text.as_text, "md": text.as_markdown}
EPILOG = (
    "Without a word: the quick cases, under three minutes even where everything is compiled first. "
    "`make report` runs everything and explains it on one page."
)


def parser() -> Parser:
    """The words that the command knows."""
    words = Parser(prog="masonry verify", description=(__doc__ or "").partition("\n")[0], epilog=EPILOG)
    words.add_argument("cases", nargs="*", metavar="CASE", help="run these; without any the quick ones")
    words.add_argument("--full", action="store_true", help="run all cases, also those that take a minute")
    words.add_argument("--list", action="store_true", help="name all cases, and run none")
    words.add_argument("--format", choices=("text", "md", "json"), default="text", help="of what is printed")
    words.add_argument(
        "--out", type=Path, metavar="DIR", help="add the numbers to DIR/records.json and write DIR/verify.html"
    )
    words.add_argument(
        "--compare",
        type=Path,
        nargs="+",
        metavar="RECORDS",
        help="OLD.json: compare this run with older records; OLD.json NEW.json: two files, and run nothing",
    )
    words.add_argument(
        "--missing",
        action="store_true",
        help="skip what holds by DIR/records.json (--out DIR) of this version",
    )
    words.add_argument("--workers", type=int, default=runner.WORKERS, metavar="N", help="processes (default 2)")
    return words


@dataclass(frozen=True, repr=False)
class Verification:
    """Result of some cases; it prints as `masonry verify` does."""

    outcomes: list[CaseOutcome]
    seconds: float

    @property
    def holds(self) -> bool:
        """Whether every case holds, and one at least proves something."""
        return all(o.holds for o in self.outcomes) and any(o.proves for o in self.outcomes)

    def __repr__(self) -> str:
        last = text.verdict(self.outcomes, self.seconds)
        return text.as_text(list(map(text.row, self.outcomes)), text.HEADER, text.notes(self.outcomes), last)


def verify(names: Sequence[str], full: bool, workers: int, tell: Tell | None) -> Verification:
    """See `masonry.verify`. Raises SceneError, and `runner.CutShort` where it is interrupted."""
    if not isinstance(workers, int) or workers < 0:
        raise SceneError(f"workers = {workers!r:.20}: 0 (all in this process) or more")
    begun = time.perf_counter()
    outcomes = runner.run(_cases(names, full, "full"), workers, tell)
    return Verification(outcomes, time.perf_counter() - begun)


def _cases(names: Sequence[str], full: bool, word: str) -> list[Case]:
    """Those that are named, else the quick ones, or all."""
    known = catalogue.catalogue()
    if full and names:
        raise SceneError(f"{word} runs all cases: name none beside it")
    return catalogue.chosen(names, known) or [c for c in known.values() if full or c.quick]


def main(arguments: list[str] | None = None) -> int:
    """Run the command; returns the exit code. Raises SceneError with one message where the words are wrong."""
    words = parser().parse_args(arguments)
    if words.compare and len(words.compare) > 2:
        raise SceneError("--compare takes one or two files of records; name the cases before it")
    if words.compare and len(words.compare) == 2:
        old, new = map(records.load, words.compare)
        return _compare(words.format, old, last_version(new))
    if words.workers < 0:
        raise SceneError(f"--workers {words.workers}: 0 (all in this process) or more")
    if words.list:
        print(text.listing(catalogue.catalogue().values()))
        return HOLDS
    cases = _cases(words.cases, words.full, "--full")
    old = records.load(words.compare[0]) if words.compare else []
    if words.out:
        require_ours(words.out / PAGE)
        records.require_writable(words.out)
    if words.missing:
        cases = _missing(cases, words.out)
        if not cases:
            return HOLDS
    begun = time.perf_counter()
    try:
        outcomes = runner.run(cases, words.workers, tell)
    except runner.CutShort as cut:
        return _cut(words, cut, len(cases), time.perf_counter() - begun)
    code = _say(words.format, outcomes, time.perf_counter() - begun)
    if words.out:
        _write(words.out, outcomes, time.perf_counter() - begun)
    if words.compare:
        new = [r for o in outcomes for r in records.records_of(o)]
        code = max(code, _compare(words.format, old, new))
    return code


def _missing(cases: list[Case], folder: Path | None) -> list[Case]:
    """Those that do not hold by the records of this version in the folder, or have none."""
    if folder is None:
        raise SceneError("--missing skips what is in the records of a folder: name it with --out DIR")
    known = records.done(folder)
    missing = [case for case in cases if case.name not in known]
    tell(f"{len(cases) - len(missing)} of {len(cases)} cases hold by the records of this version in '{folder}'")
    return missing


def _cut(words: Namespace, cut: runner.CutShort, count: int, seconds: float) -> int:
    """Say and keep what was done by the time that the run was told to end."""
    if cut.done:
        _say(words.format, cut.done, seconds)
        if words.out:
            _write(words.out, cut.done, seconds)
    which = " ".join(["--full"] if words.full else words.cases)
    again = f"masonry verify {f'{which} ' if which else ''}--out {words.out} --missing"
    elsewhere = "their numbers are above; with --out DIR they are kept in a file"
    go_on = f"continue with: {again}" if words.out else elsewhere
    return complain(f"interrupted; {len(cut.done)} of {count} cases are done; {go_on}", cut.code)


def _say(form: str, outcomes: list[CaseOutcome], seconds: float) -> int:
    """Print what came of the cases."""
    if form == "json":
        print(json.dumps([r for o in outcomes for r in records.records_of(o)], indent=1, allow_nan=False))
    else:
        rows = list(map(text.row, outcomes))
        last = text.verdict(outcomes, seconds)
        print(FORMATS[form](rows, text.HEADER, text.notes(outcomes), last))
    return HOLDS if all(o.holds for o in outcomes) and any(o.proves for o in outcomes) else FAILS


def _compare(form: str, old: list[records.Record], new: list[records.Record]) -> int:
    """Print how `new` differs from the last other version in `old`."""
    before = last_version(old, records.version_of(new[0])) if new else old
    changes = compare(before, new)
    if form == "json":
        print(json.dumps([{"where": c.where, "says": c.sentence, "moved": c.bad} for c in changes], indent=1))
    else:
        title = " ".join(records.version_of(before[0])) if before else "nothing"
        sentences = text.changes_notes(changes)
        print(FORMATS[form]([], ("compared with", title), sentences, ""))
    return FAILS if any(c.bad for c in changes) else HOLDS


def _write(folder: Path, outcomes: list[CaseOutcome], seconds: float) -> None:
    """Records and page."""
    from verification.report.__main__ import write
    from verification.report.cases import chapters

    page, numbers = write(chapters(outcomes, seconds), seconds, folder, PAGE)
    tell(f"page     {page}")
    tell(f"records  {numbers}")

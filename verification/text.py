"""Text of `masonry verify`: a row per case, then in sentences what failed, what is too loose, what is not built."""

import textwrap
from collections.abc import Iterable, Sequence

from masonry.errors import visible
from masonry.runtime.progress import duration
from masonry.runtime.tables import columns
from verification.case import LOOSE, UNEXPECTED, Case
from verification.comparison import Change
from verification.outcome import CaseOutcome, shortcomings

HEADER = ("case", "row", "status", "worst error", "tolerance", "checks", "energy", "seconds")
NUMBERS = ("worst error", "tolerance", "checks", "energy", "seconds")
WIDTH = 118


def row(outcome: CaseOutcome) -> tuple[str, ...]:
    """A case in the columns of HEADER; the error that comes nearest to its tolerance stands for all."""
    worst, ledgers = outcome.worst, outcome.findings.imbalance.values()
    return (
        outcome.case.name,
        outcome.case.row,
        outcome.status,
        f"{worst.error:+.1e}" if worst else "-",
        f"{worst.tolerance.limit:.0e}" if worst else "-",
        str(len(outcome.findings.checks)) if worst else "-",
        f"{max(ledgers):.0e}" if ledgers else "-",
        f"{outcome.seconds:.1f}",
    )


def failures(outcome: CaseOutcome) -> list[str]:
    """Why a case does not hold, each in a sentence."""
    if outcome.holds:
        return []
    sentences = shortcomings(outcome.findings) if outcome.status == "FAIL" else [outcome.reason]
    return [f"{outcome.case.name}: {sentence}" for sentence in sentences]


def loose(outcomes: Iterable[CaseOutcome]) -> list[str]:
    """Checks that pass with so much to spare that they would let a mistake through."""
    return [
        f"{o.case.name}: {c.quantity} is off by {abs(c.error):.1e}, its tolerance is {c.tolerance.limit:.0e}"
        for o in outcomes
        for c in o.too_loose
    ]


def verdict(outcomes: Sequence[CaseOutcome], seconds: float) -> str:
    """All of it in one line."""
    count = {status: sum(o.status == status for o in outcomes) for status in ("PASS", "FAIL", "ERROR", "NOT BUILT")}
    checks = sum(len(o.findings.checks) for o in outcomes)
    words = [f"{count['PASS']} of {len(outcomes)} cases hold ({checks} numbers)"]
    words += [f"{n} {word}" for word, n in (("fail", count["FAIL"]), ("in error", count["ERROR"])) if n]
    words += [f"{count['NOT BUILT']} not built"] if count["NOT BUILT"] else []
    words += [] if count["PASS"] else ["so nothing is proven"]
    return f"{', '.join(words)}; {duration(seconds)}."


def notes(outcomes: Sequence[CaseOutcome]) -> dict[str, list[str]]:
    """Heading -> its sentences, of those that have any."""
    by_heading = {
        "Does not hold": [sentence for o in outcomes for sentence in failures(o)],
        f"Too loose (passes by more than {LOOSE:.0f} times)": loose(outcomes),
        f"Worse than expected (holds, but by more than {UNEXPECTED:.0f} times the error that it should have)": [
            f"{o.case.name}: {c.quantity} is off by {abs(c.error):.1e}, expected {c.tolerance.expected:.0e}"
            for o in outcomes
            for c in o.worse
        ],
        "Tolerance that does not follow from the expected error": [
            f"{o.case.name}: {c.quantity}: tolerance {c.tolerance.limit:.0e}, expected {c.tolerance.expected:.0e}"
            for o in outcomes
            for c in o.ill_set
        ],
        "Not built": [f"{o.case.name}: {o.reason}" for o in outcomes if o.status == "NOT BUILT"],
    }
    return {heading: sentences for heading, sentences in by_heading.items() if sentences}


def changes_notes(changes: Sequence[Change]) -> dict[str, list[str]]:
    """A comparison under headings; one sentence where nothing changed."""
    by_heading = {
        "Moved": [f"{c.where}: {c.sentence}" for c in changes if c.bad],
        "Changed, no harm": [f"{c.where}: {c.sentence}" for c in changes if not c.bad],
    }
    sections = {heading: sentences for heading, sentences in by_heading.items() if sentences}
    return sections or {
        "Compared": ["no number moved by more than its tolerance, no time changed by more than 1.5 times"]
    }


def as_text(rows: Sequence[Sequence[str]], header: Sequence[str], under: dict[str, list[str]], last: str) -> str:
    """Aligned columns, then wrapped sentences."""
    numbers = [k for k, name in enumerate(header) if name in NUMBERS]
    lines = columns([list(map(visible, cells)) for cells in (header, *rows)], numbers)
    for heading, sentences in under.items():
        lines += ["", f"{heading}:"]
        for sentence in sentences:
            lines += textwrap.wrap(visible(sentence), WIDTH, initial_indent="  ", subsequent_indent="    ")
    return "\n".join([*lines, *(["", last] if last else [])])


def as_markdown(rows: Sequence[Sequence[str]], header: Sequence[str], under: dict[str, list[str]], last: str) -> str:
    """A table, headings and lists."""

    def line(cells: Iterable[str]) -> str:
        return "| " + " | ".join(visible(cell).replace("|", "\\|") for cell in cells) + " |"

    rule = "|" + "|".join("---:" if name in NUMBERS else "---" for name in header) + "|"
    lines = [line(header), rule, *map(line, rows)]
    for heading, sentences in under.items():
        lines += ["", f"### {heading}", *(f"- {visible(sentence)}" for sentence in sentences)]
    return "\n".join([*lines, *(["", last] if last else [])])


def listing(cases: Iterable[Case]) -> str:
    """Every case there is: name, row of the catalogue, whether the quick run has it, title."""
    rows = [(c.name, c.row, "quick" if c.quick else "full", c.area, c.title) for c in cases]
    return as_text(rows, ("case", "row", "run", "area", "title"), {}, "")

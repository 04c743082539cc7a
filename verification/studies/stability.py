"""Stability: maps of knobs at their limits; every cell is right, or says why it is not."""

from collections.abc import Callable

from verification.html import page
from verification.stability import suite
from verification.stability.cells import Grid, Outcome
from verification.stability.drawing import heat_map, written

ORDER = 30
Tell = Callable[[str], None]


def chapter(tell: Tell, chosen: list[Grid] | None = None, full: bool = True) -> page.Chapter:
    """All maps as pictures, each with a table of what was said."""
    made = page.Chapter("Stability and extremes")
    made.parts.append(page.paragraph(INTRODUCTION))
    counts: dict[str, int] = {}
    for grid in suite.cells(full) if chosen is None else chosen:
        if not grid.cells:
            continue
        tell(f"stability: {grid.title}")
        outcomes = suite.run(grid)
        for outcome in outcomes:
            counts[outcome.kind] = counts.get(outcome.kind, 0) + 1
            made.records += outcome.records
        made.parts += parts_of(grid, outcomes)
    made.verdicts.append(verdict(counts))
    return made


def parts_of(grid: Grid, outcomes: list[Outcome]) -> list[str]:
    """Heading, note, picture, and the table of the reasons: what is red is open, the others are folded away."""
    caption = f"{grid.title}: colour, what became of each run; number and bar, its error against the {grid.against}."
    parts = [page.heading(grid.title)]
    parts += [page.paragraph(grid.note)] if grid.note else []
    parts.append(page.picture(heat_map(grid, outcomes), caption))
    wrong = [outcome for outcome in outcomes if outcome.kind == "bad"]
    if wrong:
        parts.append(table_of(grid, wrong))
    spoken = [outcome for outcome in outcomes if outcome.reason and outcome.kind != "bad"]
    if spoken:
        parts.append(page.folded(f"What the program said in {len(spoken)} cells", table_of(grid, spoken)))
    return parts


def table_of(grid: Grid, outcomes: list[Outcome]) -> str:
    """Row, column, status, error and reason in full."""
    rows = [
        [o.row, o.column, page.Cell(o.status, o.kind), written(o.error) if o.error == o.error else "-", o.reason]
        for o in outcomes
    ]
    return page.table([grid.row_title, grid.column_title, "status", "error", "reason"], rows)


def verdict(counts: dict[str, int]) -> page.Verdict:
    """One sentence on all cells."""
    total = sum(counts.values())
    bad, stopped = counts.get("bad", 0), counts.get("stop", 0)
    sentence = (
        f"{total} runs at and beyond the limits: {counts.get('ok', 0)} right, {counts.get('warn', 0)} to be read with "
        f"care, {stopped} refused or stopped with a reason, {bad} wrong without a word, not finite, or not refused "
        "where they must be."
    )
    return page.Verdict("Stability", "bad" if bad else "ok", sentence)


INTRODUCTION = (
    "Each cell is one run. Green: OK, and within 1 % of the reference (the larger error of peak and dissipated energy, "
    "the latter relative to the work done). Yellow: off by up to 5 %, or the program itself warns of the result. "
    "Grey: refused before the run or stopped during it, with a reason that names the key, or the step and the block "
    "or contact. Red: off by more than 5 % without a word, results that are not finite, or a cell that did not end as "
    "it must; there must be none."
)

"""Stability: maps of knobs at their limits; every cell is right, or says why it is not."""

import math
from collections import Counter
from collections.abc import Callable

from verification.html import page
from verification.stability import maps
from verification.stability.cells import CellOutcome, Grid

ORDER = 30
Tell = Callable[[str], None]


def chapter(tell: Tell, chosen: list[Grid] | None = None, quick: bool = False) -> page.Chapter:
    """All maps, each with a table of what was said; quick ones have a few cells."""
    made = page.Chapter("Stability and extremes")
    made.add(INTRODUCTION)
    kinds: Counter[str] = Counter()
    for grid in maps.all_grids(not quick) if chosen is None else chosen:
        if grid.cells:
            tell(f"stability: {grid.title}")
            outcomes = maps.run(grid)
            kinds.update(outcome.kind for outcome in outcomes)
            made.records += [record for outcome in outcomes for record in outcome.records]
            made.add(*parts_of(grid, outcomes))
    sentence = (
        f"{kinds.total()} runs at and beyond the limits: {kinds['ok']} right, {kinds['warn']} to be read with care, "
        f"{kinds['stop']} refused or stopped with a reason, {kinds['bad']} wrong without a word, not finite, or not "
        "refused where they must be."
    )
    made.judge("Stability", not kinds["bad"], sentence)
    return made


def parts_of(grid: Grid, outcomes: list[CellOutcome]) -> list[str]:
    """Heading, note, map, and the table of the reasons: what is red is open, the others are folded away."""
    wrong = [outcome for outcome in outcomes if outcome.kind == "bad"]
    spoken = [outcome for outcome in outcomes if outcome.reason and outcome.kind != "bad"]
    said = f"What the program said in {len(spoken)} cells"
    return [
        page.heading(grid.title),
        grid.note,
        map_of(grid, outcomes),
        table_of(grid, wrong) if wrong else "",
        page.folded(said, table_of(grid, spoken)) if spoken else "",
    ]


def map_of(grid: Grid, outcomes: list[CellOutcome]) -> str:
    """The cells in the colour of their status, each with its error and the status where it is not OK."""
    cells: dict[tuple[str, str], page.TableCell] = {}
    for o in outcomes:
        word = "" if o.status == "OK" else o.status.lower()
        error = written(o.error) if math.isfinite(o.error) else ""
        cells[o.row, o.column] = page.TableCell(error or word, o.kind, word if error else "")
    rows = [[row, *(cells.get((row, column), "") for column in grid.columns)] for row in grid.rows]
    titles = f"{grid.row_title} / {grid.column_title}" if grid.column_title else grid.row_title
    caption = f"{grid.title}: colour, what became of each run; number, its error against the {grid.against}."
    return page.table([titles, *grid.columns], rows, caption)


def written(error: float) -> str:
    """An error in percent where a person reads it so, else as a power of ten."""
    if error == 0.0:
        return "0"
    return f"{100 * error:.2g} %" if error >= 1e-5 else f"{error:.0e}".replace("e-0", "e-")


def table_of(grid: Grid, outcomes: list[CellOutcome]) -> str:
    """Row, column, status, error and reason in full."""
    rows = [
        [o.row, o.column, page.TableCell(o.status, o.kind), written(o.error) if o.error == o.error else "-", o.reason]
        for o in outcomes
    ]
    return page.table([grid.row_title, grid.column_title, "status", "error", "reason"], rows)


INTRODUCTION = (
    "Each cell is one run. Green: OK, and within 1 % of the reference (the larger error of peak and dissipated energy, "
    "the latter relative to the work done). Yellow: off by up to 5 %, or the program itself warns of the result. "
    "Grey: refused before the run or stopped during it, with a reason that names the key, or the step and the block "
    "or contact. Red: off by more than 5 % without a word, results that are not finite, or a cell that did not end as "
    "it must; there must be none."
)

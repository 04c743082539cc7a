"""Stability: what happens at and beyond the bound, at odd stiffnesses, without damping, and at rough rates."""

import math
from collections.abc import Callable

from verification.report import page
from verification.studies import trial
from verification.studies.couplet import exact_values
from verification.studies.grids import Grid, grids
from verification.studies.trial import Trial

ORDER = 30
GOOD, POOR = 0.01, 0.05
Tell = Callable[[str], None]


def error_of(grid: Grid, one: Trial, base: Trial) -> float:
    """Largest relative error of peak and dissipated energy, against the closed form or the grid's first good run."""
    if not one.ok or not base.ok:
        return math.nan
    reference = exact_values(one) if grid.closed else {q: base.value(q) for q in ("peak", "dissipated")}
    return max(abs(one.value(q) - reference[q]) / abs(reference[q]) for q in ("peak", "dissipated"))


def shown(one: Trial, error: float) -> page.Cell:
    """What became of a run: a wrong answer that does not say so itself is the worst of all."""
    if one.status != "OK":
        kind = "bad" if one.status == "NOT FINITE" else "stop"
        return page.Cell(one.status, kind, page.short(one.reason))
    note = f"error {page.percent(error)}"
    if not one.quasi_static:
        says = "the run itself says: not quasi-static"
        return page.Cell(
            "OK" if error <= POOR else "WRONG, SAYS SO", "warn" if error <= POOR else "stop", f"{note}; {says}"
        )
    return page.Cell("OK", "ok" if error <= GOOD else "warn" if error <= POOR else "bad", note)


def chapter(tell: Tell, chosen: list[Grid] | None = None) -> page.Chapter:
    """All grids as coloured tables."""
    made = page.Chapter("Stability and extremes")
    made.parts.append(
        page.paragraph(
            "Each cell is one run. Green: OK, and within 1 % of the reference (the larger error of peak and dissipated "
            "energy). Yellow: OK, but off by up to 5 %, or the run itself says that it is not quasi-static. Grey: "
            "no result to be used, and the program says why: STOPPED during the run, REFUSED before it, or off by more "
            "than 5 % and reported as not quasi-static. Red: off by more than 5 % without a word, or results that are "
            "not finite; there must be none. The couplet is compared with its closed form; the wallette with its run "
            "at 0.3 of the bound, at the paper's rate, or at equal stiffness (there the change is partly real)."
        )
    )
    counts: dict[str, int] = {}
    for grid in grids() if chosen is None else chosen:
        tell(f"stability: {grid.title}")
        rows = []
        for row, row_knobs in grid.rows.items():
            trials = [trial.run(grid.case, {**grid.base, **knobs, **row_knobs}) for knobs in grid.columns.values()]
            errors = [error_of(grid, one, base_of(grid)) for one in trials]
            cells = [shown(one, error) for one, error in zip(trials, errors, strict=True)]
            for cell in cells:
                counts[cell.kind] = counts.get(cell.kind, 0) + 1
            rows.append([row, *cells])
            kind = "closed form" if grid.closed else "first column of the grid"
            made.records += [
                trial.record(one, "1 + error of peak and energy", 1.0 + error, 1.0, kind)
                | {"knob": grid.title, "rung": column}
                for one, error, column in zip(trials, errors, grid.columns, strict=True)
            ]
        made.parts += [page.heading(grid.title), page.table(["", *grid.columns], rows)]
    made.verdicts.append(verdict(counts))
    return made


def base_of(grid: Grid) -> Trial:
    """The run that the others of a grid are compared with: the shipped values if they are a column, else the first."""
    label = "1" if "1" in grid.columns and "0.3" not in grid.columns else next(iter(grid.columns))
    return trial.run(grid.case, {**grid.base, **grid.columns[label], **next(iter(grid.rows.values()))})


def verdict(counts: dict[str, int]) -> page.Verdict:
    """One sentence on all cells."""
    total = sum(counts.values())
    bad, stopped = counts.get("bad", 0), counts.get("stop", 0)
    sentence = (
        f"{total} runs at and beyond the limits: {counts.get('ok', 0)} right, {counts.get('warn', 0)} to be read with "
        f"care, {stopped} stopped, refused or marked as unusable, {bad} wrong without a word or not finite."
    )
    return page.Verdict("Stability", "bad" if bad else "ok", sentence)

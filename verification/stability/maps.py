"""All maps: each cell is run and given its status, and nothing that is wrong may pass without a word."""

import math
from typing import Any

from verification import stability, timed_run
from verification.catalogue import modules_of
from verification.scene_runs import SceneRun
from verification.stability.cells import GOOD, POOR, CellOutcome, Grid, MapCell


def all_grids(full: bool) -> list[Grid]:
    """Of every module of this folder that has GRIDS; quick ones (full=False) have a few cells of each axis."""
    return [make(full) for module in modules_of(stability) for make in getattr(module, "GRIDS", ())]


def run(grid: Grid) -> list[CellOutcome]:
    """All cells of a grid, row by row."""
    return [run_cell(grid, row, column, cell) for (row, column), cell in grid.cells.items()]


def run_cell(grid: Grid, row: str, column: str, cell: MapCell) -> CellOutcome:
    """One cell; never raises for what the program itself refuses or stops."""
    one = cell.make() if cell.make else timed_run.run(cell.scene, cell.knobs)
    compared = cell.compare(one) if one.ok else {}
    error = max((exact.error for exact in compared.values()), default=math.nan)
    status, reason, kind = judged(one, error, cell.must)
    entries = [
        timed_run.record(one, quantity, exact.value, exact.reference, grid.against, exact.scale)
        for quantity, exact in compared.items()
    ] or [timed_run.record(one, "status", math.nan, math.nan, grid.against)]
    said: dict[str, Any] = {"case": cell.scene, "status": status, "reason": reason, "knob": grid.title}
    said |= {"rung": f"{row}, {column}", "knobs": {key: _plain(value) for key, value in cell.knobs.items()}}
    return CellOutcome(row, column, status, reason, error, kind, [entry | said for entry in entries])


def _plain(value: Any) -> Any:
    """A knob as it may stand in a record: NaN and infinity as words."""
    return str(value) if isinstance(value, float) and not math.isfinite(value) else value


def judged(one: SceneRun, error: float, must: tuple[str, ...] = ()) -> tuple[str, str, str]:
    """(status, reason, kind) of a run whose largest error is known; kind as in cells.KINDS."""
    status, reason, kind = one.status, one.reason, "stop"
    if status == "NOT FINITE" or (one.ok and not math.isfinite(error)):
        status, reason, kind = "NOT FINITE", reason or "there is no number to compare", "bad"
    elif one.ok:
        if one.warning:
            status, reason, kind = "WARNED", one.warning, "warn"
        elif error > POOR:
            status, reason, kind = "WRONG", f"off by {error:.2g}, and nothing says so", "bad"
        else:
            kind = "ok" if error <= GOOD else "warn"
    elif not reason:
        reason, kind = "no reason is given", "bad"
    elif status == "STOPPED" and not ("step" in reason and ("block" in reason or "contact" in reason)):
        reason, kind = f"names no step, or neither block nor contact: {reason}", "bad"
    if must and status not in must:
        reason, kind = f"should be {' or '.join(must)}; {reason or 'it is not'}", "bad"
    return status, reason, kind

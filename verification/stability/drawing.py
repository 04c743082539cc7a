"""The maps as pictures: a colour for what became of each cell, its error as a number and as a bar; sharp in print."""

import math
from typing import Any

from matplotlib.figure import Figure
from matplotlib.patches import Patch, Rectangle

from verification.stability.cells import KINDS, CellOutcome, Grid

COLOURS = {"ok": "#b7e0bd", "warn": "#ffe08a", "stop": "#c9ccd1", "bad": "#f08a80"}
MEANINGS = {
    "ok": "OK, within 1 %",
    "warn": "with care: warned, or off by up to 5 %",
    "stop": "refused or stopped, with a reason",
    "bad": "wrong without a word",
}
HATCHES = {"ok": "", "warn": "----", "stop": "////", "bad": "xxxx"}
"""So that the colours can be told apart on a black and white print."""
LEAST, MOST = 1e-16, 1.0
"""Errors at which the bar of a cell is empty and full; its length goes with the logarithm."""
WIDE, HIGH = 0.66, 0.5
"""Inches of a cell."""
TWO_KEYS = 4.8
"""Inches of a picture that has room for two of MEANINGS side by side."""


def heat_map(grid: Grid, outcomes: list[CellOutcome]) -> Figure:
    """One grid: cells in the colour of their status, with the error written and drawn."""
    rows, columns = grid.rows, grid.columns
    margin = 0.35 + 0.085 * max(map(len, rows))
    size = margin + WIDE * max(len(columns), 5), 1.65 + HIGH * len(rows)
    figure = Figure(figsize=size, layout="constrained")
    axes = figure.subplots()
    for outcome in outcomes:
        place = columns.index(outcome.column), rows.index(outcome.row)
        draw_cell(axes, place, outcome)
    axes.set(xlim=(0, len(columns)), ylim=(len(rows), 0), xlabel=grid.column_title, ylabel=grid.row_title)
    axes.set_xticks([k + 0.5 for k in range(len(columns))], columns, fontsize=8)
    axes.set_yticks([k + 0.5 for k in range(len(rows))], rows, fontsize=8)
    axes.tick_params(length=0)
    axes.spines[:].set_visible(False)
    axes.set_title(grid.title, fontsize=10, loc="left")
    seen = {outcome.kind for outcome in outcomes}
    keys: list[Any] = [
        Patch(facecolor=COLOURS[k], edgecolor="0.45", hatch=HATCHES[k], linewidth=0.4, label=MEANINGS[k])
        for k in KINDS
        if k in seen
    ]
    figure.legend(
        handles=keys, loc="outside lower left", ncols=2 if size[0] > TWO_KEYS else 1, frameon=False, fontsize=7
    )
    return figure


def draw_cell(axes: Any, place: tuple[int, int], outcome: CellOutcome) -> None:
    """The cell whose upper left corner is at `place`."""
    x, y = place
    axes.add_patch(Rectangle((x, y), 1, 1, facecolor=COLOURS[outcome.kind], edgecolor="white", linewidth=1.5, zorder=1))
    if HATCHES[outcome.kind]:
        axes.add_patch(
            Rectangle((x, y), 1, 1, fill=False, hatch=HATCHES[outcome.kind], edgecolor="0.78", linewidth=0, zorder=1.5)
        )
    word = "" if outcome.status == "OK" else outcome.status.lower()
    text = (written(outcome.error), 9 if not word else 8) if math.isfinite(outcome.error) else ("", 8)
    plain = {"ha": "center", "va": "center", "color": "0.1", "zorder": 3}
    box = {"boxstyle": "round,pad=0.1", "facecolor": COLOURS[outcome.kind], "edgecolor": "none"}
    axes.text(x + 0.5, y + (0.28 if word else 0.42), text[0], fontsize=text[1], bbox=box if text[0] else None, **plain)
    axes.text(x + 0.5, y + (0.58 if text[0] else 0.5), word, fontsize=6.5, bbox=box if word else None, **plain)
    if text[0]:
        axes.add_patch(Rectangle((x + 0.1, y + 0.84), 0.8, 0.07, facecolor="white", edgecolor="none", zorder=2))
        axes.add_patch(Rectangle((x + 0.1, y + 0.84), 0.8 * length(outcome.error), 0.07, facecolor="0.25", zorder=2.5))


def length(error: float) -> float:
    """Share of the bar that is full: 0 at LEAST, 1 at MOST, by the logarithm between."""
    fraction = math.log(max(error, LEAST) / LEAST) / math.log(MOST / LEAST)
    return min(fraction, 1.0)


def written(error: float) -> str:
    """An error in percent where a person reads it so, else as a power of ten."""
    if error == 0.0:
        return "0"
    return f"{100 * error:.2g} %" if error >= 1e-5 else f"{error:.0e}".replace("e-0", "e-")

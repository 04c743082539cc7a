"""curve.png of a drive or a load that turns back: loops with their cycles told apart, ledger, each cycle's energy."""

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from masonry.curves.curve_axes import curve_axes
from masonry.curves.error_bars import draw_bars
from masonry.curves.ledger import LEDGER, draw_ledger
from masonry.curves.measured import draw_measured
from masonry.pictures.labels import PointLabel, key_below, key_beside, place_labels
from masonry.pictures.style import MILLI, heading, plain, tidy
from masonry.rows.columns import FACTOR
from masonry.rows.cycles import bounds
from masonry.rows.peak import before_a_fall, lowest_row

if TYPE_CHECKING:
    from masonry.results.data import ResultData

PARTS = ("fracture_mode_1", "fracture_mode_2", "crushing", "friction")
RED = "#b2182b"
NAMED = 8
"""Cycles up to which each has its line in the key; of more, some have."""
ROOM = 1.25
"""Height of the axes of the bars over the tallest one: two lines of words stand on it."""


class Loops(NamedTuple):
    """Values, one of each of the rows: what turns back, what it is drawn against, and upwards; with their labels, that
    of the path to and fro, and the size of a unit of what turns back there. Rows of a fall are not among them: across
    and upwards, it begins at the last of them."""

    rows: dict[str, np.ndarray]
    turning: np.ndarray
    across: np.ndarray
    up: np.ndarray
    x: str
    y: str
    path: str
    unit: float
    fall: tuple[np.ndarray, np.ndarray] | None = None


def loops_of(result: "ResultData") -> Loops:
    """The loops of the drive; of a load that goes to and fro, those of its factor over a gauge."""
    rows, grown = result.history.rows, result.summary.collapse_load
    if grown is not None and grown.loops is not None and grown.loops.gauge in rows:
        gauge, rest = grown.loops.gauge, before_a_fall(rows, grown.falls)
        factor, x, path = rest[FACTOR], plain(f"{gauge} [mm]"), "way of the load factor, to and fro [1]"
        after = slice(len(factor) - 1, None)
        fall = None if len(factor) == len(rows[FACTOR]) else (MILLI * rows[gauge][after], rows[FACTOR][after])
        return Loops(rest, factor, MILLI * rest[gauge], factor, x, "load factor [1]", path, 1.0, fall)
    drawn = curve_axes(result)
    y, path = f"{drawn.name} at the drive [{drawn.unit}]", "way of the drive, back and forth [mm]"
    return Loops(rows, rows["displacement"], drawn.across, rows["stress"] * drawn.factor, drawn.label, y, path, MILLI)


def hysteresis_figure(result: "ResultData") -> Any:
    """A figure of 1200 x 1120 pixels: loops on top; ledger over the way to and fro, and bars, below; their
    key under both."""
    from masonry.pictures.figure import ShownFigure

    figure = ShownFigure(figsize=(7.5, 7), layout="constrained")
    loops, ledger, bars = figure.subplot_mosaic([["loops", "loops"], ["ledger", "bars"]], height_ratios=[3, 2]).values()
    heading(figure, result)
    drawn = loops_of(result)
    for axes in (loops, ledger, bars):
        tidy(axes)
    draw_measured(loops, result, curve_axes(result))
    peaks = peak_labels(result, drawn)
    _draw_loops(loops, drawn, peaks)
    if peaks:
        draw_bars(loops, result, curve_axes(result))
    key_beside(loops)
    path = drawn.unit * np.concatenate([[0.0], np.cumsum(np.abs(np.diff(drawn.turning)))])
    draw_ledger(ledger, drawn.rows, path)
    ledger.set_xlabel(drawn.path)
    ledger.set_ylabel("energy [J]")
    key_below(figure, ledger.get_legend_handles_labels()[0], fontsize=9)
    _draw_bars(bars, result.summary.cycles or [])
    place_labels(figure, loops, peaks)
    return figure


def peak_labels(result: "ResultData", drawn: Loops) -> list[PointLabel]:
    """Words on the highest force of a drive, and on the lowest where it was pushed back; of a load none: it goes as far
    as the scene says."""
    summary = result.summary
    if not result.has_drive or drawn.turning is not drawn.rows["displacement"]:
        return []
    axes, stood = curve_axes(result), result.standing_rows
    sides = [("highest", result.peak.stress, axes.place(stood, result.peak.displacement))]
    if (lowest := summary.lowest_stress_pa) is not None and lowest < 0.0:
        sides.append(("lowest", lowest, float(axes.across[lowest_row(stood)])))
    return [
        PointLabel(
            f"{word} {stress * axes.factor:.4g} {axes.unit} at {place:.4g} {axes.across_unit}",
            (place, stress * axes.factor),
            RED,
        )
        for word, stress, place in sides
    ]


def _draw_loops(axes: Any, drawn: Loops, peaks: list[PointLabel]) -> None:
    """Each cycle in a colour of its own, from light to dark; dots at the turns and the peaks; the fall, if there is
    one."""
    from matplotlib import colormaps

    ends = np.array(bounds(drawn.turning))
    count = len(ends) - 1
    shown = set(np.linspace(0, count - 1, min(count, NAMED)).round().astype(int))
    for k in range(count):
        part = slice(int(np.floor(ends[k])), int(np.ceil(ends[k + 1])) + 1)
        colour = colormaps["viridis_r"](0.15 + 0.85 * (k + 1) / count)
        label = f"cycle {k + 1}" if k in shown else None
        axes.plot(drawn.across[part], drawn.up[part], color=colour, linewidth=1.6, label=label)
    direction = np.sign(np.diff(drawn.turning))
    moving = np.flatnonzero(direction)
    reversals = moving[1:][direction[moving[1:]] != direction[moving[:-1]]]
    axes.plot(drawn.across[reversals], drawn.up[reversals], "o", color="0.4", markersize=4, label="turn")
    if peaks:
        axes.plot(*np.transpose([label.place for label in peaks]), "o", color=RED, markersize=7, label="peak")
    axes.margins(y=0.12)
    axes.set(xlim=axes.get_xlim(), ylim=axes.get_ylim())  # loops fill the picture; a fall goes out of it
    if drawn.fall is not None:
        axes.plot(*drawn.fall, "--", color="0.4", linewidth=1.2, label="fall")
    axes.axhline(0.0, color="0.6", linewidth=0.8)
    axes.axvline(0.0, color="0.6", linewidth=0.8)
    axes.set_xlabel(drawn.x)
    axes.set_ylabel(drawn.y)


def _draw_bars(axes: Any, cycles: list[dict[str, Any]]) -> None:
    """Energy dissipated in each cycle, by what took it."""
    number, base = np.arange(1, len(cycles) + 1), np.zeros(len(cycles))
    for part in PARTS:
        colour = LEDGER[part][1]
        height = np.array([cycle.get(f"{part}_j") or 0.0 for cycle in cycles])
        axes.bar(number, height, bottom=base, color=colour)
        base += height
    for k, cycle in enumerate(cycles[:NAMED]):
        words = f"{cycle.get('dissipated_j') or 0.0:.4g}" + ("" if cycle.get("closed") else "\nnot closed")
        axes.annotate(words, (number[k], base[k]), xytext=(0, 3), textcoords="offset points", ha="center", fontsize=9)
    axes.set_ylim(0.0, ROOM * float(base.max()) or 1.0)
    axes.set_xlim(0.5, len(cycles) + 0.5)
    axes.set_xlabel("cycle")
    axes.xaxis.get_major_locator().set_params(integer=True, min_n_ticks=1)
    axes.set_ylabel("dissipated in the cycle [J]")

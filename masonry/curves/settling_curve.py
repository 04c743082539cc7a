"""curve.png of a scene without a drive: how far its gauges, or its top, have moved; its reactions; the ledger."""

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from masonry.curves.curve_axes import tilt_axis
from masonry.curves.fall_mark import mark_fall
from masonry.curves.ledger import draw_ledger
from masonry.pictures.labels import key_beside
from masonry.pictures.style import MILLI, heading, plain, tidy
from masonry.results.reaction_words import reaction_lines
from masonry.rows.columns import FACTOR, TILT, gauges_of

if TYPE_CHECKING:
    from masonry.results.data import ResultData

TOP, SMALL = 1e-6, 1e-3
"""Of the specimen's height: what lies so near to the highest point is its top. Of the largest movement of the top along
an axis: smaller ones along the other axes are not drawn."""
SETTLED_TIME = "time after the settling [s]"
MOST = 5
"""Supports whose reactions are written out."""
COLOURS = ("#1f3b5c", "#e07b00", "#2f7d5b", "#8856a7")


def settling_figure(result: "ResultData") -> Any:
    """A figure of 1200 x 960 pixels, over the steps, or the time: displacements, with the reactions at the
    end above them, and the energy ledger."""
    from masonry.pictures.figure import ShownFigure

    figure = ShownFigure(figsize=(7.5, 6), layout="constrained")
    moved, ledger = figure.subplots(2, 1, sharex=True, height_ratios=[3, 2])
    heading(figure, result)
    rows = result.history.rows
    for axes in (moved, ledger):
        tidy(axes)
    over, label = across(result)
    for (name, (steps, path)), colour in zip(movements(result).items(), 9 * COLOURS, strict=False):
        moved.plot(over(steps), MILLI * path, color=colour, linewidth=2.0, label=plain(name))
    moved.set_ylabel("displacement [mm]")
    if lines := reaction_lines(result.summary.reactions):
        shown = lines if len(lines) <= MOST else [*lines[:MOST], f"and {len(lines) - MOST} more in summary.json"]
        words = ["reactions at the end, along x, y, z", *shown]
        moved.set_title("\n".join(map(plain, words)), fontsize=10, loc="left")
    mark_fall([moved, ledger], result, over)
    draw_ledger(ledger, rows, over(rows["step"]))
    ledger.set_ylabel("energy [J]")
    ledger.set_xlabel(label)
    for axes in (moved, ledger):
        key_beside(axes)
    return figure


def across(result: "ResultData") -> tuple[Callable[[np.ndarray], np.ndarray], str]:
    """Abscissa of a curve, from steps (n,) to values, and its label: the factor of a load that grows, or the tilt of
    gravity where the scene asks; else the time from the first step in a run in real time, and the step in others."""
    rows, curve = result.history.rows, result.scene_table.get("curve", {})
    if FACTOR in rows:
        return lambda steps: np.interp(steps, rows["step"], rows[FACTOR]), "load factor [1]"
    tilts = TILT in rows and isinstance(curve, dict) and curve.get("x") == TILT
    if tilts and result.summary.collapse is None:  # a fall takes no tilt, but time
        sign, label = tilt_axis(rows)
        return lambda steps: sign * np.degrees(np.interp(steps, rows["step"], rows[TILT])), label
    if result.is_shaken:
        return lambda steps: np.interp(steps, rows["step"], rows["time"]) - result.time_origin, SETTLED_TIME
    if result.in_real_time:
        return lambda steps: np.interp(steps, rows["step"], rows["time"]), "time from the first step [s]"
    return lambda steps: steps, "step"


def movements(result: "ResultData") -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """By name, steps and displacements (m): of gauges of these at every row, or of the top at every frame, by axis."""
    rows = result.history.rows
    lengths = [name for name in gauges_of(rows) if result.history.unit(name) == "m"]
    gauges = {name: (rows["step"], rows[name]) for name in lengths}
    frames = result.history.frames
    if gauges or not frames:
        return gauges
    height = result.specimen.blocks.points[:, 2]
    top = height >= height.max() - TOP * np.ptp(height)
    steps = np.array([0.0, *(frame.step for frame in frames)])
    paths = np.array([np.zeros(3), *(frame.corners[top].mean(axis=0) for frame in frames)])
    largest = np.abs(paths).max()
    shown = {f"top of the specimen, {axis}": (steps, paths[:, k]) for k, axis in enumerate("xyz")}
    return {name: (at, path) for name, (at, path) in shown.items() if np.abs(path).max() >= SMALL * largest}

"""sensitivity.png: the curves of all variants over each other, the scene as it is drawn broad below them, and by how
much each moves the peak."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from masonry.comparison.study import word_of
from masonry.comparison.variants import KINDS
from masonry.errors import SceneError
from masonry.laboratory.result import load_result
from masonry.pictures.labels import wrapped
from masonry.pictures.style import plain, tidy

COLOURS = dict(
    zip(
        KINDS,
        ("#17becf", "#1f77b4", "#d62728", "#2ca02c", "#9467bd", "#e377c2", "#8c564b", "#ff7f0e", "#bcbd22"),
        strict=True,
    )
)
"""A colour for each kind of variant; several of a kind differ by their dashes."""
DASHES = ("-", "--", ":", "-.")
LEAST = 1.0
"""Per cent of the peak that are shown at least to both sides."""


def figure_of(title: str, folder: Path, rows: Sequence[dict[str, Any]]) -> Any:
    """A figure of 1320 pixels in width: curves above, and below by how much each variant moves the peak, which also is
    their key: where an answer is robust, curves lie on each other. Raises SceneError where the numbers of a run cannot
    be read."""
    from matplotlib.figure import Figure

    from masonry.curves.curve_axes import curve_axes

    figure = Figure(figsize=(8.25, 5.0 + 0.24 * len(rows)), layout="constrained")
    axes, moved = figure.subplots(2, 1, height_ratios=[3.8, 0.6 + 0.24 * len(rows)])
    for panel in (axes, moved):
        tidy(panel)
    number: dict[str, int] = {}
    for place, row in enumerate(rows):
        style = _style(row["kind"], number)
        _draw_deviation(moved, place, row, style)
        if not (folder / "runs" / row["key"] / "history.h5").is_file():
            continue
        result = load_result(folder / "runs" / row["key"])
        curve = curve_axes(result)
        stress = result.history.rows["stress"] * curve.factor
        if len(stress) == 0:
            continue
        axes.plot(curve.across, stress, **style)
        if row["status"] != "OK":
            axes.plot(curve.across[-1], stress[-1], "x", color=style["color"], markersize=9, markeredgewidth=2)
        axes.set_xlabel(curve.label)
        axes.set_ylabel(f"{curve.name} [{curve.unit}]")
    if not axes.lines:
        raise SceneError("no run left a curve to draw")
    axes.axhline(0.0, color="0.6", linewidth=0.8, zorder=0.5)
    _name_rows(moved, rows)
    figure.suptitle(plain(title), fontsize=13, wrap=True)
    return figure


def _draw_deviation(axes: Any, place: int, row: dict[str, Any], style: dict[str, Any]) -> None:
    """A dot for the peak of a variant, over that of the scene as it is, with its line before it."""
    colour, dashes = style["color"], style.get("linestyle", "-")
    axes.plot([-0.055, -0.015], 2 * [place], dashes, color=colour, transform=axes.get_yaxis_transform(), clip_on=False)
    deviation = row.get("peak_stress_pa_deviation")
    if isinstance(deviation, int | float) and np.isfinite(deviation):
        axes.plot([0.0, 100.0 * deviation], 2 * [place], color=colour, linewidth=1.2)
        axes.plot(100.0 * deviation, place, "o", color=colour, markersize=5)


def _name_rows(axes: Any, rows: Sequence[dict[str, Any]]) -> None:
    """Names of the variants beside their dots; what moves the peak by less than LEAST looks as little as it is."""
    names = [row["variant"] if row["status"] == "OK" else f"{row['variant']} ({word_of(row)})" for row in rows]
    axes.set_yticks(range(len(rows)), [wrapped(name, 40) for name in names], fontsize=10)
    axes.tick_params(axis="y", length=0, pad=32)
    axes.set_ylim(len(rows) - 0.4, -0.6)
    low, high = axes.get_xlim()
    axes.set_xlim(min(low, -LEAST), max(high, LEAST))
    axes.axvline(0.0, color="0.6", linewidth=0.8, zorder=0.5)
    axes.set_xlabel("change of the peak [%]")


def _style(kind: str, number: dict[str, int]) -> dict[str, Any]:
    """Of the next variant of a kind."""
    if kind not in COLOURS:
        return {"color": "#222222", "linewidth": 5.0, "alpha": 0.35, "solid_capstyle": "round"}
    number[kind] = number.get(kind, -1) + 1
    return {"color": COLOURS[kind], "linestyle": DASHES[number[kind] % len(DASHES)], "linewidth": 1.5}

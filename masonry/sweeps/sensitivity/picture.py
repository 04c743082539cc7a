"""sensitivity.png: the curves of all variants over each other, the scene as it is drawn broad below them, and by how
much each moves the peak, or the factor at which a load that grows is borne no more."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from masonry.errors import SceneError
from masonry.laboratory.result import Result, load_result
from masonry.pictures.labels import wrapped
from masonry.pictures.style import plain, tidy
from masonry.rows.columns import FACTOR, gauges_of
from masonry.sweeps.sensitivity.study import word_of
from masonry.sweeps.sensitivity.variants import KINDS

COLOURS = dict(
    zip(
        KINDS,
        ("#17becf", "#1f77b4", "#d62728", "#2ca02c", "#9467bd", "#e377c2", "#8c564b", "#ff7f0e", "#bcbd22"),
        strict=True,
    )
)
"""A colour for each kind of variant; several of a kind differ by their dashes."""
DASHES = ("-", "--", ":", "-.")
ANSWERS = (("peak_stress_pa", "peak"), ("collapse_load.borne", "load factor"))
"""Figures of which the first that the scene as it is has is the answer, and their words."""
LEAST = 1.0
"""Per cent of the peak that are shown at least to both sides."""


def figure_of(title: str, folder: Path, rows: Sequence[dict[str, Any]]) -> Any:
    """A figure of 1320 pixels in width: curves above, and below by how much each variant moves the answer, which also
    is their key: where it is robust, curves lie on each other. Raises SceneError where the numbers of a run cannot
    be read."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(8.25, 5.0 + 0.24 * len(rows)), layout="constrained")
    axes, moved = figure.subplots(2, 1, height_ratios=[3.8, 0.6 + 0.24 * len(rows)])
    for panel in (axes, moved):
        tidy(panel)
    number: dict[str, int] = {}
    key, words = next((pair for pair in ANSWERS if rows[0].get(pair[0]) is not None), ANSWERS[0])
    for place, row in enumerate(rows):
        style = _style(row["kind"], number)
        _draw_deviation(moved, place, row.get(f"{key}_deviation"), style)
        if not (folder / "runs" / row["key"] / "history.h5").is_file():
            continue
        result = load_result(folder / "runs" / row["key"])
        across, up, x_label, y_label = _curve(result)
        if len(up) == 0:
            continue
        axes.plot(across, up, **style)
        if row["status"] != "OK":
            axes.plot(across[-1], up[-1], "x", color=style["color"], markersize=9, markeredgewidth=2)
        axes.set(xlabel=x_label, ylabel=y_label)
    if not axes.lines:
        raise SceneError("no run left a curve to draw")
    axes.axhline(0.0, color="0.6", linewidth=0.8, zorder=0.5)
    _name_rows(moved, rows, words)
    figure.suptitle(plain(title), fontsize=13, wrap=True)
    return figure


def _curve(result: Result) -> tuple[np.ndarray, np.ndarray, str, str]:
    """Values across and up, and their labels: of a load that grows its factor over the first gauge of a displacement,
    or over the steps; else what the scene says."""
    from masonry.curves.curve_axes import curve_axes

    rows = result.history.rows
    if rows.get(FACTOR) is None:
        curve = curve_axes(result)
        return curve.across, rows["stress"] * curve.factor, curve.label, f"{curve.name} [{curve.unit}]"
    gauge = next((name for name in gauges_of(rows) if result.history.unit(name) == "m"), None)
    across, label = (rows["step"], "step") if gauge is None else (1e3 * rows[gauge], f"{gauge} [mm]")
    return across, rows[FACTOR], plain(label), "load factor"


def _draw_deviation(axes: Any, place: int, deviation: Any, style: dict[str, Any]) -> None:
    """A dot for the answer of a variant, over that of the scene as it is, with its line before it."""
    colour, dashes = style["color"], style.get("linestyle", "-")
    axes.plot([-0.055, -0.015], 2 * [place], dashes, color=colour, transform=axes.get_yaxis_transform(), clip_on=False)
    if isinstance(deviation, int | float) and np.isfinite(deviation):
        axes.plot([0.0, 100.0 * deviation], 2 * [place], color=colour, linewidth=1.2)
        axes.plot(100.0 * deviation, place, "o", color=colour, markersize=5)


def _name_rows(axes: Any, rows: Sequence[dict[str, Any]], answer: str) -> None:
    """Names of the variants beside their dots; what moves the answer by less than LEAST looks as little as it is."""
    names = [row["variant"] if row["status"] == "OK" else f"{row['variant']} ({word_of(row)})" for row in rows]
    axes.set_yticks(range(len(rows)), [wrapped(name, 40) for name in names], fontsize=10)
    axes.tick_params(axis="y", length=0, pad=32)
    axes.set_ylim(len(rows) - 0.4, -0.6)
    low, high = axes.get_xlim()
    axes.set_xlim(min(low, -LEAST), max(high, LEAST))
    axes.axvline(0.0, color="0.6", linewidth=0.8, zorder=0.5)
    axes.set_xlabel(f"change of the {answer} [%]")


def _style(kind: str, number: dict[str, int]) -> dict[str, Any]:
    """Of the next variant of a kind."""
    if kind not in COLOURS:
        return {"color": "#222222", "linewidth": 5.0, "alpha": 0.35, "solid_capstyle": "round"}
    number[kind] = number.get(kind, -1) + 1
    return {"color": COLOURS[kind], "linestyle": DASHES[number[kind] % len(DASHES)], "linewidth": 1.5}

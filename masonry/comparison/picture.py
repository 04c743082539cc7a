"""sensitivity.png: the curves of all variants over each other, the scene as it is drawn broad below them."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from masonry.comparison.study import word_of
from masonry.comparison.variants import KINDS
from masonry.errors import SceneError
from masonry.laboratory.result import load_result
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


def figure_of(title: str, folder: Path, rows: Sequence[dict[str, Any]]) -> Any:
    """A figure of 1320 x 780 pixels at 120 dpi. Raises SceneError where the numbers of a run cannot be read."""
    from matplotlib.figure import Figure

    from masonry.curves.curve_axes import curve_axes

    figure = Figure(figsize=(11, 6.5), layout="constrained")
    axes = figure.subplots()
    tidy(axes)
    number: dict[str, int] = {}
    for row in rows:
        style = _style(row["kind"], number)
        if not (folder / "runs" / row["key"] / "history.h5").is_file():
            continue
        result = load_result(folder / "runs" / row["key"])
        curve = curve_axes(result)
        stress = result.history.rows["stress"] * curve.factor
        if len(stress) == 0:
            continue
        label = row["variant"] if row["status"] == "OK" else f"{row['variant']} ({word_of(row)})"
        axes.plot(curve.across, stress, label=plain(label), **style)
        if row["status"] != "OK":
            axes.plot(curve.across[-1], stress[-1], "x", color=style["color"], markersize=9, markeredgewidth=2)
        axes.set_xlabel(curve.label)
        axes.set_ylabel(f"{curve.name} [{curve.unit}]")
    if not axes.lines:
        raise SceneError("no run left a curve to draw")
    axes.axhline(0.0, color="0.6", linewidth=0.8, zorder=0.5)
    axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0), borderaxespad=0.0, frameon=False, fontsize=10)
    axes.set_title(plain(title), fontsize=13, wrap=True)
    return figure


def _style(kind: str, number: dict[str, int]) -> dict[str, Any]:
    """Of the next variant of a kind."""
    if kind not in COLOURS:
        return {"color": "#222222", "linewidth": 5.0, "alpha": 0.35, "solid_capstyle": "round"}
    number[kind] = number.get(kind, -1) + 1
    return {"color": COLOURS[kind], "linestyle": DASHES[number[kind] % len(DASHES)], "linewidth": 1.5}

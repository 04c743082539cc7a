"""The pictures of the report: matplotlib's object interface, no display, units on every axis."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator

from verification.case import Line, Plot
from verification.problem import Point, changes_model

COLOURS = ("#1f3b5c", "#d7301f", "#2f8f4e", "#e07b00", "#7b4fa3", "#5b5b5b", "#00a0b0", "#c2185b", "#8d6e3a")
MARKS = "osD^vPX<>"


def sheet(rows: int, columns: int, size: tuple[float, float], **options: Any) -> tuple[Figure, np.ndarray]:
    """A figure of `size` inches and its (rows, columns) axes, with a quiet grid."""
    figure = Figure(figsize=size, layout="constrained")
    axes = figure.subplots(rows, columns, squeeze=False, **options)
    for ax in axes.flat:
        ax.grid(color="0.9", linewidth=0.7)
        ax.set_axisbelow(True)
        ax.spines[["top", "right"]].set_visible(False)
    return figure, axes


def plain_ticks(axis: Any, unit: str) -> None:
    """Ticks of a logarithmic axis as plain numbers with their unit: 0.1 %, 1 %, 10 %."""
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}{unit}"))
    axis.set_minor_formatter(FuncFormatter(lambda *_: ""))


def error_against_time(
    panels: Mapping[str, Mapping[str, Sequence[tuple[float, float, str]]]],
    doubts: Sequence[float],
    floor: float,
    fronts: Mapping[str, Sequence[Point]],
) -> Figure:
    """Panel title -> knob -> (seconds, error, label of the setting): log-log, one line a knob.

    A knob whose name starts with "model" changes what is solved, and is drawn dashed. Errors below `floor` are drawn
    on it. `doubts`: by panel, what the reference itself may be off by; shaded. `fronts`: by panel title, the settings
    that no other one beats.
    """
    figure, axes = sheet(1, len(panels), (10.0 if len(panels) > 1 else 6.8, 4.4), sharey=True)
    places = ((4, 5), (-3, -11), (6, -4), (-4, 8))
    for ax, (title, knobs), doubt in zip(axes.flat, panels.items(), doubts, strict=True):
        if doubt > 0.0:
            ax.axhspan(0.0, 100.0 * doubt, color="0.92", linewidth=0)
        ax.set(xscale="log", yscale="log", title=title, xlabel="seconds of stepping [s]")
        ax.axhline(1.0, color="0.35", linewidth=0.9, linestyle=":")
        best = [(p.seconds, max(100.0 * p.error, 100.0 * floor)) for p in fronts[title]]
        ax.plot(
            *zip(*best, strict=True), color="0.8", linewidth=5.0, zorder=0, drawstyle="steps-post"
        ) if best else None
        named: list[tuple[float, float]] = []
        for k, (knob, points) in enumerate(knobs.items()):
            seconds, error, labels = zip(*points, strict=True)
            shown = [max(100.0 * abs(e), 100.0 * floor) for e in error]
            style = "--" if changes_model(knob) else "-"
            mark, colour = MARKS[k % len(MARKS)], COLOURS[k % len(COLOURS)]
            ax.plot(seconds, shown, style, marker=mark, color=colour, markersize=5, linewidth=1.4, label=knob)
            for x, y, text in zip(seconds, shown, labels, strict=True):
                if crowded(x, y, named):
                    continue
                place = places[k % len(places)]
                ax.annotate(text, (x, y), place, textcoords="offset points", fontsize=7, color=colour)
        plain_ticks(ax.yaxis, " %")
        ax.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
        plain_ticks(ax.xaxis, "")
    low, high = axes[0, 0].get_ylim()
    if high < 300.0 * low:
        axes[0, 0].yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    axes[0, 0].set_ylabel("error against the reference [%]")
    axes[0, -1].legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), frameon=False, fontsize=8)
    return figure


def crowded(x: float, y: float, named: list[tuple[float, float]]) -> bool:
    """Whether a label at this point would cover one that is there (places in decades); if not, it is there now."""
    here = math.log10(x), math.log10(y)
    if any(abs(here[0] - u) < 0.08 and abs(here[1] - v) < 0.12 for u, v in named):
        return True
    named.append(here)
    return False


def tornado(rows: Sequence[tuple[str, Sequence[Sequence[float]]]], titles: Sequence[str]) -> Figure:
    """Rows of (name, changes per panel in %), in order from the top; a bar spans all the variations of its entry."""
    figure, axes = sheet(1, len(titles), (10.0, 0.9 + 0.26 * max(len(rows), 3)), sharey=True)
    place = np.arange(len(rows))[::-1]
    for k, (ax, title) in enumerate(zip(axes.flat, titles, strict=True)):
        low = np.array([min(0.0, *row[1][k]) for row in rows])
        high = np.array([max(0.0, *row[1][k]) for row in rows])
        ax.barh(place, low, color="#4a90c2", height=0.62)
        ax.barh(place, high, color="#fc8d59", height=0.62)
        ax.axvline(0.0, color="0.2", linewidth=0.9)
        for y, ends in zip(place, zip(low, high, strict=True), strict=True):
            for end, side, at in zip(ends, (-3, 3), ("right", "left"), strict=True):
                if abs(end) >= 0.05:
                    text, offset = f"{end:+.2g}" if abs(end) < 10 else f"{end:+.0f}", (side, 0)
                    ax.annotate(
                        text, (end, y), offset, textcoords="offset points", ha=at, va="center", fontsize=7, color="0.3"
                    )
        ax.set_title(title, fontsize=10)
        ax.set_xlabel("change [%]")
        reach = max(1.0, 1.35 * float(max(-low.min(initial=0.0), high.max(initial=0.0))))
        ax.set_xlim(-reach, reach)
    axes[0, 0].set_yticks(place, [row[0] for row in rows], fontsize=8)
    axes[0, 0].set_ylim(-0.6, len(rows) - 0.4)
    return figure


def curves(panels: Mapping[str, Sequence[tuple[str, np.ndarray, np.ndarray, np.ndarray]]]) -> Figure:
    """Panel title -> (label, slip mm, stress MPa, closed form MPa): the run as a line, the closed form as dots."""
    figure, axes = sheet(1, len(panels), (10.0, 3.7), sharey=True)
    for ax, (title, lines) in zip(axes.flat, panels.items(), strict=True):
        ax.set(title=title, xlabel="slip [mm]")
        for k, (label, slip, stress, exact) in enumerate(lines):
            ax.plot(slip, stress, color=COLOURS[k], linewidth=1.6, label=label)
            sparse = np.unique(np.searchsorted(slip, np.linspace(0.0, slip[-1], 30)).clip(max=len(slip) - 1))
            ax.plot(slip[sparse], exact[sparse], "o", color=COLOURS[k], markersize=3.5, markerfacecolor="white")
    axes[0, 0].set_ylabel("shear stress [MPa]")
    axes[0, -1].legend(title="confinement", frameon=False, fontsize=8)
    return figure


MOST_POINTS = 600
"""Of a line of a case: more would only make the page heavy."""


def plots(pair: Sequence[Plot]) -> Figure:
    """One or two pictures of a case side by side: references dashed on top, measured points as marks."""
    figure, axes = sheet(1, len(pair), (10.0 if len(pair) > 1 else 6.4, 3.7))
    for ax, plot in zip(axes.flat, pair, strict=True):
        ax.set(title=plot.title, xlabel=plot.x_label, ylabel=plot.y_label)
        ax.title.set_fontsize(10)
        if plot.log:
            ax.set(xscale="log", yscale="log")
        for k, line in enumerate(plot.lines):
            _draw(ax, line, COLOURS[k % len(COLOURS)], MARKS[k % len(MARKS)])
        if any(line.label for line in plot.lines):
            ax.legend(frameon=False, fontsize=8)
    return figure


def _draw(ax: Axes, line: Line, colour: str, mark: str) -> None:
    x, y = np.asarray(line.x), np.asarray(line.y)
    thin = slice(None, None, max(1, -(-len(x) // MOST_POINTS))) if line.style != "points" else slice(None)
    x, y = np.append(x[thin], x[-1:]), np.append(y[thin], y[-1:])
    if line.style == "points":
        ax.plot(x, y, mark, color=colour, markersize=4, markerfacecolor="white", label=line.label, zorder=3)
    elif line.style == "dashed":
        ax.plot(x, y, "--", color="0.15", linewidth=1.1, dashes=(4, 3), label=line.label, zorder=4)
    else:
        ax.plot(x, y, color=colour, linewidth=1.8, label=line.label)

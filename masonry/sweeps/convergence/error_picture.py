"""convergence.png: error of a number against seconds of processor, a line for each resolution of the scene.

Where settings were chosen, errors are those from the value without end of these, and the number is that which was worst
of all within reach.
"""

from collections.abc import Sequence
from typing import Any

from masonry.pictures.labels import key_beside, wrapped
from masonry.pictures.style import plain, tidy
from masonry.sweeps.convergence.refinement.answers import value_of
from masonry.sweeps.convergence.refinement.campaign import BASE, DRAWN, RIGID, SCATTER, TOGETHER
from masonry.sweeps.convergence.refinement.numerical_errors import Ended, NumericalError
from masonry.sweeps.convergence.search.chosen_settings import FILE, ChosenSettings
from masonry.sweeps.run_store import Row

COLOURS = ("#1f77b4", "#d62728", "#2ca02c", "#9467bd", "#e377c2", "#8c564b", "#17becf", "#bcbd22")
WIDE = 10.0
"""Ratio of the longest to the shortest run, beyond which the axis of time is logarithmic."""


def figure_of(title: str, errors: Sequence[NumericalError], runs: Ended, chosen: ChosenSettings | None = None) -> Any:
    """A figure of 1320 pixels in width."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(8.25, 5.2), layout="constrained")
    axes = figure.subplots()
    tidy(axes)
    error = errors[0] if chosen is None else _decisive(errors, chosen)
    points = [
        (trial, point)
        for trial, row in runs
        if trial.name not in (DRAWN, RIGID) and (point := _point(row, error)) is not None
    ]
    base = points[0][1]
    names = dict.fromkeys(trial.name for trial, _ in points if trial.name not in (BASE, SCATTER))
    for name, colour in zip(names, COLOURS * len(names), strict=False):
        line = sorted([(1.0, *base), *((trial.factor, *point) for trial, point in points if trial.name == name)])
        style: dict[str, Any] = {"color": "#222222", "ls": "--"} if name == TOGETHER else {"color": colour, "ls": "-"}
        axes.plot([x for _, x, _ in line], [y for _, _, y in line], marker="o", label=name, markersize=5, **style)
    again = [point for trial, point in points if trial.name == SCATTER]
    if again:
        axes.plot(*zip(*again, strict=True), "x", color="0.5", label=SCATTER)
    shown = [point for _, point in points] + (_draw_chosen(axes, error, chosen) if chosen is not None else [])
    axes.plot(*base, "s", color="#222222", markersize=9, label="scene as it is", zorder=4)
    width = 100.0 * error.half_width / (abs(error.value) or 1.0)
    axes.axhspan(0.0, width, facecolor="0.9", edgecolor="0.6", zorder=0, label="95 % bar")
    _scale(axes, width, shown)
    axes.set(xlabel="processor [s]", ylabel=f"error of the {plain(error.answer.words)} [%]")
    key_beside(axes)
    figure.suptitle(plain(wrapped(title, 70)), fontsize=13)
    return figure


def _scale(axes: Any, width: float, shown: Sequence[tuple[float, float]]) -> None:
    """Axes that hold all points, and are logarithmic where values lie far apart: times, or errors and the bar (%)."""
    from matplotlib.ticker import FuncFormatter

    seconds = [x for x, _ in shown]
    if max(seconds) > WIDE * min(seconds):
        axes.set_xscale("log")
        axes.xaxis.set_major_formatter(FuncFormatter(_as_number))
    else:
        axes.set_xlim(0.0, 1.1 * max(seconds))
    highest, room = max(width, *(y for _, y in shown)), 1.1
    if highest > WIDE * width:
        axes.set_yscale("symlog", linthresh=max(width, 1e-6))
        axes.yaxis.set_major_formatter(FuncFormatter(_as_number))
        room = 1.5
    axes.set_ylim(0.0, room * highest or None)


def _decisive(errors: Sequence[NumericalError], chosen: ChosenSettings) -> NumericalError:
    """With the chosen settings, the number within reach that has the largest error in the scene as it is."""
    best = {error.answer.key: error for error in chosen.best.errors}
    ranked = sorted(
        (e for e in errors if e.value), key=lambda e: (e.answer.key in chosen.unreached, -e.at_most / abs(e.value))
    )
    return next((best[error.answer.key] for error in ranked if error.answer.key in best), chosen.best.errors[0])


def _point(row: Row, error: NumericalError) -> tuple[float, float] | None:
    """Seconds of a run, and its error in per cent; None where it has not this number."""
    value = value_of(row, error.answer)
    if value is None:
        return None
    size = abs(error.value) or 1.0
    return row["seconds_processor_run"], 100.0 * abs(value.number + value.interval - error.limit) / size


def _draw_chosen(axes: Any, error: NumericalError, chosen: ChosenSettings) -> list[tuple[float, float]]:
    """Settings that were tried, one after the other, the chosen ones and the error asked for; returns their points."""
    tried = [point for settings in chosen.tried if (point := _point(settings.runs[0][1], error)) is not None]
    if len(tried) > 1:
        axes.plot(
            *zip(*tried, strict=True), ":", color="#222222", marker=".", lw=1.8, label="tried one after the other"
        )
    best = _point(chosen.best.runs[0][1], error)
    if best is not None:
        label = f"cheapest good: {FILE}" if chosen.error <= chosen.to else f"best: {FILE}"
        axes.plot(*best, "*", color="#ff7f0e", markeredgecolor="#222222", markersize=20, label=label, zorder=3)
    axes.axhline(100.0 * chosen.to, color="#ff7f0e", lw=1.0, label=f"{100.0 * chosen.to:g} % asked for")
    return [*tried, (tried[0][0], 100.0 * chosen.to)]


def _as_number(value: float, _: int) -> str:
    """A tick in full, not as a power."""
    return f"{value:g}"

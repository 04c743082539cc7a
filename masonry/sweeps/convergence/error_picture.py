"""convergence.png: error of a number against seconds of processor, a line for each resolution of the scene."""

from typing import Any

from masonry.pictures.labels import key_beside, wrapped
from masonry.pictures.style import plain, tidy
from masonry.sweeps.convergence.answers import value_of
from masonry.sweeps.convergence.campaign import BASE, SCATTER, TOGETHER
from masonry.sweeps.convergence.numerical_errors import Ended, NumericalError

COLOURS = ("#1f77b4", "#d62728", "#2ca02c", "#9467bd", "#e377c2", "#8c564b", "#17becf", "#bcbd22")
WIDE = 10.0
"""Ratio of the longest to the shortest run, or of the largest error to the bar, beyond which an axis is logarithmic."""


def figure_of(title: str, error: NumericalError, runs: Ended) -> Any:
    """A figure of 1320 pixels in width."""
    from matplotlib.figure import Figure
    from matplotlib.ticker import FuncFormatter

    figure = Figure(figsize=(8.25, 5.2), layout="constrained")
    axes = figure.subplots()
    tidy(axes)
    size = abs(error.value) or 1.0
    points = [
        (trial, row["seconds_processor_run"], 100.0 * abs(value.number + value.interval - error.limit) / size)
        for trial, row in runs
        if (value := value_of(row, error.answer)) is not None
    ]
    base = points[0]
    names = dict.fromkeys(trial.name for trial, _, _ in points if trial.name not in (BASE, SCATTER))
    for name, colour in zip(names, COLOURS * len(names), strict=False):
        line = sorted([(1.0, *base[1:]), *((t.factor, x, y) for t, x, y in points if t.name == name)])
        style: dict[str, Any] = {"color": "#222222", "ls": "--"} if name == TOGETHER else {"color": colour, "ls": "-"}
        axes.plot([x for _, x, _ in line], [y for _, _, y in line], marker="o", label=name, markersize=5, **style)
    again = [(x, y) for trial, x, y in points if trial.name == SCATTER]
    if again:
        axes.plot(*zip(*again, strict=True), "x", color="0.5", label=SCATTER)
    axes.plot(base[1], base[2], "s", color="#222222", markersize=9, label="scene as it is", zorder=3)
    width = 100.0 * error.half_width / size
    axes.axhspan(0.0, width, color="0.9", zorder=0, label="95 % bar")
    seconds = [x for _, x, _ in points]
    if max(seconds) > WIDE * min(seconds):
        axes.set_xscale("log")
        axes.xaxis.set_major_formatter(FuncFormatter(_as_number))
    else:
        axes.set_xlim(0.0, 1.1 * max(seconds))
    highest = max(width, *(y for _, _, y in points))
    if highest > WIDE * width:
        axes.set_yscale("symlog", linthresh=max(width, 1e-6))
        axes.yaxis.set_major_formatter(FuncFormatter(_as_number))
    axes.set_ylim(0.0, 1.1 * highest or None)
    axes.set(xlabel="processor [s]", ylabel=f"error of the {plain(error.answer.words)} [%]")
    key_beside(axes)
    figure.suptitle(plain(wrapped(title, 70)), fontsize=13)
    return figure


def _as_number(value: float, _: int) -> str:
    """A tick in full, not as a power."""
    return f"{value:g}"

"""curve.png of a load that grew, where a gauge was led on behind the collapse: the factor over it; the ledger."""

from typing import TYPE_CHECKING, Any

import numpy as np

from masonry.curves.ledger import draw_ledger
from masonry.pictures.style import MILLI, heading, plain, tidy
from masonry.rows.columns import FACTOR

if TYPE_CHECKING:
    from masonry.results.data import ResultData


def branch_figure(result: "ResultData") -> Any:
    """A figure of 1200 x 960 pixels at 120 dpi, over the gauge: the load factor, at rests and behind the collapse, with
    the collapse factor and the end; the energy ledger below it."""
    from masonry.pictures.figure import ShownFigure

    figure = ShownFigure(figsize=(10, 8), layout="constrained")
    curve, ledger = figure.subplots(2, 1, sharex=True, height_ratios=[3, 2])
    heading(figure, result)
    grown, rows = result.summary.collapse_load, result.history.rows
    assert grown is not None and grown.branch is not None, "a gauge was led"
    led, reading, factor = grown.branch, MILLI * rows[grown.branch.gauge], rows[FACTOR]
    rest = int(np.flatnonzero(rows["step"] <= rows["step"][-1] - led.steps)[-1])  # the last one
    late = reading[rest] > reading.min() + 0.5 * np.ptp(reading)
    for axes in (curve, ledger):
        tidy(axes)
    curve.plot(
        reading[: rest + 1], factor[: rest + 1], "o-", color="#e07b00", markersize=3, linewidth=1.2, label="at rest"
    )
    curve.plot(reading[rest:], factor[rest:], color="#1f3b5c", linewidth=2.0, label="behind the collapse")
    curve.plot(reading[rest], grown.borne, "o", color="#b2182b", markersize=7, label="collapse")
    curve.annotate(
        f"{grown.borne:.4g} is borne, {grown.falls or 0.0:.4g} is not",
        (reading[rest], grown.borne),
        xytext=(-12 if late else 12, 6),
        ha="right" if late else "left",
        textcoords="offset points",
        color="#b2182b",
        fontsize=11,
    )
    curve.margins(y=0.12)
    curve.axhline(0.0, color="0.6", linewidth=0.8)
    curve.set_ylabel("load factor [1]")
    draw_ledger(ledger, rows, reading)
    ledger.set_ylabel("energy [J]")
    ledger.set_xlabel(plain(f"{led.gauge} [mm]"))
    for axes in (curve, ledger):
        axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0), borderaxespad=0.0, frameon=False, fontsize=10)
    return figure

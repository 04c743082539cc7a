"""Bars of numbers that were refined without end, in the picture of a curve: where they are known, and nowhere else."""

from typing import TYPE_CHECKING, Any

import numpy as np

from masonry.curves.curve_axes import CurveAxes
from masonry.pictures.style import MILLI
from masonry.results.records.convergence_record import RefinedNumber

if TYPE_CHECKING:
    from masonry.results.data import ResultData

COLOUR = "#6a3d9a"
LABEL = "95 % bar"
ROOM = 0.5
"""Part of the height of the picture by which bars may make it higher; a longer one goes out of it."""
KNOWN = 0.25
"""Part of the way within which the place of a peak is to be known, so that it is drawn."""
STYLE: dict[str, Any] = {
    "fmt": "D",
    "color": COLOUR,
    "markersize": 5,
    "markerfacecolor": "white",
    "elinewidth": 1.4,
    "capsize": 4,
    "zorder": 2.5,
}


def draw_bars(axes: Any, result: "ResultData", drawn: CurveAxes) -> None:
    """Peak and end of a drive without end, each with its bar up; that of the peak across as well, where its place is a
    displacement of the drive, and known. Nothing where the run was not refined."""
    refined = result.summary.numerical_error
    if refined is None:
        return
    limits = axes.get_ylim()
    peak, end = refined.of("peak_stress_pa"), refined.of("final_stress_pa")
    at = drawn.place(result.standing_rows, result.peak.displacement)
    place = _place_of_peak(result, refined.of("displacement_at_peak_m"), drawn)
    bars = [(peak, at if place is None else MILLI * place.limit, place), (end, float(drawn.across[-1]), None)]
    label = LABEL
    for number, across, sideways in bars:
        if number is not None:
            width = None if sideways is None else MILLI * sideways.half_width
            up = drawn.factor * number.limit
            axes.errorbar(across, up, drawn.factor * number.half_width, width, label=label, **STYLE)
            label = ""
    low, high = axes.get_ylim()
    room = ROOM * (limits[1] - limits[0])
    axes.set_ylim(max(min(low, limits[0]), limits[0] - room), min(max(high, limits[1]), limits[1] + room))


def bar_words(result: "ResultData", factor: float, unit: str) -> str:
    """A line on the peak without end, below others; nothing where the run was not refined."""
    refined = result.summary.numerical_error
    peak = None if refined is None else refined.of("peak_stress_pa")
    return "" if peak is None else f"\nwithout end {peak.interval(factor, unit)}"


def _place_of_peak(result: "ResultData", number: RefinedNumber | None, drawn: CurveAxes) -> RefinedNumber | None:
    """The displacement at the peak; None on a plateau, of which any place may be the highest, or on other axes."""
    way = MILLI * result.history.rows["displacement"]
    if number is None or not np.array_equal(drawn.across, way):
        return None
    farthest = abs(number.limit - result.peak.displacement) + number.half_width
    return number if MILLI * farthest < KNOWN * float(np.ptp(way)) else None


def draw_band(axes: Any, number: RefinedNumber | None) -> None:
    """A band over the whole width, of a number that is read on the axis upwards; nothing where it has no bar."""
    if number is None:
        return
    low, high = number.limit - number.half_width, number.limit + number.half_width
    axes.axhspan(low, high, color=COLOUR, alpha=0.15, linewidth=0.0, zorder=0, label=LABEL)
    axes.axhline(number.limit, color=COLOUR, linewidth=1.0, linestyle=":", zorder=0.5)

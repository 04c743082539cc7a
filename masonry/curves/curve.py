"""curve.png: stress (or force) against displacement (or a gauge), and the energy ledger below it."""

from typing import TYPE_CHECKING, Any

import numpy as np

from masonry.curves.collapse_curve import collapse_figure, is_collapse_curve
from masonry.curves.curve_axes import CurveAxes, curve_axes, without_blows
from masonry.curves.error_bars import bar_words, draw_bars
from masonry.curves.fall_mark import mark_fall
from masonry.curves.ledger import draw_ledger
from masonry.curves.measured import draw_measured
from masonry.curves.time_curve import asks_for_time, is_over_time, time_figure
from masonry.judgement.doubts.peak_passed import still_rises
from masonry.pictures.labels import PointLabel, key_beside, place_labels
from masonry.pictures.style import heading, tidy
from masonry.results.frame_choice import without_noise
from masonry.rows.peak import peak_row

if TYPE_CHECKING:
    from masonry.results.data import ResultData


def curve_figure(result: "ResultData") -> Any:
    """A figure of 1200 x 960 pixels: stress at drive and support over the ledger; loops and cycles
    of a drive that turns back; movements and reactions where there is none; gauges over the time; the load factor
    where a gauge was led."""
    if len(result.history.rows.get("step", ())) and is_over_time(result):
        return time_figure(result)
    if result.summary.cycles and not asks_for_time(result):
        from masonry.curves.hysteresis import hysteresis_figure

        return hysteresis_figure(result)
    if len(result.history.rows.get("step", ())) and is_collapse_curve(result):
        return collapse_figure(result)
    if not result.has_drive and len(result.history.rows.get("step", ())):
        from masonry.curves.settling_curve import settling_figure

        return settling_figure(result)
    from masonry.pictures.figure import ShownFigure

    figure = ShownFigure(figsize=(7.5, 6), layout="constrained")
    curve, ledger = figure.subplots(2, 1, sharex=True, height_ratios=[3, 2])
    heading(figure, result)
    ledger.set_ylabel("energy [J]")
    for axes in (curve, ledger):
        tidy(axes)
    rows = result.history.rows
    if not len(rows.get("displacement", ())):
        curve.text(0.5, 0.5, "no rows were recorded", transform=curve.transAxes, ha="center")
        return figure
    drawn = curve_axes(result)
    curve.set_ylabel(f"{drawn.name} [{drawn.unit}]")
    ledger.set_xlabel(drawn.label)
    _draw_curve(curve, result, drawn)
    blow = result.summary.collapse and result.summary.collapse.blow_pa
    later = f"\nlater blows to {blow * drawn.factor:.4g} {drawn.unit}" if blow else ""
    mark_fall([curve, ledger], result, lambda steps: np.interp(steps, rows["step"], drawn.across), later, begins=False)
    draw_ledger(ledger, rows, drawn.across)
    for axes in (curve, ledger):
        key_beside(axes)
    place_labels(figure, curve, _labels(result, drawn))
    return figure


def _draw_curve(axes: Any, result: "ResultData", drawn: CurveAxes) -> None:
    """The curve with its peak and its end; what falls and hits the drive goes out of the picture."""
    rows, stood = result.history.rows, result.standing_rows
    displacement = drawn.across
    peak_at, peak = drawn.place(stood, result.peak.displacement), result.peak.stress * drawn.factor
    stress, support = rows["stress"] * drawn.factor, rows["support_stress"] * drawn.factor
    axes.plot(displacement, stress, color="#1f3b5c", linewidth=2.0, label="at the drive")
    draw_measured(axes, result, drawn)
    axes.plot(displacement, support, "--", color="#e07b00", linewidth=1.0, label="at the support")
    if not rows["displacement"].any():
        return
    word = "highest" if still_rises(result.summary) else "peak"
    axes.plot(peak_at, peak, "o", color="#b2182b", markersize=7, label=word)
    axes.margins(y=0.12)
    limits = without_blows(result, stress, support, np.full_like(stress, peak))
    if limits is not None:
        axes.set_ylim(*limits)
    draw_bars(axes, result, drawn)


def _labels(result: "ResultData", drawn: CurveAxes) -> list[PointLabel]:
    """Words on the peak, and on the end where that comes later."""
    stood, unit = result.standing_rows, drawn.unit
    stress = result.history.rows["stress"] * drawn.factor
    if not result.history.rows["displacement"].any():
        return []
    word = "highest" if still_rises(result.summary) else "peak"
    peak_at, peak = drawn.place(stood, result.peak.displacement), result.peak.stress * drawn.factor
    place = f"{without_noise(peak_at, drawn.across):.4g} {drawn.across_unit}"
    said = f"{word} {peak:.4g} {unit} at {place}{bar_words(result, drawn.factor, unit)}"
    labels = [PointLabel(said, (peak_at, peak), "#b2182b")]
    if peak_row(stood) < len(stress) - 1:
        words = f"at the end {without_noise(float(stress[-1]), stress):.3g} {unit}"
        labels.append(PointLabel(words, (float(drawn.across[-1]), float(stress[-1]))))
    return labels

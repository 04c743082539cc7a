"""fragility.csv, fragility.json and fragility.png (or .pdf, .svg) of a sweep."""

import json
import math
from pathlib import Path
from typing import Any

import numpy as np

from masonry.pictures.style import plain, write_picture
from masonry.runtime.folders.own_files import ResultFiles
from masonry.runtime.named_file import remove_pictures
from masonry.sweeps.fragility.fragility import QUANTILES, Fragility
from masonry.sweeps.fragility.request import FragilityRequest
from masonry.sweeps.sweep_table import csv_text

TABLE, NUMBERS, PICTURE = "fragility.csv", "fragility.json", "fragility"
BLUE, RED, GREY = "#1f3b5c", "#b2182b", "0.6"


def write_fragility(folder: Path, title: str, fragility: Fragility, form: str) -> tuple[str, ...]:
    """Write all three, all or none; their names. Raises OSError."""
    remove_pictures(folder, PICTURE)
    with ResultFiles(folder) as files:
        files.text(TABLE, csv_text(columns_of(fragility)))
        files.text(NUMBERS, json.dumps(numbers_of(fragility), indent=2, allow_nan=False) + "\n")
        write_picture(fragility_figure(title, fragility), files.new(f"{PICTURE}.{form}"))
    return TABLE, NUMBERS, f"{PICTURE}.{form}"


def columns_of(fragility: Fragility) -> dict[str, list[Any]]:
    """Columns by name, a row a level; nothing where there is no fit, or the measure of a run that fell."""
    levels, request = fragility.levels, fragility.request
    unit = f" [{fragility.unit}]" if fragility.unit else ""
    columns: dict[str, list[Any]] = {
        f"{request.intensity}{unit}": [level.intensity for level in levels],
        "runs": [level.runs for level in levels],
        "fallen": [level.fallen for level in levels],
        "share": [level.share for level in levels],
        "share_low": [level.low for level in levels],
        "share_high": [level.high for level in levels],
    }
    if fragility.fit is not None:
        at = np.array([level.intensity for level in levels])
        low, high = fragility.fit.band(at, request.confidence)
        curves = {"fitted": fragility.fit.share(at), "fitted_low": low, "fitted_high": high}
        columns |= {name: values.tolist() for name, values in curves.items()}
    if request.measure is not None:
        for number, quantile in enumerate(QUANTILES):
            values = [(level.quantiles or ())[number] for level in levels]
            columns[f"{request.measure} {quantile:.0%}"] = [_finite(value) for value in values]
    return columns


def numbers_of(fragility: Fragility) -> dict[str, Any]:
    """The fit and how it was made."""
    fit, request = fragility.fit, fragility.request
    numbers: dict[str, Any] = {
        "intensity": request.intensity,
        "unit": fragility.unit,
        "measure": request.measure,
        "limit": request.limit,
        "confidence": request.confidence,
        "runs": len(fragility.fallen),
        "fallen": int(fragility.fallen.sum()),
        "left_out": fragility.left_out,
        "why_no_fit": fragility.why_no_fit,
        "fit": None,
    }
    if fit is not None:
        low, high = fit.median_band(request.confidence)
        numbers["fit"] = {
            "median": fit.median,
            "median_low": low,
            "median_high": high,
            "dispersion": fit.dispersion,
            "covariance_of_log_median_and_dispersion": fit.covariance.tolist(),
            "log_likelihood": fit.log_likelihood,
        }
    return numbers


def fragility_figure(title: str, fragility: Fragility) -> Any:
    """A matplotlib figure: the share that falls; with a measure, the measure against the intensity, and its
    distribution at each level."""
    from matplotlib.figure import Figure

    panels = 1 if fragility.measure is None else 3
    figure = Figure(figsize=(6.75 if panels == 1 else 13, 4.6), layout="constrained")
    axes = np.atleast_1d(figure.subplots(1, panels))
    figure.suptitle(plain(f"{title}: {fragility.sentence.removeprefix('fragility: ')}"), fontsize=12, wrap=True)
    _draw_shares(axes[0], fragility)
    if fragility.measure is not None:
        _draw_measures(axes[1], fragility, fragility.measure)
        _draw_distributions(axes[2], fragility, fragility.measure)
    for one in axes:
        one.grid(color="0.9", linewidth=0.8)
        one.spines[["top", "right"]].set_visible(False)
        one.locator_params(axis="x", nbins=5)
    return figure


def _measure_label(request: FragilityRequest) -> str:
    """The name of a measure with its unit in brackets, where it ends in one."""
    name, _, unit = str(request.measure).rpartition("_")
    words = {"m": "m", "rad": "rad", "pa": "Pa", "n": "N", "j": "J", "s": "s"}
    return plain(f"{name.replace('_', ' ')} [{words[unit]}]" if unit in words else str(request.measure))


def _label(fragility: Fragility) -> str:
    return plain(f"{fragility.request.intensity} [{fragility.unit}]" if fragility.unit else fragility.request.intensity)


def _draw_shares(axes: Any, fragility: Fragility) -> None:
    levels, confidence = fragility.levels, fragility.request.confidence
    at, shares = [level.intensity for level in levels], np.array([level.share for level in levels])
    errors = [shares - [level.low for level in levels], np.array([level.high for level in levels]) - shares]
    axes.errorbar(at, shares, errors, fmt="o", color=BLUE, capsize=3, label=f"share, {confidence:.0%}")
    if fragility.fit is not None:
        fine = np.linspace(1e-3 * max(at), 1.1 * max(at), 300)
        low, high = fragility.fit.band(fine, confidence)
        axes.plot(fine, fragility.fit.share(fine), color=RED, label="lognormal, most likely")
        axes.fill_between(fine, low, high, color=RED, alpha=0.15, linewidth=0)
    axes.set(xlabel=_label(fragility), ylabel="share that falls", ylim=(-0.03, 1.03))
    axes.set_xlim(left=0.0)
    axes.legend(frameon=False, fontsize=9)


def _draw_measures(axes: Any, fragility: Fragility, measure: np.ndarray) -> None:
    """Incremental dynamic analysis: a line a record, which ends in an arrow where something falls."""
    top = 1.15 * max(_largest(measure), fragility.request.limit or 0.0)
    for record in np.unique(fragility.record):
        runs = np.flatnonzero(fragility.record == record)
        runs = runs[np.argsort(fragility.intensity[runs])]
        axes.plot(np.minimum(measure[runs], top), fragility.intensity[runs], "-o", color=GREY, linewidth=0.8, ms=3)
    down = np.isinf(measure)
    axes.plot(np.full(down.sum(), top), fragility.intensity[down], ">", color=RED, label="a block fell")
    if fragility.request.limit is not None:
        axes.axvline(fragility.request.limit, color=RED, linestyle="--", label="limit")
    if down.any() or fragility.request.limit is not None:
        axes.legend(frameon=False, fontsize=9)
    axes.set(xlabel=_measure_label(fragility.request), ylabel=_label(fragility))


def _draw_distributions(axes: Any, fragility: Fragility, measure: np.ndarray) -> None:
    """The share of the runs of a level whose measure is no more; a level that ends below 1 has runs that fell."""
    import matplotlib

    nearest_level = np.abs(fragility.intensity[:, None] - [level.intensity for level in fragility.levels]).argmin(
        axis=1
    )
    colours = matplotlib.colormaps["viridis"](np.linspace(0.0, 0.9, len(fragility.levels)))
    top = 1.15 * _largest(measure)
    for number, (level, colour) in enumerate(zip(fragility.levels, colours, strict=True)):
        values = np.sort(measure[nearest_level == number])
        finite = values[np.isfinite(values)]
        shares = np.arange(len(finite) + 1) / max(1, len(values))
        label = f"{level.intensity:.3g}"
        axes.step([0.0, *finite, top], [*shares, shares[-1]], where="post", color=colour, label=label)
    axes.set(xlabel=_measure_label(fragility.request), ylabel="share of runs", ylim=(-0.03, 1.03))
    axes.legend(title=_label(fragility), loc="upper left", bbox_to_anchor=(1.01, 1.0), frameon=False, fontsize=9)


def _largest(measure: np.ndarray) -> float:
    return float(measure[np.isfinite(measure)].max(initial=0.0)) or 1.0


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None

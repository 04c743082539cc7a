"""Pictures and a table of what sizes and seeds do: mean curves, peaks and places of cracks as dots."""

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from masonry.laboratory.result import Result
from masonry.pictures.style import MEGA, MILLI
from verification.html import page
from verification.html.figures import COLOURS, sheet
from verification.paper.pictures import Line
from verification.paper.sizes.families import SECTIONS, Results, displacements, mean_curve, peaks
from verification.paper.sizes.spread import spread_of
from verification.paper.walls.crack_path import crack_path


def mean_curves(by_division: Results) -> list[Line]:
    """The mean curve of each size."""
    u = displacements(by_division)
    return [
        Line(f"{size} cells", u * MILLI, mean_curve(results, u) * MEGA, "-", COLOURS[k])
        for k, (size, results) in enumerate(by_division.items())
    ]


def peaks_figure(families: Mapping[str, Results]) -> Figure:
    """Peaks over the mean of their family, all on one scale, and where cracks are; a dot is a seed, a bar a size."""
    figure, axes = sheet(1, len(families) + 1, (12.0, 3.6))
    over_mean = {name: _over_mean(peaks(family)) for name, family in families.items()}
    reach = 1.1 * max(abs(v - 100.0) for groups in over_mean.values() for values in groups.values() for v in values)
    for ax, (name, family) in zip(axes.flat, families.items(), strict=False):
        _dots(ax, over_mean[name])
        mean = float(np.mean([v for values in peaks(family).values() for v in values]))
        ax.set_title(name.replace(", ", ",\n") + f"\nmean {mean:.4f} MPa", fontsize=9)
        ax.set_ylim(100.0 - reach, 100.0 + reach)
    axes[0, 0].set_ylabel("peak over mean peak [%]")
    last = axes.flat[-1]
    second = list(families.values())[1]
    _dots(last, {str(size): [_place(r) for r in results] for size, results in second.items()}, bars=False)
    for section in SECTIONS:
        last.axhline(section * MILLI, color="0.5", linewidth=0.9, linestyle=":")
    last.set_title("failure mode 2,\nmiddle of the crack [mm]", fontsize=9)
    last.set_ylim(0.0, 500.0)
    return figure


def _over_mean(groups: Mapping[str, list[float]]) -> dict[str, list[float]]:
    mean = float(np.mean([v for values in groups.values() for v in values]))
    return {name: [100.0 * v / mean for v in values] for name, values in groups.items()}


def _place(result: Result) -> float:
    try:
        return crack_path(result).place()[0] * MILLI
    except ValueError:
        return np.nan


def _dots(axes: Axes, groups: Mapping[str, list[float]], bars: bool = True) -> None:
    """The values of each group beside each other, and their mean."""
    for k, values in enumerate(groups.values()):
        shift = np.linspace(-0.15, 0.15, len(values)) if len(values) > 1 else [0.0]
        axes.plot(k + np.asarray(shift), values, "o", color=COLOURS[k], markersize=5, markerfacecolor="white")
        if bars:
            axes.plot([k - 0.3, k + 0.3], [np.mean(values)] * 2, color=COLOURS[k], linewidth=2.0)
    axes.set_xticks(range(len(groups)), list(groups))
    axes.set_xlabel("cells")


def spread_table(families: Mapping[str, Results]) -> list[str]:
    """The peaks of each family taken apart into size and seed."""
    rows = []
    for name, family in families.items():
        spread = spread_of(peaks(family))
        rows.append(
            [
                name,
                *(f"{mean:.4f}" for mean in spread.means.values()),
                page.percent(spread.reach),
                page.percent(spread.within / spread.mean),
                page.percent(spread.between / spread.mean),
                f"{spread.chance:.2g}",
            ]
        )
    header = ["peak [MPa], mean of the seeds", "218", "335", "540", "sizes apart", "by seed", "by size", "p"]
    note = (
        "By seed: standard deviation of a peak round the mean of its size. By size: what the means differ by beyond "
        "what "
        "that leaves to chance. p: how often chance alone would put the means this far apart."
    )
    return [page.table(header, rows, "Peaks by size and by seed"), page.paragraph(note, "note")]

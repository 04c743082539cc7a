"""Pictures of many walls: bands of curves, how peaks are distributed, and how often each joint cracks."""

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure

from masonry.pictures.style import MEGA, MILLI
from verification.html.figures import COLOURS, sheet
from verification.paper.ensembles.realisations import Ensemble


def bands(modes: Mapping[str, tuple[Ensemble, Mapping[str, Ensemble]]]) -> Figure:
    """Mode -> (the wall without scatter, kind -> walls with it): curves above, distributions of the peak below."""
    figure, axes = sheet(2, len(modes), (10.0, 7.2))
    for (above, below), (mode, (alone, kinds)) in zip(axes.T, modes.items(), strict=True):
        above.set(title=mode, xlabel="displacement [mm]", ylabel="stress [MPa]")
        below.set(xlabel="peak stress [MPa]", ylabel="share of walls with a lower peak [1]")
        for colour, (kind, walls) in zip(COLOURS, kinds.items(), strict=False):
            low, high, middle = (stress * MEGA for stress in walls.band())
            above.fill_between(walls.drive * MILLI, low, high, color=colour, alpha=0.18, linewidth=0)
            above.plot(walls.drive * MILLI, middle, color=colour, linewidth=1.3, label=f"{kind}: median, 5 to 95 %")
            peaks = np.sort(walls.peaks) * MEGA
            fraction = (np.arange(len(peaks)) + 0.5) / len(peaks)
            below.plot(peaks, fraction, "o-", color=colour, markersize=3, linewidth=0.9, label=f"{kind}, {len(peaks)}")
        above.plot(alone.drive * MILLI, alone.walls[0].stress * MEGA, "--", color="0.15", label="no scatter")
        below.axvline(alone.peaks[0] * MEGA, color="0.15", linestyle="--", label="no scatter")
        for ax in (above, below):
            ax.legend(frameon=False, fontsize=8)
    return figure


def frequencies(modes: Mapping[str, tuple[Ensemble, Mapping[str, Ensemble]]]) -> Figure:
    """The wall without scatter and the walls with it, a row for each mode: joints coloured by how often they break."""
    kinds = next(iter(modes.values()))[1]
    figure, axes = sheet(len(modes), 1 + len(kinds), (10.0, 3.3 * len(modes)))
    for row, (mode, (alone, by_kind)) in zip(axes, modes.items(), strict=True):
        for ax, (kind, walls) in zip(row, {"no scatter": alone, **by_kind}.items(), strict=True):
            painted = _paint(ax, walls)
            ax.set_title(f"{mode}: {kind}", fontsize=9)
    figure.colorbar(painted, ax=axes, shrink=0.6, label="share of the walls in which it is broken at the end [1]")
    return figure


def _paint(axes: Axes, walls: Ensemble) -> LineCollection:
    """All joints thin and grey, broken ones over them, wider and darker the more often."""
    ends = np.stack([walls.lines.start, walls.lines.end], axis=1)[:, :, [0, 2]] * MILLI
    axes.add_collection(LineCollection(list(ends[walls.joint]), colors="0.75", linewidths=0.8))
    often = walls.frequency
    order = np.argsort(often)[np.sort(often) > 0.0]
    lines = LineCollection(list(ends[order]), cmap="YlOrRd", clim=(0.0, 1.0), linewidths=1.0 + 3.0 * often[order])
    lines.set_array(often[order])
    axes.add_collection(lines)
    axes.set(aspect="equal", xticks=[], yticks=[])
    axes.grid(False)
    axes.spines[:].set_visible(False)
    axes.autoscale()
    return lines

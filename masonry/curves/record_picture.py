"""A record of the ground as a picture: acceleration, velocity, displacement over time; its spectrum and its target."""

from typing import Any

import numpy as np

from masonry.ground.ground_motion import Motion
from masonry.ground.spectrum import ResponseSpectrum
from masonry.pictures.style import number_logarithms, plain

G = 9.80665
BLUE, RED = "#1f3b5c", "#b2182b"


def record_figure(title: str, motion: Motion, spectrum: ResponseSpectrum, target: np.ndarray | None) -> Any:
    """A matplotlib figure.

    target  (n,) m/s^2, the pseudo-accelerations that were asked for at the periods of the spectrum; None: none were
    """
    from matplotlib.figure import Figure

    figure = Figure(figsize=(9, 5.5), layout="constrained")
    panels = figure.subplot_mosaic([["a", "s"], ["v", "s"], ["d", "s"]], width_ratios=[3, 2])
    figure.suptitle(plain(title), fontsize=12)
    lines = {
        "a": (motion.acceleration / G, "acceleration [g]"),
        "v": (motion.velocity * 1e2, "velocity [cm/s]"),
        "d": (motion.displacement * 1e2, "displacement [cm]"),
    }
    for name, (values, label) in lines.items():
        axes = panels[name]
        axes.plot(motion.time, values, color=BLUE, linewidth=0.9)
        peak = np.abs(values).argmax()
        axes.plot(motion.time[peak], values[peak], "o", color=RED, markersize=4)
        _label_peak(axes, motion.time, values, int(peak))
        axes.set_ylabel(label)
    panels["d"].set_xlabel("time [s]")
    _draw_spectrum(panels["s"], spectrum, target)
    for axes in panels.values():
        axes.grid(color="0.9", linewidth=0.8)
        axes.spines[["top", "right"]].set_visible(False)
    return figure


def _label_peak(axes: Any, time: np.ndarray, values: np.ndarray, peak: int) -> None:
    """The largest value beside its dot, to the side where the picture has room."""
    late = time[peak] > 0.7 * time[-1]
    axes.annotate(
        f"{values[peak]:.3g}",
        (time[peak], values[peak]),
        xytext=(-5 if late else 5, 0),
        textcoords="offset points",
        ha="right" if late else "left",
        va="center",
        fontsize=10,
        color=RED,
        bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.7, "pad": 0.5},
    )


def _draw_spectrum(axes: Any, spectrum: ResponseSpectrum, target: np.ndarray | None) -> None:
    axes.loglog(spectrum.periods, spectrum.pseudo_acceleration / G, color=BLUE, linewidth=1.4, label="the record")
    if target is not None:
        axes.loglog(spectrum.periods, target / G, "--", color=RED, linewidth=1.2, label="asked for")
        axes.legend(frameon=False)
    for axis in (axes.xaxis, axes.yaxis):
        number_logarithms(axis)
    axes.set_xlabel("period [s]")
    axes.set_ylabel(f"pseudo-acceleration [g], damping {100.0 * spectrum.damping:g} %")

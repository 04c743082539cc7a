"""The pictures of the paper: curves side by side, and galleries of crack patterns."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from masonry.laboratory.result import Result
from masonry.pictures.style import MEGA, MILLI
from verification.html.figures import COLOURS, sheet

MOST_POINTS = 500
"""Of a line: more would only make the page heavy."""


@dataclass(frozen=True)
class Line:
    """A line of a picture; `style` as matplotlib has it, `colour` the next one of the row where none is given."""

    label: str
    x: np.ndarray
    y: np.ndarray
    style: str = "-"
    colour: str = ""


def stress_line(label: str, result: Result, colour: str = "") -> Line:
    """Stress in MPa against the displacement of the drive in mm."""
    rows = result.history.rows
    driven = rows["displacement"] > 0.0
    return Line(label, rows["displacement"][driven] * MILLI, rows["stress"][driven] * MEGA, colour=colour)


def curves(
    panels: Mapping[str, Sequence[Line]], x_label: str = "displacement [mm]", y_label: str = "stress [MPa]"
) -> Figure:
    """Panel title -> its lines, panels side by side; axis labels with units."""
    figure, axes = sheet(1, len(panels), (10.0 if len(panels) > 1 else 6.8, 3.8))
    for ax, (title, lines) in zip(axes.flat, panels.items(), strict=True):
        ax.set(title=title, xlabel=x_label)
        for k, line in enumerate(lines):
            thin = slice(None, None, max(1, -(-len(line.x) // MOST_POINTS)))
            x, y = np.append(line.x[thin], line.x[-1:]), np.append(line.y[thin], line.y[-1:])
            ax.plot(x, y, line.style, color=line.colour or COLOURS[k % len(COLOURS)], linewidth=1.6, label=line.label)
        if any(line.label for line in lines):
            ax.legend(frameon=False, fontsize=8)
    axes[0, 0].set_ylabel(y_label)
    return figure


def cracks(results: Mapping[str, Result], columns: int = 2, at_peak: bool = False, back: bool = False) -> Figure:
    """Name -> result: each specimen at the end of its run, with its cracks, displacements drawn by a stated factor.

    at_peak  draw each at the peak of its curve as well
    back     seen from behind
    """
    from masonry.pictures.crack_picture import frames_to_draw, gallery

    panels: list[tuple[str, Result, Any]] = []
    for name, result in results.items():
        frames = frames_to_draw(result) if at_peak else [("", result.history.frames[-1])]
        panels += [(", ".join(filter(None, (name, when))), result, frame) for when, frame in frames]
    return gallery(panels, columns, "back" if back else "front")

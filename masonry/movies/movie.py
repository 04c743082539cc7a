"""A movie of a run: its cracks beside its curve with a dot on it, frame by frame, in scales that stay the same."""

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from masonry.curves.collapse_curve import FACTOR_LABEL, factor_paths, is_collapse_curve
from masonry.curves.curve_axes import curve_axes, without_blows
from masonry.curves.settling_curve import COLOURS, across, movements
from masonry.errors import SceneError
from masonry.pictures.camera import box_of
from masonry.pictures.crack_picture import (
    draw_keys,
    drawing_of,
    frame_axes,
    largest_move,
    magnification,
    panel_title,
    thrusts_of,
)
from masonry.pictures.crack_style import kinds_of, scale_of
from masonry.pictures.large.scale_bar import draw_scale_bar
from masonry.pictures.style import MILLI, plain

if TYPE_CHECKING:
    from masonry.results.data import ResultData

FLAT = 0.35
"""Specimens whose height is a smaller share of their width stand above the curve, not beside it."""
DOT, TO_COME = "#b2182b", "#c3ccd6"


class CurveLine(NamedTuple):
    """One line of the curve: a name, and its places at some steps, in the units of the axes."""

    name: str
    steps: np.ndarray
    across: np.ndarray
    up: np.ndarray


class Movie:
    """A figure that shows one frame of a result after another.

    view   as masonry.pictures.camera.VIEWS; by default that which shows how it falls, else the front
    times  by how much displacements are drawn larger; by default so that the largest of all frames shows
    Raises SceneError where there are no frames.
    """

    def __init__(self, result: "ResultData", view: str | None = None, times: float | None = None) -> None:
        frames = result.history.frames
        if not frames:
            raise SceneError("this result has no frames: its run ended before there was one; there is nothing to draw")
        shaking = [frame for frame in frames if frame.time >= (1.0 - 1e-9) * result.time_origin]
        frames = shaking or frames
        self.result, self.frames = result, frames
        self.drawing = drawing_of(result, view)
        self.times = magnification(max(frames, key=largest_move), self.drawing.camera.size) if times is None else times
        self.cracks: list[Any] = [self.drawing.cracks(frame) for frame in frames]
        self.scale = scale_of(np.concatenate([lines.opening for lines in self.cracks]))
        moved = [frame.corners for frame in frames]
        self.limits = box_of(self.drawing.camera, result.specimen.blocks, moved, self.times)
        self.figure = self._figure()

    def draw(self, number: int) -> None:
        """Show frame `number`."""
        frame = self.frames[number]
        self.panel.clear()
        self.drawing.draw(self.panel, frame, self.cracks[number], self.times, self.scale)
        frame_axes(self.panel, self.limits)
        if self.result.is_large:
            draw_scale_bar(self.panel)
        name = f"frame {number + 1} of {len(self.frames)}"
        self.panel.set_title(panel_title(self.result, name, frame, self.times), fontsize=11)
        for path, passed, dot in self.moving:
            gone = int(np.searchsorted(path.steps, frame.step, side="right"))
            passed.set_data(path.across[:gone], path.up[:gone])
            dot.set_data([path.across[gone - 1]], [path.up[gone - 1]])

    def _figure(self) -> Any:
        """The figure as it stays: title, keys, curve and layout; the panel of cracks is drawn frame by frame."""
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure

        extent = self.limits[1] - self.limits[0]
        ratio = float(extent[1] / extent[0])
        if ratio < FLAT:
            figure = Figure(figsize=(11.0, 10.0 * ratio + 5.0), layout="constrained")
            self.panel, curve = figure.subplots(2, 1, height_ratios=[10.0 * ratio + 0.8, 3.0])
        else:
            figure = Figure(figsize=(13.0, min(max(7.0 * ratio + 1.8, 4.6), 9.0)), layout="constrained")
            self.panel, curve = figure.subplots(1, 2, width_ratios=[3.0, 2.0])
        FigureCanvasAgg(figure)
        figure.suptitle(plain(self.result.title), fontsize=13, wrap=True)
        self._draw_curve(curve)
        thrusts = thrusts_of(self.drawing, self.frames)
        draw_keys(figure, [self.panel], [self.drawing], self.scale, kinds_of(self.cracks), thrusts)
        self.draw(len(self.frames) - 1)
        if (engine := figure.get_layout_engine()) is not None:
            engine.execute(figure)
        figure.set_layout_engine("none")
        return figure

    def _draw_curve(self, axes: Any) -> None:
        """The whole curve, pale, and what moves over it."""
        self.moving: list[tuple[CurveLine, Any, Any]] = []
        rows = self.result.history.rows
        axes.grid(color="0.9", linewidth=0.8)
        axes.set_axisbelow(True)
        axes.spines[["top", "right"]].set_visible(False)
        if not len(rows.get("displacement", ())):
            axes.text(0.5, 0.5, "no rows were recorded", transform=axes.transAxes, ha="center")
            return
        paths, right, up = paths_of(self.result)
        for path, colour in zip(paths, 9 * COLOURS, strict=False):
            axes.plot(path.across, path.up, color=TO_COME, linewidth=2.0)
            (passed,) = axes.plot([], [], color=colour, linewidth=2.0, label=plain(path.name))
            (dot,) = axes.plot([], [], "o", color=DOT, markersize=8)
            self.moving.append((path, passed, dot))
        if not self.result.has_drive:
            axes.legend(loc="best", frameon=False, fontsize=10)
        axes.set(xlabel=right, ylabel=up)
        axes.margins(y=0.08)
        if self.result.has_drive and (limits := without_blows(self.result, paths[0].up)) is not None:
            axes.set_ylim(*limits)


def paths_of(result: "ResultData") -> tuple[list[CurveLine], str, str]:
    """The lines of the curve of a result, with the labels across and upwards: of the drive; without one, of all that
    curve.png shows moving."""
    rows = result.history.rows
    if result.has_drive:
        drawn = curve_axes(result)
        line = CurveLine("at the drive", rows["step"], drawn.across, rows["stress"] * drawn.factor)
        return [line], drawn.label, f"{drawn.name} [{drawn.unit}]"
    if is_collapse_curve(result):
        lines = factor_paths(result)
        label = plain(f"{lines[0].name} [mm]" if len(lines) == 1 else "displacement [mm]")
        return [CurveLine(line.name, line.steps, line.across, line.factor) for line in lines], label, FACTOR_LABEL
    over, label = across(result)
    moved = movements(result).items()
    return (
        [CurveLine(name, steps, over(steps), MILLI * path) for name, (steps, path) in moved],
        label,
        "displacement [mm]",
    )

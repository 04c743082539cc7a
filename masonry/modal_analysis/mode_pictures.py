"""A picture of modes: the blocks at their farthest, mode by mode, with axes, scale and frequency."""

from dataclasses import replace
from math import ceil
from typing import Any

import numpy as np

from geometry.polyhedra import measures
from masonry.modal_analysis.modes_data import ModesData
from masonry.pictures.camera import Camera, camera_of
from masonry.pictures.faces import FaceDrawing
from masonry.pictures.large.edges import continued
from masonry.pictures.large.moved_blocks import lamp_of, seen_pieces
from masonry.pictures.style import plain

SHOWN = 6
"""Modes in the picture, at most."""
SWING = 0.08
"""Displacement of the farthest corner in the picture, over the size of the specimen."""
MANY = 300
"""Blocks beside which the gaps between them are too thin to look into: faces in joints are then left out."""
WIDTH, HIGH = 3.3, 5.0
"""Of one mode, and about how high a tall one is, inches."""
LINES_APART = 16.0
"""Points between the edges of a unit, below which they are drawn thinner."""


def view_of(result: ModesData) -> str:
    """Front where no mode moves through the thickness, else iso."""
    camera = camera_of("front", result.specimen)
    across = np.abs(result.corners[:SHOWN] @ camera.toward).max(initial=0.0)
    return "front" if across <= 1e-3 else "iso"


def modes_figure(result: ModesData, view: str | None = None) -> Any:
    """A matplotlib figure of the slowest modes, up to six: each with its frequency, and what share of the mass takes
    part in it; places along the axes in m."""
    from matplotlib.figure import Figure

    camera = camera_of(view or view_of(result), result.specimen)
    count = min(len(result.frequencies), SHOWN)
    across = min(count, 3)
    figure = Figure(layout="constrained")
    figure.suptitle(plain(result.title), fontsize=13, wrap=True)
    panels = np.atleast_1d(
        figure.subplots(ceil(count / across), across, sharex=True, sharey=True, squeeze=False)
    ).ravel()
    edges = continued(result.blocks)
    for axes, mode in zip(panels, range(count), strict=False):
        _draw(result, mode, camera, edges, axes)
    for axes in panels[count:]:
        axes.set_axis_off()
    _fit(figure, panels, ceil(count / across), across, camera)
    return figure


def _draw(result: ModesData, mode: int, camera: Camera, edges: Any, axes: Any) -> None:
    times = SWING * camera.size
    moved = replace(result.blocks, points=result.blocks.points + times * result.corners[mode])
    faces = FaceDrawing(moved, camera, lamp_of(camera), _thinness(result, camera))
    for piece in seen_pieces(moved, camera, edges, _hidden(result)):
        faces.add_piece(piece)
    faces.draw(axes)
    axis = int(np.argmax(share := result.share[mode]))
    percent = f"{100.0 * share[axis]:.1f} %"
    along = "no mass along any axis" if percent == "0.0 %" else f"{percent} of the mass along {'xyz'[axis]}"
    axes.set_title(
        f"{mode + 1}: {result.frequencies[mode]:.5g} Hz\n{along}\nfarthest corner {times:.3g} m away",
        fontsize=9,
    )


def _thinness(result: ModesData, camera: Camera) -> float:
    """Ratio of the widths of lines to the usual ones: 1, and less where units are but a few points wide."""
    blocks = result.blocks
    unit = float(np.median(measures.volumes(blocks))) ** (1.0 / 3.0)
    return min(1.0, unit / camera.size * 72.0 * HIGH / LINES_APART)


def _hidden(result: ModesData) -> np.ndarray:
    """(F,) faces that are left out of a picture: those of a floor, which would fill it, and those in joints of many
    blocks."""
    blocks = result.blocks
    floor = np.array([result.scene.is_floor(name) for name in blocks.groups])[blocks.group][blocks.face_block()]
    return np.asarray(floor | (result.covered & (blocks.count > MANY)))


def _fit(figure: Any, panels: np.ndarray, rows: int, across: int, camera: Camera) -> None:
    """Equal scales, words at the axes where a view along an axis has some, and a height that fits."""
    for axes in panels:
        axes.set_aspect("equal")
        axes.autoscale_view()
        axes.margins(0.04)
        axes.spines[["top", "right"]].set_visible(False)
        axes.tick_params(labelsize=8)
    names = [_axis_word(direction) for direction in (camera.right, camera.up)]
    figure.supxlabel(names[0], fontsize=9)
    figure.supylabel(names[1], fontsize=9)
    drawn = [axes for axes in panels if axes.has_data()]
    low = np.min([axes.dataLim.min for axes in drawn], axis=0)
    high = np.max([axes.dataLim.max for axes in drawn], axis=0)
    aspect = float((high[1] - low[1]) / max(high[0] - low[0], 1e-300))
    width = WIDTH if aspect < 2.0 else 0.6 * WIDTH
    figure.set_size_inches(max(width * across, 4.0), rows * (min(max(width * aspect, 1.0), 7.0) + 0.8) + 0.7)


def _axis_word(direction: np.ndarray) -> str:
    """The axis of the specimen that a picture has there."""
    along = np.flatnonzero(np.abs(direction) > 1.0 - 1e-9)
    if not len(along):
        return "m, in the plane of the picture"
    return f"{'-' if direction[along[0]] < 0 else ''}{'xyz'[along[0]]} (m)"

"""Words in pictures that lie on no line and on no other words, and legends that are never cut."""

from textwrap import fill
from typing import Any, NamedTuple

import numpy as np

from masonry.pictures.style import plain

WIDEST = 30
"""Letters of a line of a legend beside a picture."""
PAD = 3.0
"""Points that words keep from lines and other words."""
DISTANCES = (9.0, 22.0, 38.0, 58.0)
"""Points from a place to its words, the nearest that is free; from the second on a thin line leads there."""
SIDES = ((1, 1), (-1, 1), (1, -1), (-1, -1), (1, 0), (-1, 0), (0, 1), (0, -1))
"""Where words stand to their place: to the right or left, above or below."""
EVERY = 4.0
"""Points between the places at which a line is looked at."""


class PointLabel(NamedTuple):
    """Words on a place of some axes (in their data), and their colour."""

    words: str
    place: tuple[float, float]
    colour: str = "0.25"


def place_labels(figure: Any, axes: Any, labels: list[PointLabel]) -> None:
    """Write labels, each beside its place where no line of the axes and no other words are: to the right and above, if
    that is free. The figure is laid out, and all else is drawn already."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    renderer = FigureCanvasAgg(figure).get_renderer()
    axes.autoscale_view()
    axes.set(xlim=axes.get_xlim(), ylim=axes.get_ylim())
    if (engine := figure.get_layout_engine()) is not None:
        engine.execute(figure)
    lines, boxes = _places_of(axes), [text.get_window_extent(renderer) for text in axes.texts]
    boxes += [key.get_window_extent(renderer) for key in [axes.get_legend()] if key is not None]
    for label in labels:
        text = axes.annotate(
            label.words, label.place, xytext=(0.0, 0.0), textcoords="offset points", color=label.colour, fontsize=11
        )
        text.set_bbox({"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 1.0})
        text.set_in_layout(False)
        tries = [(distance, *side) for distance in DISTANCES for side in SIDES]
        best = min(range(len(tries)), key=lambda k: (_in_the_way(text, tries[k], axes, lines, boxes, renderer), k))
        _move(text, tries[best])
        boxes.append(text.get_window_extent(renderer))
        if tries[best][0] > DISTANCES[0]:
            axes.annotate(
                "", label.place, xytext=text.xyann, textcoords="offset points",
                arrowprops={"arrowstyle": "-", "color": "0.6", "linewidth": 0.8, "shrinkA": 0.0, "shrinkB": 2.0},
            ).set_in_layout(False)  # fmt: skip


def _move(text: Any, where: tuple[float, int, int]) -> None:
    distance, right, up = where
    text.xyann = (distance * right, distance * up * (0.5 if right else 1.0))
    text.set_horizontalalignment({1: "left", 0: "center", -1: "right"}[right])
    text.set_verticalalignment({1: "bottom", 0: "center", -1: "top"}[up])


def _in_the_way(
    text: Any, where: tuple[float, int, int], axes: Any, lines: np.ndarray, boxes: list[Any], renderer: Any
) -> float:
    """How much lies under words that stand there: places of lines, other words, and what is out of the axes."""
    _move(text, where)
    box = text.get_window_extent(renderer).padded(PAD * axes.figure.dpi / 72.0)
    inside = np.all((lines >= box.min) & (lines <= box.max), axis=1)
    out = np.maximum(axes.bbox.min - box.min, 0.0).sum() + np.maximum(box.max - axes.bbox.max, 0.0).sum()
    return float(inside.sum()) + 1e3 * sum(box.overlaps(other) for other in boxes) + 10.0 * float(out)


def _places_of(axes: Any) -> np.ndarray:
    """(n, 2) pixels, places of all lines of the axes, so near to each other that no words fit between them."""
    every = EVERY * axes.figure.dpi / 72.0
    places = [np.zeros((0, 2))]
    for line in axes.lines:
        points = line.get_transform().transform(
            np.column_stack([np.ravel(line.get_xdata()), np.ravel(line.get_ydata())])
        )
        points = points[np.all(np.isfinite(points), axis=1)]
        if len(points) == 0:
            continue
        low, high = axes.bbox.min - 100.0, axes.bbox.max + 100.0
        points = np.clip(points, low, high)
        way = np.append(0.0, np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1)))
        at = np.linspace(0.0, way[-1], int(way[-1] / every) + 2)
        places.append(np.column_stack([np.interp(at, way, points[:, k]) for k in (0, 1)]))
    return np.concatenate(places)


def key_beside(axes: Any) -> None:
    """The legend of some axes, to the right of them; long names take several lines."""
    handles, words = axes.get_legend_handles_labels()
    words = [fill(word, WIDEST, break_on_hyphens=False) for word in words]
    axes.legend(
        handles, words, loc="upper left", bbox_to_anchor=(1.01, 1.0), borderaxespad=0.0, frameon=False, fontsize=10
    )


def key_below(figure: Any, handles: list[Any], fontsize: float = 10.0) -> None:
    """The legend of a figure, below all else, in as many columns as fit into its width."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    if not handles:
        return
    renderer = FigureCanvasAgg(figure).get_renderer()
    for columns in range(len(handles), 0, -1):
        if columns < len(handles) and -(-len(handles) // columns) == -(-len(handles) // (columns + 1)):
            continue  # as many lines as before
        columns = -(-len(handles) // -(-len(handles) // columns))
        key = figure.legend(
            handles=handles, loc="outside lower center", ncols=columns, frameon=False, fontsize=fontsize
        )
        if columns == 1 or key.get_window_extent(renderer).width <= 0.98 * figure.bbox.width:
            return
        key.remove()


def wrapped(words: str, width: int) -> str:
    """Words as they were written, in lines of no more than some letters."""
    return fill(plain(words), width, break_on_hyphens=False)

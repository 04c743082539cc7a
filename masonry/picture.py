"""cracks.png: the deformed specimen from the front, at the peak and at the end, with its damaged contacts."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from geometry.blocks import Blocks
from geometry.ragged import ranges
from masonry.crack_drawing import LEAST_DAMAGE, crack_keys, draw_cracks, draw_scales, scale_of
from masonry.cracks import CrackLines, Outlines, View, back_view, crack_lines, front_view, outlines
from masonry.history import Frame
from masonry.plot import MEGA, MILLI, peak_row, plain

if TYPE_CHECKING:
    from masonry.results import Result

VISIBLE = 0.04
"""The largest displacement is drawn as about this share of the specimen's size."""

PLATE_COLOUR = "#c4c7cb"
COLOURS = {"units": "#f2e2c9", "mortar": "#dfe8dc"}
SPARE_COLOURS = ("#e6dff0", "#e3ecd2", "#f6dcdc", "#d8e8ea", "#f7f0c8")


def frames_to_draw(result: "Result") -> list[tuple[str, Frame]]:
    """The frame nearest to the peak and the last one; one only where they are the same."""
    frames = result.history.frames
    if not frames:
        return []
    rows = result.history.rows
    last = frames[-1]
    if not len(rows.get("stress", ())):
        return [("at the end", last)]
    step = rows["step"][peak_row(rows)]
    peak = min(frames, key=lambda frame: abs(frame.step - step))
    return [("at the end", last)] if peak is last else [("at the peak", peak), ("at the end", last)]


def magnification(frame: Frame, size: float) -> float:
    """How many times displacements are drawn, to two digits; 1 where nothing moves."""
    moves = [np.abs(array).max(initial=0.0) for array in (frame.corners, frame.nodes)]
    largest = float(max(moves))
    return float(f"{VISIBLE * size / largest:.2g}") if largest > 1e-12 * size else 1.0


def cracks_figure(result: "Result") -> Any:
    """A figure of one panel a frame, side by side, or one above the other for long specimens."""
    panels = frames_to_draw(result)
    view = front_view(result.specimen.blocks.points)
    beside = _ratio(result, view) > 0.3
    figure = gallery([(name, result, frame) for name, frame in panels], 2 if beside else 1)
    figure.suptitle(plain(result.title), fontsize=13, wrap=True)
    return figure


def gallery(panels: "Sequence[tuple[str, Result, Frame]]", columns: int = 2, back: bool = False) -> Any:
    """A figure of panels in rows: (name, result, one of its frames) each, with one key and one scale to them all.

    back  seen from behind, as the tension face of a wall in bending
    """
    from masonry.figure import ShownFigure

    columns = max(min(columns, len(panels)), 1)
    rows = max(-(-len(panels) // columns), 1)
    view_of = back_view if back else front_view
    views = [view_of(result.specimen.blocks.points) for _, result, _ in panels]
    ratio = max((_ratio(result, view) for (_, result, _), view in zip(panels, views, strict=True)), default=1.0)
    width = 14.0 if len(panels) > 1 else 9.0
    height = rows * min(max((width - 2.6) / columns * ratio + 0.7, 2.4), 10.0) + 0.9
    figure = ShownFigure(figsize=(width, height), layout="constrained")
    axes = list(np.atleast_1d(figure.subplots(rows, columns)).ravel())
    for spare in axes[len(panels) :]:
        spare.set_axis_off()
    if not panels:
        axes[0].text(0.5, 0.5, "no frames were recorded", transform=axes[0].transAxes, ha="center")
        return figure
    cracks = [_damaged(result, frame, view) for (_, result, frame), view in zip(panels, views, strict=True)]
    scale = scale_of(np.concatenate([lines.opening for lines in cracks]))
    for one, (name, result, frame), view, lines in zip(axes, panels, views, cracks, strict=False):
        _draw_panel(one, result, frame, view, lines, scale)
        one.set_title(_panel_title(result, name, frame, view, narrow=columns > 2), fontsize=10 if columns > 2 else 11)
    _draw_keys(figure, axes, [result.specimen.blocks for _, result, _ in panels], scale)
    return figure


def _ratio(result: "Result", view: View) -> float:
    """Height over width of a specimen in a view."""
    extent = np.ptp(view.project(result.specimen.blocks.points), axis=0)
    return float(extent[1] / extent[0]) if extent[0] > 0 else 1.0


def _damaged(result: "Result", frame: Frame, view: View) -> CrackLines:
    """The contacts to draw."""
    lines = crack_lines(result.joints, frame, view)
    return lines.select(lines.damage > LEAST_DAMAGE)


def _draw_panel(axes: Any, result: "Result", frame: Frame, view: View, lines: CrackLines, scale: float) -> None:
    times = magnification(frame, view.size)
    blocks = result.specimen.blocks
    _draw_blocks(axes, blocks, outlines(blocks, view), view.project(blocks.points + times * frame.corners))
    draw_cracks(axes, result, lines, frame, view, times, scale)
    axes.set_aspect("equal")
    axes.autoscale_view()
    axes.margins(0.03)
    axes.set_axis_off()


def _panel_title(result: "Result", name: str, frame: Frame, view: View, narrow: bool) -> str:
    """Name, displacement, stress, and by how much displacements are drawn larger; narrow panels take one more line."""
    between = "\n" if narrow else " "
    words = f"{name}:{between}displacement {frame.displacement * MILLI:.4g} mm"
    rows = result.history.rows
    if len(rows.get("stress", ())):
        stress = np.interp(frame.step, rows["step"], rows["stress"])
        words += f", stress {stress * MEGA:.3g} MPa"
    return f"{words}\ndisplacements drawn {magnification(frame, view.size):g} times"


def _draw_blocks(axes: Any, blocks: Blocks, shown: Outlines, flat: np.ndarray) -> None:
    """Faces and their edges, layer by layer from the back; flat (P, 2) are the displaced corners."""
    from matplotlib.collections import LineCollection, PolyCollection

    colour = group_colours(blocks.groups)
    owner = blocks.face_block()
    sides = np.diff(blocks.face_start)
    for layer in np.unique(shown.layer):
        chosen = np.flatnonzero(shown.layer == layer)
        face = shown.face[chosen]
        index = ranges(blocks.face_start[face], sides[face])[1]
        last = np.cumsum(sides[face]) - 1
        after = np.arange(1, len(index) + 1)
        after[last] = last + 1 - sides[face]
        corners = flat[blocks.face_points[index]]
        thick = np.stack([corners, corners[after]], axis=1)[np.concatenate([shown.outer[n] for n in chosen])]
        polygons = np.split(corners, last[:-1] + 1)
        if np.all(sides[face] == sides[face[0]]):  # drawn faster as one array
            polygons = corners.reshape(len(face), -1, 2)
        fills = [colour[g] for g in blocks.group[owner[face]].tolist()]
        depth = 1.0 + 0.01 * float(layer)
        axes.add_collection(
            PolyCollection(polygons, facecolors=fills, edgecolors="#a09a90", linewidths=0.35, zorder=depth)
        )
        axes.add_collection(LineCollection(thick, colors="#4a4640", linewidths=1.0, zorder=depth + 0.005))


def group_colours(groups: tuple[str, ...]) -> list[str]:
    """A pale colour for each group, grey for plates."""
    colours = []
    spare = 0
    for name in groups:
        if "plate" in name:
            colours.append(PLATE_COLOUR)
        elif name in COLOURS:
            colours.append(COLOURS[name])
        else:
            colours.append(SPARE_COLOURS[spare % len(SPARE_COLOURS)])
            spare += 1
    return colours


def _draw_keys(figure: Any, axes: list[Any], drawn: list[Blocks], scale: float) -> None:
    """Colour bars of damage, and a legend of crack kinds, crack openings and block groups."""
    from matplotlib.patches import Patch

    draw_scales(figure, axes)
    colours: dict[str, str] = {}
    for blocks in drawn:
        shown = zip(blocks.groups, group_colours(blocks.groups), strict=True)
        colours |= {name: colour for g, (name, colour) in enumerate(shown) if g in blocks.group}
    keys: list[Any] = [Patch(facecolor=c, edgecolor="#4a4640", label=name) for name, c in colours.items()]
    keys += crack_keys(scale)
    figure.legend(handles=keys, loc="outside lower center", ncols=len(keys), frameon=False, fontsize=10)

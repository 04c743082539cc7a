"""cracks.png: the deformed specimen from the front, at the peak and at the end, with its damaged contacts."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from geometry.specimens.placed import FLOOR
from masonry.pictures.camera import box_of, usual_view
from masonry.pictures.crack_style import crack_keys, draw_scales, kinds_of, scale_of
from masonry.pictures.drawing import Drawing
from masonry.pictures.front import FlatDrawing, group_colours
from masonry.pictures.labels import key_below
from masonry.pictures.large.moved_blocks import MovedDrawing
from masonry.pictures.large.scale_bar import draw_scale_bar
from masonry.pictures.oblique import SolidDrawing
from masonry.pictures.overlays.element_lines import element_keys_of
from masonry.pictures.style import MEGA, MILLI, plain
from masonry.pictures.thrust_line import ThrustLine
from masonry.results.dry_joints import LEAST_DAMAGE, NARROW, all_dry
from masonry.results.frame_choice import at_stronger_side, moment, uncaught_fall, without_noise
from masonry.rows.history import Frame

if TYPE_CHECKING:
    from masonry.results.data import ResultData

VISIBLE = 0.04
"""The largest displacement is drawn as about this share of the specimen's size."""
CLOSED = 0.0025
"""What joints give way elastically is drawn as at most this share of it, about the width of a line: else strain looks
like cracks where it opens, and like a layer between the units where it closes."""
MOST = 1000.0
"""How many times displacements are drawn at most: what a wall that stands gives way looks like a collapse else."""
LITTLE = 4.0
"""How many times larger displacements are drawn at least, if they are: a hundredth of the size shows as it is."""
WIDTHS, BARS = (6.75, 8.4, 10.5), 1.8
"""Inches, of a picture of one panel, of two, and of more columns; and of what stands beside them."""
NEXT_LINE = "\n"
BESIDE = 0.3
"""Height over length above which two panels stand beside each other."""


def drawing_of(result: "ResultData", view: str | None = None) -> Drawing:
    """Drawing of a result in one of VIEWS, by default in its usual one."""
    view = view or usual_view(result)
    if result.is_large:
        return MovedDrawing(result, view)
    return SolidDrawing(result) if view == "iso" else FlatDrawing(result, view)


def frames_to_draw(result: "ResultData") -> list[tuple[str, Frame]]:
    """The frame nearest to the peak, of a drive that turns back to the stronger side, and the last one; one only where
    they are the same. What no floor catches is drawn as it falls, before it is out of sight."""
    frames = result.history.frames
    if not frames:
        return []
    if (fallen := uncaught_fall(result)) is not None:
        return [("as it falls", next((frame for frame in frames if frame.step >= fallen), frames[-1]))]
    peak, last = at_stronger_side(result), frames[-1]
    return [("at the end", last)] if peak is last else [("at the peak", peak), ("at the end", last)]


def magnification(frame: Frame, size: float) -> float:
    """How many times displacements are drawn, to two digits, so that the largest shows and joints that are whole look
    closed; 1 in place of less than LITTLE, so that blocks that fell lie where they fell, and what turned keeps its
    shape, and where nothing moves."""
    largest = max(largest_move(frame), VISIBLE / CLOSED * elastic_move(frame))
    larger = float(f"{VISIBLE * size / largest:.2g}") if largest > 1e-12 * size else 1.0
    return min(larger, MOST) if larger >= LITTLE else 1.0


def elastic_move(frame: Frame) -> float:
    """The largest way (m) that the faces of a joint moved towards each other, or apart under tension without a crack
    that is drawn."""
    pulled = (frame.damage <= LEAST_DAMAGE) & (frame.normal_stress > 0.0)
    return float(np.where(pulled, np.abs(frame.opening), np.maximum(-frame.opening, 0.0)).max(initial=0.0))


def largest_move(frame: Frame) -> float:
    """The largest displacement (m) of a corner or a node along an axis."""
    return float(max(np.abs(array).max(initial=0.0) for array in (frame.corners, frame.nodes)))


def cracks_figure(result: "ResultData") -> Any:
    """A figure of one panel a frame, side by side, or one above the other for long specimens."""
    panels = frames_to_draw(result)
    figure = gallery([(name, result, frame) for name, frame in panels], None)
    figure.suptitle(plain(result.title), fontsize=13, wrap=True)
    return figure


def gallery(
    panels: "Sequence[tuple[str, ResultData, Frame]]",
    columns: int | None = 2,
    view: str | None = None,
    times: float | None = None,
) -> Any:
    """A figure of panels in rows: (name, result, one of its frames) each, with one key and one scale to them all.

    columns  None: two, or one where what is drawn is long
    view   "front", "back" as the tension face of a wall in bending, "side", or "iso" from the front, the right and
           above; by default that which shows how it falls, else the front
    times  by how much displacements are drawn larger; by default so that they show, panel by panel
    """
    from masonry.pictures.figure import ShownFigure

    drawings = {id(result): drawing_of(result, view) for _, result, _ in panels}
    shown = [drawings[id(result)] for _, result, _ in panels]
    ratio = max((_ratio(drawing) for drawing in shown), default=1.0)
    columns = max(min(columns or (2 if ratio > BESIDE else 1), len(panels)), 1)
    rows = max(-(-len(panels) // columns), 1)
    width = WIDTHS[min(max(columns, len(panels[:2])), 3) - 1]
    height = rows * min(max((width - BARS) / columns * ratio + 0.8, 2.0), 8.0) + 1.0
    figure = ShownFigure(figsize=(width, height))
    figure.set_layout_engine("constrained", h_pad=0.08)  # inches, between the title and those of the panels
    axes = list(np.atleast_1d(figure.subplots(rows, columns)).ravel())
    for spare in axes[len(panels) :]:
        spare.set_axis_off()
    if not panels:
        axes[0].text(0.5, 0.5, "no frames were recorded", transform=axes[0].transAxes, ha="center")
        return figure
    cracks: list[Any] = [drawing.cracks(frame) for drawing, (_, _, frame) in zip(shown, panels, strict=True)]
    scale = scale_of(np.concatenate([lines.opening for lines in cracks]))
    for panel_axes, (name, result, frame), drawing, lines in zip(axes, panels, shown, cracks, strict=False):
        larger = magnification(frame, drawing.camera.size) if times is None else times
        drawing.draw(panel_axes, frame, lines, larger, scale)
        frame_axes(panel_axes, _box(drawing))
        if result.is_large:
            draw_scale_bar(panel_axes)
        title = panel_title(result, name, frame, larger, narrow=columns > 1)
        title += "" if len(lines.opening) else f"{', ' if columns == 1 else NEXT_LINE}no crack of {NARROW * MILLI:g} mm"
        panel_axes.set_title(title, fontsize=10)
    thrusts = [
        line for drawing, (_, _, frame) in zip(shown, panels, strict=True) for line in thrusts_of(drawing, [frame])
    ]
    draw_keys(figure, axes, shown, scale, kinds_of(cracks), thrusts)
    return figure


def frame_axes(axes: Any, box: np.ndarray | None = None) -> None:
    """Equal scales, and no lines round what is drawn; it fills the axes, or they show a box (low, high)."""
    axes.set_aspect("equal")
    axes.autoscale_view()
    axes.margins(0.03)
    if box is not None:
        (x_min, y_min), (x_max, y_max) = box
        axes.set(xlim=(x_min, x_max), ylim=(y_min, y_max))
    axes.set_axis_off()


def _box(drawing: Drawing) -> np.ndarray | None:
    """Of what stands on a floor: the place that it ever takes; a floor goes on beyond it. None without a floor."""
    blocks = drawing.result.specimen.blocks
    if FLOOR not in blocks.groups:
        return None
    moved = [np.zeros_like(blocks.points), *(frame.corners for frame in drawing.result.history.frames)]
    box = box_of(drawing.camera, blocks, moved)
    box[0, 1] -= 0.05 * float(np.ptp(box, axis=0).max())
    return box


def _ratio(drawing: Drawing) -> float:
    """Height over width of a specimen in a view."""
    box = _box(drawing)
    extent = np.ptp(drawing.camera.project(drawing.result.specimen.blocks.points) if box is None else box, axis=0)
    return float(extent[1] / extent[0]) if extent[0] > 0 else 1.0


def panel_title(result: "ResultData", name: str, frame: Frame, times: float, narrow: bool = False) -> str:
    """Name, displacement, stress, share of the way, and by how much displacements are drawn larger; the time in place
    of the share where a run is one in real time, the time or the step alone where nothing is driven.

    narrow panels take one more line, without the share; a long name has a line to itself
    """
    between = "\n" if narrow or len(name) > 30 else " "
    rows, when = result.history.rows, moment(result, frame)
    if not result.has_drive:
        return f"{name if when in name else f'{name}:{between}{when}'}\n{_drawn(times)}"
    displacements = rows.get("displacement", np.array([other.displacement for other in result.history.frames]))
    words = f"{name}:{between}displacement {without_noise(frame.displacement, displacements) * MILLI:.4g} mm"
    if len(rows.get("stress", ())):
        stress = without_noise(float(np.interp(frame.step, rows["step"], rows["stress"])), rows["stress"])
        words += f", stress {stress * MEGA:.3g} MPa"
        progress = "" if narrow else f"{100 * travelled_fraction(rows, frame):.3g} % of the way, "
        progress = progress if not result.in_real_time else "" if when in name else f"{when}, "
        words += f"\n{progress}"
    else:
        words += "\n"
    return f"{words}{_drawn(times)}"


def _drawn(times: float) -> str:
    """By how much displacements are drawn larger, in words."""
    return "drawn at true scale" if times == 1.0 else f"displacements drawn {times:g} times"


def travelled_fraction(rows: dict[str, np.ndarray], frame: Frame) -> float:
    """How much of all that the drive goes, to and fro, lies before a frame; of the time where nothing is driven."""
    travel = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(rows["displacement"])))])
    travel = travel if travel[-1] > 0.0 else rows["step"] - rows["step"][0]
    return float(np.interp(frame.step, rows["step"], travel) / travel[-1]) if travel[-1] > 0.0 else 1.0


def thrusts_of(drawing: Drawing, frames: Sequence[Frame]) -> list[ThrustLine]:
    """The thrust line of a drawing, where one of the frames has any of it."""
    if drawing.thrust is None:
        return []
    return [drawing.thrust] if any(np.isfinite(drawing.forces_at(frame, 1.0)).any() for frame in frames) else []


def draw_keys(
    figure: Any,
    axes: list[Any],
    drawings: Sequence[Drawing],
    scale: float,
    kinds: Sequence[str],
    thrusts: Sequence[ThrustLine],
) -> None:
    """Colour bars of damage, where it has degrees; a legend of groups, crack kinds and openings, and thrust lines; of
    what occurs."""
    from matplotlib.patches import Patch

    dry = all(all_dry(drawing.result) for drawing in drawings)
    if not dry:
        draw_scales(figure, axes, kinds)
    colours: dict[str, str] = {}
    for blocks in (drawing.result.specimen.blocks for drawing in drawings):
        shown = zip(blocks.groups, group_colours(blocks.groups), strict=True)
        colours |= {name: colour for g, (name, colour) in enumerate(shown) if g in blocks.group}
    keys: list[Any] = [Patch(facecolor=c, edgecolor="#4a4640", label=name) for name, c in colours.items()]
    keys += crack_keys(scale, kinds, dry)
    keys += {line.in_a_row: line.key() for line in thrusts}.values()
    elements = [key for drawing in drawings for key in element_keys_of(drawing.result)]
    keys += {key.get_label(): key for key in elements}.values()
    key_below(figure, keys)

"""The specimen of a scene as a picture: units and cells, groups, supports, loads, named sets, axes in mm."""

from pathlib import Path
from typing import Any

import numpy as np

from geometry.blocks import Blocks, Joints, Specimen
from geometry.whole_files import whole_file
from masonry.assembly import joined
from masonry.condition_marks import Mark, box_of, marks, nearer_side, spread
from masonry.errors import SceneError
from masonry.picture import group_colours
from masonry.picture_frame import draw_axes, draw_sets
from masonry.plot import plain, write_png
from masonry.scene import Scene
from masonry.solid_view import Piece, Sight, front_sight, hidden, oblique_sight, visible_pieces

COLOURS = {"support": "#1e7a4c", "drive": "#c0392b", "traction": "#1f5fa8"}
UNIT_EDGE, CELL_EDGE = "#3a362f", "#9a9386"
WIDTH = 11.0
"""Of the picture, inches."""
ARROW = 0.09
"""Length of an arrow over the size of the picture."""
VIEWS = ("front", "iso")


def draw_geometry(scene: Scene, path: Path, view: str | None = None) -> Path:
    """Write the picture (.png) of a scene's specimen, whole or not at all; returns the path.

    view: "front", or "iso" from the front, the right and above; by default iso where the drive moves across the front.
    Raises SceneError for a path that is no .png or cannot be written, and for a scene that cannot be built.
    """
    path = Path(path)
    if path.suffix != ".png":
        raise SceneError(f"--out '{path}': the picture is a .png file; nearest: '{path.with_suffix('.png')}'")
    specimen, joints = joined(scene)
    figure = geometry_figure(scene, specimen, joints, view)
    with whole_file(path) as beside:
        write_png(figure, beside)
    return path


def sight_of(scene: Scene, specimen: Specimen, view: str | None) -> Sight:
    """The projection of a view by its name, or the one that shows the drive."""
    front = front_sight(specimen.blocks.points)
    if view is None:
        across = scene.drive is not None and abs(front.toward[scene.drive.axis]) > 0.5
        view = "iso" if across else "front"
    return front if view == "front" else oblique_sight()


def geometry_figure(scene: Scene, specimen: Specimen, joints: Joints, view: str | None = None) -> Any:
    """A matplotlib figure."""
    from matplotlib.figure import Figure

    sight = sight_of(scene, specimen, view)
    blocks = specimen.blocks
    size = float(np.ptp(sight.project(blocks.points), axis=0).max())
    listed = marks(scene, specimen, joints)
    figure = Figure(figsize=(WIDTH, WIDTH), layout="constrained")
    axes = figure.subplots()
    _title(figure, scene, specimen)
    pieces = visible_pieces(blocks, joints, sight)
    _draw_pieces(axes, blocks, pieces, sight)
    for mark in listed:
        _draw_mark(axes, specimen, mark, pieces, sight, size)
    draw_sets(axes, specimen, pieces, sight, size)
    draw_axes(axes, blocks, sight)
    rows = _draw_list(figure, blocks, listed)
    axes.margins(0.02)
    low, high = axes.dataLim.min, axes.dataLim.max
    drawn = (WIDTH - 1.2) * float((high[1] - low[1]) / (high[0] - low[0]))
    figure.set_size_inches(WIDTH, min(max(drawn, 1.5), 10.0) + 1.5 + 0.2 * rows)
    return figure


def _title(figure: Any, scene: Scene, specimen: Specimen) -> None:
    count = specimen.blocks.count
    figure.suptitle(plain(scene.title or scene.name), fontsize=13, wrap=True)
    figure.axes[0].set_title(f"{specimen.shape}: {count} block{'s' * (count > 1)}", fontsize=10, color="0.3")


def _draw_pieces(axes: Any, blocks: Blocks, pieces: list[Piece], sight: Sight) -> None:
    """Faces from the back to the front, each with its own edges, so that what is nearer hides what is behind."""
    from matplotlib.collections import PathCollection
    from matplotlib.colors import to_rgb
    from matplotlib.path import Path as Outline

    colours = [np.array(to_rgb(c)) for c in group_colours(blocks.groups)]
    owner = blocks.face_block()
    paths, fills, lines, widths = [], [], [], []
    for piece in pieces:
        flat = sight.project(piece.corners)
        across = np.cross(piece.corners[1] - piece.corners[0], piece.corners[2] - piece.corners[0])
        light = 1.0 if sight.front else 0.78 + 0.22 * float(across @ (0.2, -0.75, 0.6) / np.linalg.norm(across))
        fill = (*np.clip(colours[blocks.group[owner[piece.face]]] * light, 0, 1), 1.0)
        paths.append(Outline(np.vstack([flat, flat[:1]])))
        fills.append(fill)
        lines.append(fill)
        widths.append(0.4)
        after = np.roll(flat, -1, axis=0)
        for edges, colour, wide in (
            (piece.block_edge & ~piece.unit_edge, CELL_EDGE, 0.6),
            (piece.unit_edge, UNIT_EDGE, 1.3),
        ):
            for k in np.flatnonzero(edges):
                paths.append(Outline([flat[k], after[k]]))
                fills.append((0, 0, 0, 0))
                lines.append((*to_rgb(colour), 1.0))
                widths.append(wide)
    axes.add_collection(PathCollection(paths, facecolors=fills, edgecolors=lines, linewidths=widths, capstyle="round"))


def _draw_mark(axes: Any, specimen: Specimen, mark: Mark, pieces: list[Piece], sight: Sight, size: float) -> None:
    colour = COLOURS[mark.kind]
    if mark.kind == "support":
        _draw_support(axes, specimen, mark, pieces, sight, size)
    for base, way, presses in mark.arrows:
        _draw_arrows(axes, sight, pieces, (base, way, presses), colour, size)
    if mark.arrows and mark.value:
        _draw_value(axes, sight, mark, size)


def _draw_value(axes: Any, sight: Sight, mark: Mark, size: float) -> None:
    """Words at the free end of the last arrow of the first group."""
    base, way, presses = mark.arrows[0]
    out = (-1.0 if presses else 1.0) * _flat(sight, way)
    at = sight.project(base[-1]) + 1.1 * ARROW * size * out
    ha = "center" if abs(out[0]) < 0.3 else "left" if out[0] > 0 else "right"
    va = "center" if abs(out[1]) < 0.3 else "bottom" if out[1] > 0 else "top"
    axes.annotate(mark.value, at, ha=ha, va=va, fontsize=10, color=COLOURS[mark.kind], zorder=9)
    axes.update_datalim([at + (0.0, 0.05 * size), at - (0.0, 0.05 * size)])


def _flat(sight: Sight, way: np.ndarray) -> np.ndarray:
    """Direction on the paper; zero where it runs along the line of sight."""
    direction = sight.project(way)
    length = np.linalg.norm(direction)
    return direction / length if length > 0.2 else np.zeros(2)


def _draw_arrows(
    axes: Any, sight: Sight, pieces: list[Piece], arrows: tuple[np.ndarray, np.ndarray, bool], colour: str, size: float
) -> None:
    """Arrows onto or away from their places; a dot or a cross in a ring where they run along the line of sight."""
    base, way, presses = arrows
    direction = _flat(sight, way)
    if not direction.any():
        nearer = way @ sight.toward > 0
        for x, z in sight.project(base):
            axes.plot(x, z, "o", ms=11, mfc="white", mec=colour, mew=1.6, zorder=8)
            axes.plot(x, z, "o" if nearer else "x", ms=4 if nearer else 7, color=colour, mew=1.6, zorder=8)
        return
    for point in base:
        place = sight.project(point)
        start, end = (place - ARROW * size * direction, place) if presses else (place, place + ARROW * size * direction)
        behind = hidden(point + (-1e-3 if presses else 1e-3) * size * way, pieces, sight, 1e-4 * size)
        style = {"arrowstyle": "-|>", "color": colour, "lw": 1.8, "mutation_scale": 14, "shrinkA": 0, "shrinkB": 0}
        axes.annotate("", end, start, zorder=0.5 if behind else 8, arrowprops=style)
        axes.update_datalim([start, end])


def _draw_support(axes: Any, specimen: Specimen, mark: Mark, pieces: list[Piece], sight: Sight, size: float) -> None:
    """Hatched where nothing moves; else triangles with a line, as rollers, against each direction that is held."""
    from matplotlib.collections import PolyCollection

    colour = COLOURS["support"]
    owner = specimen.blocks.face_block()
    if mark.all_held:
        own = np.isin([owner[p.face] for p in pieces], mark.blocks)
        if mark.faces is not None:
            own = np.isin([p.face for p in pieces], mark.faces)
        shown = [sight.project(p.corners) for p, mine in zip(pieces, own, strict=True) if mine]
        axes.add_collection(
            PolyCollection(shown, facecolors="none", edgecolors=colour, hatch="////", linewidths=0.0, zorder=5)
        )
        if shown and mark.faces is None:
            return
    for part in mark.parts:
        low, high = box_of(specimen, part, mark.faces)
        for axis in mark.held:
            at_high = nearer_side(specimen, low, high, axis)
            way = (1.0 if at_high else -1.0) * np.eye(3)[axis]
            direction = _flat(sight, way)
            if not direction.any():
                continue
            for place in spread(
                low, high, axis, high[axis] if at_high else low[axis], 3 if sight.front else 2, 0.08 * size
            ):
                behind = hidden(place + 1e-3 * size * way, pieces, sight, 1e-4 * size)
                depth = 0.5 if behind else 7.0
                _draw_roller(axes, sight.project(place), direction, 0.028 * size, colour, mark.all_held, depth)


def _draw_roller(
    axes: Any, tip: np.ndarray, out: np.ndarray, size: float, colour: str, fixed: bool, depth: float
) -> None:
    from matplotlib.patches import Polygon

    along = np.array([-out[1], out[0]])
    base = tip + size * out
    axes.add_patch(
        Polygon(
            [tip, base + 0.6 * size * along, base - 0.6 * size * along], fc="white", ec=colour, lw=1.4, zorder=depth
        )
    )
    level = base + (0.0 if fixed else 0.25) * size * out
    ends = np.array([level - 0.8 * size * along, level + 0.8 * size * along])
    axes.plot(*ends.T, color=colour, lw=1.6, zorder=depth)
    axes.update_datalim(ends)


def _draw_list(figure: Any, blocks: Blocks, listed: list[Mark]) -> int:
    """Groups, and a line for each support, drive and traction, below the picture; how many rows that takes."""
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    used = np.unique(blocks.group)
    keys: list[Any] = [
        Patch(facecolor=colour, edgecolor=UNIT_EDGE, label=f"{name}, {int((blocks.group == number).sum())} blocks")
        for number, (name, colour) in enumerate(zip(blocks.groups, group_colours(blocks.groups), strict=True))
        if number in used
    ]
    for mark in listed:
        symbol = "^" if mark.kind == "support" else ">"
        keys.append(Line2D([], [], marker=symbol, ls="", color=COLOURS[mark.kind], label=plain(mark.words)))
    columns = 1 if max(len(key.get_label()) for key in keys) > 60 else 2
    figure.legend(handles=keys, loc="outside lower left", ncols=columns, frameon=False, fontsize=9)
    return -(-len(keys) // columns)

"""The specimen of a scene as a picture: units and cells, groups, supports, loads, named sets, axes in mm."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from geometry.blocks import Blocks, Joints, Specimen
from geometry.files.atomic import whole_file
from masonry.assembly.assemble import joined
from masonry.drawings.condition_marks import Mark, marks
from masonry.drawings.mark_drawing import COLOURS, draw_mark, place_of_value, stands_left
from masonry.drawings.picture_frame import draw_axes, draw_sets
from masonry.drawings.road_drawing import draw_road, road_keys
from masonry.pictures.camera import Camera, camera_of, with_less_floor
from masonry.pictures.faces import UNIT_EDGE, FaceDrawing
from masonry.pictures.front import group_colours
from masonry.pictures.hidden_surfaces import visible_pieces
from masonry.pictures.overlays.element_lines import draw_elements, element_keys
from masonry.pictures.style import plain, write_picture
from masonry.runtime.named_file import require_picture
from masonry.scene import Scene
from masonry.scene.tables.specimen import table_of

WIDTH = 9.0
"""Of the picture, inches."""


def draw_geometry(scene: Scene, path: Path, view: str | None = None) -> Path:
    """Write the picture (.png, .pdf or .svg) of a scene's specimen, whole or not at all; returns the path.

    view: "front", or "iso" from the front, the right and above; by default iso where the drive moves, or a tilt leans,
    across the front, and for vaults, domes and walls of several leaves.
    Raises SceneError for a path of another suffix or cannot be written, and for a scene that cannot be built.
    """
    path = Path(path)
    require_picture(path, "--out")
    specimen, joints = joined(scene)
    figure = geometry_figure(scene, specimen, joints, view)
    with whole_file(path) as beside:
        write_picture(figure, beside)
    return path


def camera_for(scene: Scene, specimen: Specimen, view: str | None) -> Camera:
    """The camera of a view by its name, or the one that shows along which the drive pushes and things lean."""
    if view is None:
        toward = camera_of("front", specimen).toward
        across = any(abs(toward @ direction) > 0.5 for direction in _directions(scene))
        view = "iso" if across else table_of(specimen.shape).usual_view
    return camera_of(view, specimen)


def _directions(scene: Scene) -> list[np.ndarray]:
    """Unit vectors along which a scene's drive pushes, its tilt lets things lean, and a turned specimen leans."""
    directions = [np.eye(3)[scene.drive.axis]] if scene.drive is not None else []
    turned = getattr(scene.specimen, "turned", None)
    if turned is not None and turned.about != "z":
        directions.append(np.eye(3)[1 - "xy".index(turned.about)])
    if scene.gravity is not None and scene.gravity.tilt is not None:
        lean = np.cross(np.eye(3)["xyz".index(scene.gravity.tilt.about)], scene.gravity.vector)
        directions.append(lean / np.linalg.norm(lean))
    return directions


def geometry_figure(scene: Scene, specimen: Specimen, joints: Joints, view: str | None = None) -> Any:
    """A matplotlib figure."""
    from matplotlib.figure import Figure

    camera = camera_for(scene, specimen, view)
    blocks = with_less_floor(specimen.blocks)
    whole = np.array_equal(blocks.points, specimen.blocks.points)
    specimen = replace(specimen, blocks=blocks)
    size = float(np.ptp(camera.project(blocks.points), axis=0).max())
    listed = marks(scene, specimen, joints)
    figure = Figure(figsize=(WIDTH, WIDTH), layout="constrained")
    axes = figure.subplots()
    _title(figure, scene, specimen, "" if whole else "; of the floor a part")
    pieces = visible_pieces(blocks, joints, camera)
    faces = FaceDrawing(blocks, camera)
    for piece in pieces:
        faces.add_piece(piece)
    faces.draw(axes)
    draw_road(axes, scene, specimen, joints, camera)
    draw_elements(axes, scene, blocks, camera, pieces)
    for mark in listed:
        draw_mark(axes, specimen, mark, pieces, camera, size)
    words = [words for mark in listed if (words := place_of_value(mark, camera, size)) is not None]
    left_taken = any(stands_left(specimen, mark) for mark in listed)
    draw_sets(axes, specimen, pieces, camera, size, words, left_taken)
    draw_axes(axes, blocks, camera, left_taken)
    rows = _draw_list(figure, blocks, listed, road_keys(scene), element_keys(scene))
    axes.margins(0.02)
    low, high = axes.dataLim.min, axes.dataLim.max
    drawn = (WIDTH - 1.2) * float((high[1] - low[1]) / (high[0] - low[0]))
    figure.set_size_inches(WIDTH, min(max(drawn, 1.5), 8.0) + 1.5 + 0.2 * rows)
    return figure


def _title(figure: Any, scene: Scene, specimen: Specimen, more: str) -> None:
    figure.suptitle(plain(scene.title or scene.name), fontsize=13, wrap=True)
    figure.axes[0].set_title(f"{specimen.shape}: {_blocks(specimen.blocks.count)}{more}", fontsize=10, color="0.3")


def _blocks(count: int) -> str:
    return f"{count} block{'s' * (count > 1)}"


def _draw_list(
    figure: Any, blocks: Blocks, listed: list[Mark], road: list[tuple[str, str]], elements: list[Any]
) -> int:
    """Groups, and a line for each support, drive, traction, fill, vehicle and element, below the picture; how many rows
    that takes."""
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    used = np.unique(blocks.group)
    keys: list[Any] = [
        Patch(facecolor=colour, edgecolor=UNIT_EDGE, label=f"{name}, {_blocks(int((blocks.group == number).sum()))}")
        for number, (name, colour) in enumerate(zip(blocks.groups, group_colours(blocks.groups), strict=True))
        if number in used
    ]
    for mark in listed:
        symbol = "^" if mark.kind == "support" else ">"
        keys.append(Line2D([], [], marker=symbol, ls="", color=COLOURS[mark.kind], label=plain(mark.words)))
    keys += [Patch(facecolor=colour, label=plain(words)) for colour, words in road]
    keys += elements
    columns = 1 if max(len(key.get_label()) for key in keys) > 60 else 2
    figure.legend(handles=keys, loc="outside lower left", ncols=columns, frameon=False, fontsize=9)
    return -(-len(keys) // columns)

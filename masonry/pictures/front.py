"""A specimen from the front or from behind: its displaced outlines, group by colour, its cracks and thrust line."""

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from geometry.blocks import Blocks
from geometry.polyhedra.indexing import following, ranges
from masonry.pictures.camera import camera_of
from masonry.pictures.crack_lines import CrackLines, Outlines, crack_lines, outlines
from masonry.pictures.crack_style import draw_cracks
from masonry.pictures.drawing import Drawing
from masonry.pictures.overlays.axle_arrows import draw_axles_of
from masonry.pictures.overlays.element_lines import draw_elements_of
from masonry.pictures.thrust_line import thrust_line
from masonry.results.dry_joints import LEAST_DAMAGE, NARROW, as_it_stands, moved_undamaged
from masonry.rows.history import Frame

if TYPE_CHECKING:
    from masonry.results.data import ResultData

PLATE_COLOUR = "#c4c7cb"
COLOURS = {"units": "#f2e2c9", "mortar": "#dfe8dc"}
SPARE_COLOURS = ("#e6dff0", "#e3ecd2", "#f6dcdc", "#d8e8ea", "#f7f0c8")


class FlatDrawing(Drawing):
    """Draws the frames of one result from the front or from behind."""

    def __init__(self, result: "ResultData", view: str = "front") -> None:
        self.result = result
        self.camera = camera_of(view, result.specimen, [frame.corners for frame in result.history.frames])
        self.outlines = outlines(result.specimen.blocks, self.camera)
        self.thrust = thrust_line(result, self.camera)

    def cracks(self, frame: Frame) -> CrackLines:
        frame = as_it_stands(self.result, frame)
        lines = crack_lines(self.result.joints, frame, self.camera)
        lines = replace(lines, dry=moved_undamaged(self.result, frame)[lines.contact])
        cracked = (lines.damage > LEAST_DAMAGE) | lines.dry | lines.crushed
        return lines.select(cracked & (lines.opening >= NARROW))

    def draw(self, axes: Any, frame: Frame, cracks: CrackLines, times: float, scale: float) -> None:
        blocks = self.result.specimen.blocks
        _draw_blocks(axes, blocks, self.outlines, self.camera.project(blocks.points + times * frame.corners))
        draw_cracks(axes, self.result, cracks, frame, self.camera, times, scale)
        draw_elements_of(axes, self.result, frame, self.camera, times)
        draw_axles_of(axes, self.result, frame, self.camera)
        if self.thrust is not None:
            self.thrust.draw(axes, self.camera.project(self.forces_at(frame, times)))


def _draw_blocks(axes: Any, blocks: Blocks, shown: Outlines, flat: np.ndarray) -> None:
    """Faces and their edges, layer by layer from the back; flat (P, 2) are the displaced corners."""
    from matplotlib.collections import LineCollection, PolyCollection
    from matplotlib.colors import to_rgba_array

    colour = to_rgba_array(group_colours(blocks.groups))
    owner = blocks.face_block()
    sides = np.diff(blocks.face_start)
    layer_of_edge = np.repeat(shown.layer, sides[shown.face])
    for layer in np.unique(shown.layer):
        face = shown.face[shown.layer == layer]
        start = np.append(0, np.cumsum(sides[face]))
        corners = flat[blocks.face_points[ranges(blocks.face_start[face], sides[face])[1]]]
        thick = np.stack([corners, corners[following(start)]], axis=1)[shown.outer[layer_of_edge == layer]]
        polygons = np.split(corners, start[1:-1])
        if np.all(sides[face] == sides[face[0]]):  # drawn faster as one array
            polygons = corners.reshape(len(face), -1, 2)
        depth = 1.0 + 0.01 * float(layer)
        axes.add_collection(
            PolyCollection(
                polygons,
                facecolors=colour[blocks.group[owner[face]]],
                edgecolors="#a09a90",
                linewidths=0.35,
                zorder=depth,
            ),
            autolim=False,
        )
        lines = LineCollection(thick, colors="#4a4640", linewidths=0.8, zorder=depth + 0.005)
        axes.add_collection(lines, autolim=False)
        axes.update_datalim(corners)  # once for both, where each asks path by path


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

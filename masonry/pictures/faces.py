"""Faces and lines drawn from the back to the front in one collection, so that what is nearer hides what is behind."""

from typing import Any

import numpy as np

from geometry.blocks import Blocks
from masonry.pictures.camera import Camera
from masonry.pictures.front import group_colours
from masonry.pictures.hidden_surfaces import Piece

UNIT_EDGE, CELL_EDGE = "#3a362f", "#9a9386"
CLEAR = (0.0, 0.0, 0.0, 0.0)
LAMP = np.array([0.2, -0.75, 0.6])
"""From where light falls on what is seen obliquely; what is seen along an axis has no shade."""


class FaceDrawing:
    """Layers of a drawing in the order of their addition: what is added later is drawn over what was added before."""

    def __init__(self, blocks: Blocks, camera: Camera, lamp: np.ndarray | None = None, thinness: float = 1.0) -> None:
        """thinness: ratio of the widths of edges to the usual ones"""
        from matplotlib.colors import to_rgb

        self.camera, self.lamp = camera, lamp
        if lamp is None and not camera.along_an_axis:
            self.lamp = LAMP
        self._colours = [np.array(to_rgb(c)) for c in group_colours(blocks.groups)]
        self._group = blocks.group[blocks.face_block()]
        self._edges = [(*to_rgb(colour), 1.0) for colour in (CELL_EDGE, UNIT_EDGE)]
        self._thinness = thinness
        self._paths: list[Any] = []
        self._fills: list[Any] = []
        self._lines: list[Any] = []
        self._widths: list[float] = []

    def add_piece(self, piece: Piece) -> None:
        """A face or a part of one, lit from the front, with its own edges."""
        flat = self.camera.project(piece.corners)
        light = 1.0
        if self.lamp is not None:
            across = np.cross(piece.corners[1] - piece.corners[0], piece.corners[2] - piece.corners[0])
            light = 0.78 + 0.22 * float(across @ self.lamp / np.linalg.norm(across))
        fill = (*np.clip(self._colours[self._group[piece.face]] * light, 0, 1), 1.0)
        outline, (cell, unit), (thin, thick) = (
            np.vstack([flat, flat[:1]]),
            self._edges,
            (0.6 * self._thinness, 1.3 * self._thinness),
        )
        if piece.unit_edge.all():
            self._add(outline, fill, unit, thick)
            return
        self._add(outline, fill, fill, 0.4)
        after = np.roll(flat, -1, axis=0)
        inner, outer = piece.block_edge & ~piece.unit_edge, piece.unit_edge
        for edges, colour, wide in ((inner, cell, thin), (outer, unit, thick)):
            for k in np.flatnonzero(edges):
                self._add(np.array([flat[k], after[k]]), CLEAR, colour, wide)

    def add_polygon(self, corners: np.ndarray, colour: Any) -> None:
        """A polygon (n, 3) m of one colour."""
        flat = self.camera.project(corners)
        self._add(np.vstack([flat, flat[:1]]), colour, colour, 0.4)

    def add_line(self, ends: np.ndarray, colour: Any, width: float) -> None:
        """A line between two points (2, 3) m, its width in points."""
        self._add(self.camera.project(ends), CLEAR, colour, width)

    def _add(self, flat: np.ndarray, fill: Any, line: Any, width: float) -> None:
        from matplotlib.path import Path

        self._paths.append(Path(flat))
        self._fills.append(fill)
        self._lines.append(line)
        self._widths.append(width)

    def draw(self, axes: Any) -> None:
        """Draw all that was added."""
        from matplotlib.collections import PathCollection

        axes.add_collection(
            PathCollection(
                self._paths,
                facecolors=self._fills,
                edgecolors=self._lines,
                linewidths=self._widths,
                capstyle="round",
                joinstyle="round",
            )
        )

"""A viewer by PyVista: blocks, seen through, their units outlined, and the joints in colour."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from geometry.joints.covered import covered_fractions
from geometry.polyhedra.indexing import Lists, following, ranges
from geometry.polyhedra.measures import face_areas_normals_centroids
from masonry.pictures.camera import camera_of
from masonry.pictures.crack_picture import panel_title
from masonry.pictures.crack_style import crack_map
from masonry.pictures.front import group_colours
from masonry.pictures.hidden_surfaces import unit_edges
from masonry.results.dry_joints import LEAST_DAMAGE
from masonry.results.joint_fields import JointGrid
from masonry.rows.history import Frame

if TYPE_CHECKING:
    from masonry.results.data import ResultData

PALE = 0.35
EDGES = "#3a362f"
BAR = {
    **{"vertical": True, "height": 0.6, "width": 0.06, "position_x": 0.88, "position_y": 0.15},
    **{"title_font_size": 18, "label_font_size": 16, "color": "black", "n_labels": 5, "fmt": "%.3g"},
}
"""Of colours: at the right-hand side."""


@dataclass(frozen=True)
class Shown:
    """A field of the joints: title of its bar, factor from SI, map of colours, and its range where that is given."""

    title: str
    factor: float
    colours: str
    range: tuple[float, float] | None = None

    def colour_map(self) -> Any:
        """Without what would be too pale, but for a map that goes to both sides."""
        return self.colours if self.range == (-1.0, 1.0) else crack_map(self.colours)


FIELDS = {
    "opening": Shown("opening [mm]", 1e3, "Reds"),
    "slip": Shown("slip [mm]", 1e3, "Blues"),
    "damage": Shown("damage [1]", 1.0, "Purples", (0.0, 1.0)),
    "damage_tension": Shown("damage by tension [1]", 1.0, "Reds", (0.0, 1.0)),
    "damage_shear": Shown("damage by shear [1]", 1.0, "Blues", (0.0, 1.0)),
    "mode": Shown("damage [1]\n+ mostly tension\n- mostly shear", 1.0, "coolwarm", (-1.0, 1.0)),
}


def values_of(frame: Frame, name: str) -> np.ndarray:
    """(C,) a field of FIELDS in SI: opening without closing, `mode` as damage with a minus where shear damaged more."""
    if name == "mode":
        return np.where(frame.damage_tension >= frame.damage_shear, frame.damage, -frame.damage)
    values: np.ndarray = getattr(frame, name)
    return np.maximum(values, 0.0)


class Viewer:
    """Blocks and joints of a result on a plotter; `set` moves them to a frame."""

    def __init__(self, plotter: Any, result: "ResultData", field: str, everywhere: bool = False) -> None:
        import pyvista

        self.plotter, self.result, self.field, self.everywhere = plotter, result, field, everywhere
        self.number, self.times = -1, 1.0
        blocks = result.specimen.blocks
        self.size = float(np.ptp(blocks.points, axis=0).max())
        self.grid = JointGrid(result)
        self.walls = pyvista.PolyData(blocks.points.copy(), faces=self._outer_faces())
        self.walls.cell_data["colour"] = self._colours()
        self.lines = pyvista.PolyData(blocks.points.copy(), lines=self._outlines())
        cells = self.grid.cells
        self.tiles = pyvista.PolyData(cells.points.copy(), faces=_counted(cells.offsets, cells.connectivity))
        self.tiles.cell_data[field] = np.zeros(cells.count)
        shown = FIELDS[field]
        look = {"scalars": field, "cmap": shown.colour_map(), "clim": self._range(), "nan_opacity": 0.0}
        plotter.set_background("white")
        plotter.add_mesh(self.walls, scalars="colour", rgb=True, opacity=PALE, ambient=0.5, diffuse=0.6, name="blocks")
        plotter.add_mesh(self.lines, color=EDGES, line_width=1.5, name="outlines")
        plotter.add_mesh(
            self.tiles,
            **look,
            lighting=False,
            name="joints",
            scalar_bar_args={"title": f"{shown.title}\n", **BAR},
        )
        plotter.add_mesh(  # so that a joint seen edge-on shows
            self.tiles, **look, style="wireframe", line_width=3.0, lighting=False, name="edges", show_scalar_bar=False
        )

    def set(self, number: int, name: str, times: float) -> None:
        """Move to frame `number`, displacements `times` larger; `name` goes into the title."""
        frame = self.result.history.frames[number]
        self.number, self.times = number, times
        for mesh in (self.walls, self.lines):
            mesh.points = self.result.specimen.blocks.points + times * frame.corners
        self.tiles.points = self.grid.cells.points + times * self.grid.point_data(frame)["displacement"]
        values = FIELDS[self.field].factor * values_of(frame, self.field)
        shown = self.everywhere | (frame.damage > LEAST_DAMAGE)
        self.tiles.cell_data[self.field] = np.where(shown, values, np.nan)
        title = f"{self.result.title}\n{panel_title(self.result, name, frame, times)}"
        self.plotter.add_text(title, position="upper_left", font_size=11, color="black", name="title")

    def look(self, view: str) -> None:
        """From the front, from behind, or from the front, the right and above."""
        camera = camera_of(view, self.result.specimen, [frame.corners for frame in self.result.history.frames])
        self.plotter.enable_parallel_projection()
        self.plotter.view_vector(camera.toward, viewup=camera.up)

    def _range(self) -> tuple[float, float]:
        """Of the colours: the same at all frames."""
        shown = FIELDS[self.field]
        if shown.range is not None:
            return shown.range
        largest = max(float(values_of(frame, self.field).max(initial=0.0)) for frame in self.result.history.frames)
        return 0.0, shown.factor * largest or 1.0

    def _outer(self) -> np.ndarray:
        """Faces that no joint covers wholly; in large displacement, where joints open, all."""
        if self.result.is_large:
            return np.arange(len(self.result.specimen.blocks.face_start) - 1)
        return np.flatnonzero(covered_fractions(self.result.specimen.blocks, self.result.joints) < 1 - 1e-6)

    def _outer_faces(self) -> np.ndarray:
        blocks, faces = self.result.specimen.blocks, self._outer()
        sides = np.diff(blocks.face_start)[faces]
        index = ranges(blocks.face_start[faces], sides)[1]
        return _counted(np.concatenate([[0], np.cumsum(sides)]), blocks.face_points[index])

    def _colours(self) -> np.ndarray:
        """(n, 3) of the outer faces, by group, 0 to 255."""
        from matplotlib.colors import to_rgb

        blocks = self.result.specimen.blocks
        colours = np.array([to_rgb(colour) for colour in group_colours(blocks.groups)])
        return (255 * colours[blocks.group[blocks.face_block()[self._outer()]]]).astype(np.uint8)

    def _outlines(self) -> np.ndarray:
        """Edges that bound a unit, as lines between corners."""
        blocks, faces = self.result.specimen.blocks, self._outer()
        sides = Lists(blocks.face_start, blocks.face_points).taken(faces)
        outer = unit_edges(blocks, faces, face_areas_normals_centroids(blocks)[1])
        pairs = np.column_stack([sides.entry, sides.entry[following(sides.start)]])[outer]
        return np.column_stack([np.full(len(pairs), 2), pairs]).ravel()


def _counted(offsets: np.ndarray, connectivity: np.ndarray) -> np.ndarray:
    """Cells as PyVista takes them: the number of points before the points of each."""
    return np.insert(connectivity, offsets[:-1], np.diff(offsets))

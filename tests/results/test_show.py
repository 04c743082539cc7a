"""Result.show puts the blocks and the joints of a frame on the stage, in place and in colour."""

import sys

import numpy as np
import pytest
from matplotlib import image

from masonry.errors import SceneError
from masonry.movies.scene_3d import FIELDS, Viewer
from masonry.movies.viewer import add_slider, show
from tests.results.sample import sample, with_tets

pyvista = pytest.importorskip("pyvista")


class Plotter:
    """Takes what the stage puts on it, and draws nothing."""

    def __init__(self):
        self.shown, self.title = {}, ""

    def set_background(self, colour):
        pass

    def add_mesh(self, mesh, name, **how):
        self.shown[name] = mesh, how

    def add_text(self, text, **how):
        self.title = text


@pytest.mark.parametrize("make", [sample, lambda: with_tets(sample())], ids=["faces", "tets"])
def test_blocks_and_joints_stand_where_the_frame_has_them_drawn_by_the_stated_factor(make):
    result = make()
    stage = Viewer(Plotter(), result, "opening")
    stage.set(2, "at the end", 100.0)
    frame, blocks = result.history.frames[2], result.specimen.blocks
    for mesh in (stage.walls, stage.lines):
        np.testing.assert_allclose(mesh.points, blocks.points + 100.0 * frame.corners)
    parted = (frame.damage > 0.5)[stage.grid.owner]
    away = stage.tiles.points - stage.grid.cells.points
    np.testing.assert_allclose(away[parted], [[0.5 * 100.0 * frame.displacement, 0, 0]] * parted.sum(), atol=1e-9)
    assert "displacements drawn 100 times" in stage.plotter.title
    assert "displacement 0.2 mm, stress 0.0077" in stage.plotter.title


@pytest.mark.parametrize("field", FIELDS)
def test_damaged_joints_have_the_values_of_the_frame_and_the_others_none(field):
    result = sample()
    stage = Viewer(Plotter(), result, field)
    colours = stage.plotter.shown["joints"][1]
    for number, frame in enumerate(result.history.frames):
        stage.set(number, "", 1.0)
        values = stage.tiles.cell_data[field]
        np.testing.assert_array_equal(np.isnan(values), frame.damage <= 0.05)
        damaged = ~np.isnan(values)
        if field == "mode":
            np.testing.assert_allclose(np.unique(values[damaged]), [-0.6, 0.95] if damaged.any() else [])
        else:
            factor = 1e3 if field in ("opening", "slip") else 1.0
            np.testing.assert_allclose(values[damaged], factor * getattr(frame, field)[damaged])
        inside = (values[damaged] >= colours["clim"][0]) & (values[damaged] <= colours["clim"][1])
        assert inside.all(), "one range of colours for all frames"
    everywhere = Viewer(Plotter(), result, field, everywhere=True)
    everywhere.set(0, "", 1.0)
    assert not np.isnan(everywhere.tiles.cell_data[field]).any()


def test_the_outlines_are_those_of_units_not_of_the_cells_in_them():
    result = sample()
    stage = Viewer(Plotter(), result, "slip")
    ends = stage.lines.points[stage.lines.lines.reshape(-1, 3)[:, 1:]]
    upright = np.isclose(ends[:, :, 0], 0.125).all(axis=1) & np.isclose(np.ptp(ends[:, :, 2], axis=1), 0.1)
    level = np.floor(ends[upright][:, :, 2].mean(axis=1) / 0.1)
    assert set(level) == {1.0, 3.0}, "only where a half unit ends"


def test_in_large_displacement_faces_in_joints_are_there_for_when_the_joints_open():
    result = sample()
    whole = Viewer(Plotter(), result, "slip").walls.n_cells
    result.scene_toml += 'displacements = "large"\n'
    assert Viewer(Plotter(), result, "slip").walls.n_cells == 6 * result.specimen.blocks.count > whole


@pytest.mark.parametrize("view", ["iso", "front", "back"])
def test_a_screenshot_shows_red_and_blue_joints_at_the_end_and_none_at_the_start(tmp_path, view):
    for step, cracked in (("last", True), ("first", False)):
        sample().show(step, "mode", view=view, screenshot=tmp_path / "wall.png")
        picture = image.imread(tmp_path / "wall.png")[:, :1000, :3]
        assert picture.shape == (900, 1000, 3) and (picture < 0.95).any(axis=2).mean() > 0.1, "the wall is drawn"
        warm, cold = picture[..., 0] - picture[..., 2] > 0.4, picture[..., 2] - picture[..., 0] > 0.2
        assert (warm.sum() > 500) == cracked and (cold.sum() > 200) == cracked
    assert [path.name for path in tmp_path.iterdir()] == ["wall.png"]


def test_what_cannot_be_shown_is_refused_in_one_message(tmp_path, monkeypatch):
    for words, says in (
        ({"field": "opening_"}, "field 'opening_'.*did you mean 'opening'"),
        ({"view": "top"}, "view 'top'; known here: back, front, iso, side"),
        ({"screenshot": "wall.jpg"}, "nearest: 'wall.png'"),
        ({"step": "peek"}, "did you mean 'peak'"),
    ):
        with pytest.raises(SceneError, match=says):
            show(sample(), **words)
    for key in ("DISPLAY", "WAYLAND_DISPLAY"):
        monkeypatch.delenv(key, raising=False)
    if sys.platform.startswith("linux"):
        with pytest.raises(SceneError, match="no display.*screenshot="):
            show(sample())
    monkeypatch.setitem(sys.modules, "pyvista", None)
    with pytest.raises(SceneError, match=r"pip install '\.\[view\]'"):
        show(sample(), screenshot=tmp_path / "wall.png")
    assert list(tmp_path.iterdir()) == []


def test_the_slider_goes_through_the_frames_and_keeps_the_scale():
    plotter = pyvista.Plotter(off_screen=True, window_size=(300, 200))
    stage = Viewer(plotter, sample(), "opening")
    stage.set(1, "at the peak", 50.0)
    widget = add_slider(plotter, stage, 1)
    slider = widget.GetRepresentation()
    assert (slider.GetMinimumValue(), slider.GetValue(), slider.GetMaximumValue()) == (0, 1, 2)
    slider.SetValue(2.2)
    widget.InvokeEvent("EndInteractionEvent")
    frame = stage.result.history.frames[2]
    assert (stage.number, stage.times) == (2, 50.0)
    np.testing.assert_allclose(stage.walls.points, stage.result.specimen.blocks.points + 50.0 * frame.corners)
    plotter.close()

"""The earth, the road and the axles on a bridge are drawn where the blocks below them have gone."""

import numpy as np
import pytest
from matplotlib.figure import Figure

import masonry
from masonry.assembly.assemble import joined
from masonry.drawings.road_drawing import draw_road
from masonry.modal_analysis.mode_pictures import modes_figure
from masonry.pictures.camera import camera_of

LEVEL = 1.8


def drawn(moves):
    scene = masonry.load("bridge", {"vehicle.position": "2 m"})
    specimen, joints = joined(scene)
    axes = Figure().subplots()
    draw_road(axes, scene, specimen, joints, camera_of("front", specimen), moves)
    return axes


def test_road_and_axles_of_a_bridge_at_rest_stand_at_the_level_of_the_road():
    axes = drawn(None)
    assert axes.lines[0].get_ydata() == pytest.approx(LEVEL)
    assert [words.xy[1] for words in axes.texts if not words.get_text()] == pytest.approx([LEVEL, LEVEL])


def test_road_and_axles_move_with_the_blocks_below_them():
    sinks = lambda block, point: np.column_stack([0 * point[:, 0], 0 * point[:, 0], -0.02 * point[:, 0]])  # noqa: E731
    axes = drawn(sinks)
    x, z = axes.lines[0].get_data()
    earth = (x > 0.0) & (x < 10.0)
    assert z[earth] == pytest.approx(LEVEL - 0.02 * x[earth], abs=1e-9) and earth.sum() > 20
    tips = np.array([words.xy for words in axes.texts if not words.get_text()])
    assert tips[:, 1] == pytest.approx(LEVEL - 0.02 * tips[:, 0], abs=1e-9)
    strips = np.concatenate([path.vertices for path in axes.collections[0].get_paths()])
    assert strips[:, 1].max() <= LEVEL + 0.02


def test_titles_of_the_modes_of_a_tower_stand_within_their_panels():
    figure = modes_figure(masonry.modes(masonry.load("tower-shaken", {"specimen.courses": 30}), 4))
    figure.canvas.draw()
    boxes = [axes.title.get_window_extent() for axes in figure.axes if axes.has_data()]
    assert not any(a.overlaps(b) for k, a in enumerate(boxes) for b in boxes[k + 1 :])

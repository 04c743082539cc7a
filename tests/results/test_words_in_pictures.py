"""Words in pictures can be read: they lie on no other words, within their axes, and say 0 where nothing moved."""

from dataclasses import replace

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from masonry.curves.curve import curve_figure
from masonry.pictures.crack_picture import panel_title
from masonry.results.frame_choice import choose
from tests.results.sample import sample


def boxes(figure):
    """Where each text of the axes of a figure is drawn (pixels), and each legend."""
    renderer = FigureCanvasAgg(figure).get_renderer()
    figure.draw(renderer)
    texts = {text.get_text(): text.get_window_extent(renderer) for axes in figure.axes for text in axes.texts}
    keys = [key for key in (*figure.legends, *(axes.get_legend() for axes in figure.axes)) if key is not None]
    return texts, [key.get_window_extent(renderer) for key in keys]


def test_the_words_of_a_peak_at_the_end_lie_on_no_legend():
    result = sample()
    result.history.rows["stress"] = 1e9 * result.history.rows["displacement"]
    result.summary |= {"peak_stress_pa": 0.2e6, "displacement_at_peak_m": 2e-4}
    texts, legends = boxes(curve_figure(result))
    (peak,) = (box for words, box in texts.items() if words.startswith("peak"))
    assert legends and not any(peak.overlaps(legend) for legend in legends)


def test_the_words_of_a_late_peak_lie_on_none_of_what_is_left_after_it():
    result = sample()
    rows = result.history.rows
    rows["stress"] = np.minimum(1e9 * rows["displacement"], 0.2e6 - 0.01e6 * (rows["displacement"] > 1.9e-4))
    result.summary |= {"peak_stress_pa": 0.2e6, "displacement_at_peak_m": 1.9e-4}
    texts, _ = boxes(curve_figure(result))
    peak, residual = (
        next(box for words, box in texts.items() if words.startswith(what)) for what in ("peak", "at the end")
    )
    assert not peak.overlaps(residual)


def test_a_drive_that_came_back_says_0_in_titles():
    result = sample()
    last = replace(result.history.frames[-1], displacement=-2.7e-20)
    result.history.frames[-1] = last
    result.history.rows["stress"][-1] = -1e-12
    assert panel_title(result, "at the end", last, 1.0).startswith("at the end: displacement 0 mm, stress 0 MPa\n")
    assert "displacement 0 mm" in choose(result, "999").note
    result.history.rows = {}
    assert panel_title(result, "at the end", last, 1.0).startswith("at the end: displacement 0 mm\n")


@pytest.mark.parametrize("parts", [(0.0, 0.0, 0.0), (0.2, 0.05, 0.0), (0.0, 0.1, 0.3)])
def test_numbers_over_the_bars_of_cycles_stay_within_their_axes(parts):
    result = sample()
    dissipated = dict(zip(("fracture_mode_1_j", "fracture_mode_2_j", "friction_j"), parts, strict=True))
    result.summary |= {"cycles": [{**dissipated, "dissipated_j": sum(parts), "closed": False}]}
    figure = curve_figure(result)
    texts, legends = boxes(figure)
    (over,) = (box for words, box in texts.items() if "not closed" in words)
    assert over.y1 < figure.axes[2].bbox.y1 and over.y0 > figure.axes[2].bbox.y0 - 1.0
    assert not any(axes.bbox.overlaps(legend) for axes in figure.axes for legend in legends)

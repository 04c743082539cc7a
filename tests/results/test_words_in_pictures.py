"""Words in pictures can be read: they lie on no other words, within their axes, and say 0 where nothing moved."""

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg

from masonry.plot import curve_figure
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
    peak, residual = (next(box for words, box in texts.items() if words.startswith(what)) for what in ("peak", "resid"))
    assert not peak.overlaps(residual)

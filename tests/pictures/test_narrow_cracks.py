"""What is too narrow to be seen is drawn as no crack, no crack is drawn fat beside narrower ones alone, and the picture
of a specimen that stands does not look like a collapse."""

import dataclasses

import numpy as np
import pytest

from masonry.pictures.crack_picture import MOST, cracks_figure, drawing_of, magnification
from masonry.pictures.crack_style import LEAST_SCALE, THICK, THIN, scale_of, widths
from masonry.results.dry_joints import NARROW
from tests.results.sample import sample


def cracked(opening):
    """The sample whose end has cracks of one opening (m)."""
    result = sample()
    frame = result.history.frames[-1]
    part = opening / 2e-4
    last = dataclasses.replace(
        frame, corners=part * frame.corners, opening=part * frame.opening, slip=part * frame.slip
    )
    result.history.frames = [last]
    return result, last


@pytest.mark.parametrize("view", ["front", "iso"])
@pytest.mark.parametrize(("share", "drawn"), [(0.99, False), (1.01, True)])
def test_a_crack_below_the_stated_width_is_not_drawn(view, share, drawn):
    result, frame = cracked(share * NARROW)
    assert bool(len(drawing_of(result, view).cracks(frame).opening)) == drawn


def test_the_picture_says_which_cracks_there_are_none_of_and_draws_no_more_than_a_thousandfold():
    result, frame = cracked(2.5e-8)
    (title,) = [axes.get_title() for axes in cracks_figure(result).axes if axes.get_title()]
    assert title.endswith(f"displacements drawn {MOST:g} times, no crack of 0.001 mm")
    assert magnification(frame, 1.0) == MOST
    legend = [text.get_text() for text in cracks_figure(cracked(1e-4)[0]).legends[0].get_texts()]
    assert "opened or slid 0.001 mm (less is not drawn)" in legend and "opened or slid 0.1 mm" in legend


def test_a_narrow_crack_is_thin_where_there_is_no_wider_one():
    scale = scale_of(np.array([2e-6, 0.0]))
    assert scale == pytest.approx(LEAST_SCALE)
    assert widths(np.array([2e-6]), scale)[0] == pytest.approx(THIN + 0.2 * (THICK - THIN))
    assert scale_of(np.full(3, 0.9 * NARROW)) == 0.0


def test_no_legend_is_cut_however_many_names_it_has():
    result, _ = cracked(1e-4)
    groups = tuple(f"units of the {k}th kind of stone" for k in range(9))
    blocks = dataclasses.replace(
        result.specimen.blocks, groups=groups, group=np.arange(result.specimen.blocks.count) % 9
    )
    result.specimen = dataclasses.replace(result.specimen, blocks=blocks)
    figure = cracks_figure(result)
    figure.draw_without_rendering()
    box, page = figure.legends[0].get_window_extent(), figure.bbox
    assert page.x0 <= box.x0 and box.x1 <= page.x1 and page.y0 <= box.y0
    assert all(axes.get_position().height > 0.2 for axes in figure.axes)

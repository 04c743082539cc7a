"""Bars in pictures: full lines where they are seen, dashed ones where blocks hide them."""

import numpy as np
import pytest
from matplotlib.collections import LineCollection

import masonry
from masonry.assembly.assemble import fabric_of
from masonry.drawings.geometry_picture import geometry_figure
from masonry.limit_analysis.pictures import thrust_figure
from masonry.pictures.overlays.bar_lines import ELASTIC, stretches


def lines_of(figure) -> dict[bool, int]:
    """How many lines of bars are dashed, and how many are not."""
    from matplotlib.colors import to_rgba

    count = {True: 0, False: 0}
    for lines in figure.axes[0].collections:
        if isinstance(lines, LineCollection) and len(lines.get_colors()):
            mine = [tuple(colour) == to_rgba(ELASTIC) for colour in lines.get_colors()]
            count[lines.get_linestyles()[0][1] is not None] += sum(mine)
    return count


@pytest.mark.parametrize(("view", "expected"), [("iso", {True: 2, False: 0}), ("front", {True: 0, False: 2})])
def test_ties_below_a_floor_are_dashed_where_it_hides_them(view, expected):
    scene = masonry.load("house-tilted")
    fabric = fabric_of(scene)
    assert lines_of(geometry_figure(scene, fabric.specimen, fabric.joints, view)) == expected


def test_a_house_is_seen_from_the_front_and_not_from_above():
    fabric = fabric_of(scene := masonry.load("house-tilted"))
    assert geometry_figure(scene, fabric.specimen, fabric.joints).axes[0].get_ylabel() == "z [mm]"


def test_stretches_of_what_is_hidden():
    row = np.array([True, True, False, True, False, False, True])
    assert stretches(row) == [(0, 2), (3, 4), (6, 7)] and stretches(~row) == [(2, 3), (4, 6)]
    assert stretches(np.zeros(3, dtype=bool)) == []


def test_thrusts_behind_other_walls_are_left_out_where_a_house_is_seen_from_a_corner():
    result = masonry.limit("house-tilted")
    marks = {view: sum(len(line.get_xdata()) for line in thrust_figure(result, view).axes[0].lines if
                       line.get_marker() == "o") for view in ("iso", "front")}  # fmt: skip
    assert 0.2 * marks["front"] < marks["iso"] < 0.8 * marks["front"]

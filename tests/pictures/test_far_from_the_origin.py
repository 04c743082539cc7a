"""Coordinates of a specimen far from the origin are told in full, and not on each other."""

from dataclasses import replace
from itertools import pairwise

import numpy as np

from masonry.assembly.assemble import joined
from masonry.drawings.geometry_picture import geometry_figure
from masonry.scene import load


def test_coordinates_are_told_in_full_and_lie_on_no_others():
    scene = load("arch")
    far, (specimen, joints) = np.array([1e5, -3e4, 5e4]), joined(scene)
    specimen = replace(specimen, blocks=replace(specimen.blocks, points=specimen.blocks.points + far))
    joints = replace(joints, point=joints.point + far, patch_points=joints.patch_points + far)
    figure = geometry_figure(scene, specimen, joints, view="front")
    figure.draw_without_rendering()
    words = figure.axes[0].get_xticklabels()
    assert len(words) == 2 and all(abs(float(word.get_text()) * 1e-3 - 1e5) < 10.0 for word in words)
    assert not any(one.get_window_extent().overlaps(two.get_window_extent()) for one, two in pairwise(words))

"""Where two boxes touch, by hand: points half-way between two faces, between two edges, and where it is cut."""

import numpy as np
import pytest

from masonry.detection.narrow import EDGE, FACE, NONE
from tests.detection.touching import boxes, turn

LOW, HIGH = ([0.0, 0.0, 0.0], [1.0, 1.0, 1.0]), ([0.2, 0.3, 1.0], [0.8, 0.9, 1.5])
EVERY_WAY = pytest.mark.parametrize("way", [np.eye(3), turn(0.3, -1.1, 2.0)], ids=["straight", "askew"])


@EVERY_WAY
@pytest.mark.parametrize("gap", [0.02, 0.0, -0.02])
@pytest.mark.parametrize("pair", [(0, 1), (1, 0)])
def test_points_are_the_corners_of_the_overlap_half_way_between_the_faces(gap, pair, way):
    bodies = boxes(LOW, HIGH)
    bodies.put(1, bodies.position[1] + [0.0, 0.0, gap])
    bodies.move(way, np.array([5.0, -3.0, 2.0]))
    contact = bodies.touch(*pair)
    assert contact.kind == FACE and contact.separation == pytest.approx(gap, abs=1e-12)
    assert way.T @ contact.axis == pytest.approx([0.0, 0.0, 1.0 if pair == (0, 1) else -1.0], abs=1e-12)
    place = (contact.point - [5.0, -3.0, 2.0]) @ way
    wanted = [[x, y, 1.0 + 0.5 * gap] for x in (0.2, 0.8) for y in (0.3, 0.9)]
    order = np.lexsort(np.round(place, 6).T[[1, 0]])
    assert place[order] == pytest.approx(np.array(wanted), abs=1e-9)
    assert contact.gap == pytest.approx(np.full(4, gap), abs=1e-12)
    assert contact.area == pytest.approx(np.full(4, 0.09))


def test_what_is_farther_than_the_skin_does_not_touch():
    bodies = boxes(LOW, HIGH)
    bodies.put(1, bodies.position[1] + [0.0, 0.0, 0.02])
    assert bodies.touch(skin=0.0201).kind == FACE and bodies.touch(skin=0.0199).kind == NONE


@EVERY_WAY
@pytest.mark.parametrize("lean", [0.01, -0.03])
def test_gaps_of_a_block_that_leans_grow_along_its_face(lean, way):
    """It turns about the middle of its underside: to the right by x sin, from the plane of the larger block."""
    bodies = boxes(LOW, HIGH)
    tilt = turn(0.0, lean, 0.0)
    foot = np.array([0.5, 0.6, 1.0])
    bodies.put(1, foot + tilt @ (bodies.position[1] - foot), tilt)
    bodies.move(way, np.zeros(3))
    contact = bodies.touch()
    assert way.T @ contact.axis == pytest.approx([0.0, 0.0, 1.0], abs=1e-9), "its edge is deepest in the face below"
    place = contact.point @ way
    x = place[:, 0] - 0.5
    assert contact.gap == pytest.approx(-x * np.tan(lean), abs=1e-9)
    assert place[:, 2] == pytest.approx(1.0 + 0.5 * contact.gap, abs=1e-9)
    assert contact.area.sum() == pytest.approx(0.36 * np.cos(lean), rel=1e-3)


@pytest.mark.parametrize("least", [0.3, 0.01])
def test_an_overlap_is_cut_where_its_gap_is_wider_than_the_reach_and_keeps_the_least_area(least):
    """Leaning by 1 in 10 over its left edge, of 0.6 m it is less than 0.02 m off over the first 0.2."""
    bodies = boxes(LOW, HIGH)
    tilt = turn(0.0, -np.arctan(0.1), 0.0)
    edge = np.array([0.2, 0.6, 1.0])
    bodies.put(1, edge + tilt @ (bodies.position[1] - edge), tilt)
    contact = bodies.touch(reach=0.02, least=least)
    place = contact.point
    assert place[:, 0].max() == pytest.approx(0.4, rel=1e-3)
    assert contact.area.sum() == pytest.approx(max(0.2 * 0.6, least), rel=1e-3)
    assert contact.gap.max() == pytest.approx(0.02, rel=1e-3)


@EVERY_WAY
@pytest.mark.parametrize("gap", [0.01, -0.01])
def test_two_edges_that_cross_touch_half_way_between_them(gap, way):
    """A roof ridge along y below one along x."""
    bodies = boxes(([-0.5, -0.5, -0.5], [0.5, 0.5, 0.5]), ([-0.5, -0.5, -0.5], [0.5, 0.5, 0.5]))
    ridge = 0.5**0.5
    bodies.put(0, [0.0, 0.0, -ridge], turn(0.0, np.pi / 4, 0.0))
    bodies.put(1, [0.1, -0.2, ridge + gap], turn(np.pi / 4, 0.0, 0.0))
    bodies.move(way, np.array([1.0, 2.0, -1.0]))
    contact = bodies.touch(least=0.007)
    assert contact.kind == EDGE and len(contact.point) == 1
    place = way.T @ (contact.point[0] - [1.0, 2.0, -1.0])
    assert place == pytest.approx([0.0, -0.2, 0.5 * gap], abs=1e-9)
    assert (contact.gap[0], contact.area[0]) == (pytest.approx(gap, abs=1e-12), 0.007)
    assert way.T @ contact.axis == pytest.approx([0.0, 0.0, 1.0], abs=1e-9)

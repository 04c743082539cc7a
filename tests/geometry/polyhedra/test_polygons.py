import numpy as np
import pytest

from geometry.joints.find import find_joints
from geometry.polyhedra.construct import from_faces
from geometry.polyhedra.polygons import areas_normals_centroids, clip, pad, tidy, unpad


def padded(*polygons):
    points = np.concatenate([np.column_stack([p, np.zeros(len(p))]) for p in polygons])
    start = np.concatenate([[0], np.cumsum([len(p) for p in polygons])])
    return pad(points, start, np.arange(len(points)))


def test_padding_changes_neither_corners_nor_area():
    corners, count = padded([[0, 0], [1, 0], [0, 1]], [[0, 0], [2, 0], [3, 1], [2, 2], [0, 2]])
    area, normal, centroid = areas_normals_centroids(corners)
    assert area == pytest.approx([0.5, 5.0])
    assert np.array_equal(normal, [[0, 0, 1]] * 2)
    assert centroid[0] == pytest.approx([1 / 3, 1 / 3, 0])
    start, bare = unpad(corners, count)
    assert start.tolist() == [0, 3, 8]
    assert bare[:3, :2].tolist() == [[0, 0], [1, 0], [0, 1]]


def test_tidying_takes_out_doubled_corners_and_corners_on_a_straight_line():
    corners, count = padded(
        [[0, 0], [0.5, 0], [1, 0], [1, 1], [1 - 1e-12, 1], [0, 1], [0, 0.3], [0, 1e-12]],
        [[0, 0], [1, 0], [2, 0]],
        [[0, 0], [1, 0], [1, 1], [0, 1]],
    )
    corners, count = tidy(corners, count, 1e-9)
    assert count.tolist() == [4, 0, 4]
    assert np.allclose(np.sort(corners[0], axis=0)[:, :2], [[0, 0], [0, 0], [1, 1], [1, 1]], atol=1e-11)


def test_clipping_keeps_corners_that_lie_on_the_window_to_the_last_digit():
    random = np.random.default_rng(3)
    triangle, _ = padded(random.normal(size=(3, 2)))
    triangle = triangle if areas_normals_centroids(triangle)[1][0, 2] > 0 else triangle[:, ::-1]
    clipped, count = clip(triangle, np.array([3]), triangle, np.array([[0, 0, 1.0]]), 1e-12)
    assert count[0] == 3
    assert np.array_equal(clipped, triangle)


def test_polygons_apart_from_their_window_vanish_and_those_beside_it_keep_a_line():
    square = [[0, 0], [1, 0], [1, 1], [0, 1]]
    corners, count = padded(*(np.add(square, (x, 0)) for x in (2, 1, 0.25)))
    window, _ = padded(square, square, square)
    clipped, count = clip(corners, count, window, np.tile([0, 0, 1.0], (3, 1)), 1e-9)
    assert count.tolist() == [0, 2, 4]
    assert areas_normals_centroids(clipped)[0][2] == pytest.approx(0.75, rel=1e-15)


def test_a_corner_amid_an_edge_leaves_a_rectangle_its_own_rule(prism):
    below = prism(np.array([[0, 0], [1, 0], [2, 0], [2, 1], [0, 1.0]]), 0, 1)
    above = prism(np.array([[0, 0], [2, 0], [2, 1], [0, 1.0]]), 1, 2)
    joints = find_joints(from_faces([below, above], [0, 1], [0, 0], ["g"]))
    assert np.diff(joints.patch_start).tolist() == [4]
    assert np.allclose(joints.area, 0.5, rtol=1e-14)

"""Lines and points through convex bodies: which bodies hold how much of them."""

import numpy as np
import pytest

from geometry.polyhedra.line_cuts import pieces

OUT = np.concatenate([np.eye(3), -np.eye(3)])
WIDTH = 1e-9


def boxes(*spans):
    """Planes of boxes (low, high), as `pieces` takes them."""
    level = np.array([[*high, *(-np.array(low))] for low, high in spans], dtype=float)
    return np.tile(OUT, (len(spans), 1, 1)), level


ROW = boxes(((0, 0, 0), (1, 1, 1)), ((1, 0, 0), (3, 1, 1)), ((4, 0, 0), (5, 1, 1)))


def test_each_body_counts_by_its_length_on_the_line_and_a_gap_does_not_count():
    cut = pieces(*ROW, (None, 0.5, 0.5), WIDTH)
    assert cut.body.tolist() == [0, 1, 2]
    assert np.allclose(cut.fraction, [0.25, 0.5, 0.25])
    assert np.allclose(cut.middle, [[0.5, 0.5, 0.5], [2.0, 0.5, 0.5], [4.5, 0.5, 0.5]])


def test_bodies_that_meet_on_the_line_share_it():
    cut = pieces(*ROW, (1.0, 0.5, None), WIDTH)
    assert cut.body.tolist() == [0, 1]
    assert np.allclose(cut.fraction, 0.5)


def test_where_only_a_part_is_shared_the_whole_line_still_counts_evenly():
    """Two bodies over the first half of the line, a third over the second."""
    planes = boxes(((0, 0, 0), (1, 1, 1)), ((0, 1, 0), (1, 2, 1)), ((0, 0, 1), (1, 2, 2)))
    cut = pieces(*planes, (0.5, 1.0, None), WIDTH)
    fraction = np.bincount(cut.body, cut.fraction)
    assert np.allclose(fraction, [0.25, 0.25, 0.5])


def test_a_point_is_held_by_all_that_touch_it():
    assert pieces(*ROW, (1.0, 1.0, 0.5), WIDTH).body.tolist() == [0, 1]
    assert pieces(*ROW, (3.5, 0.5, 0.5), WIDTH).body.tolist() == []


def test_a_line_along_an_edge_within_rounding_is_held():
    cut = pieces(*ROW, (None, 1.0 + 0.5 * WIDTH, 0.0), WIDTH)
    assert cut.body.tolist() == [0, 1, 2]
    assert cut.fraction.sum() == pytest.approx(1.0)


def test_a_line_beside_all_bodies_is_held_by_none():
    assert len(pieces(*ROW, (None, 1.1, 0.5), WIDTH).body) == 0


def test_a_slanted_face_cuts_the_line_where_it_stands():
    normal = np.concatenate([OUT, [[1.0, 0.0, 1.0]]]) / np.array([1.0] * 6 + [np.sqrt(2)])[:, None]
    level = np.array([[1.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0 / np.sqrt(2)]])
    cut = pieces(normal[None], level, (None, 0.5, 0.25), WIDTH)
    assert np.allclose(cut.middle, [[0.375, 0.5, 0.25]])

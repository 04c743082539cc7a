import numpy as np
import pytest
from scipy.spatial import Delaunay

from geometry.polyhedra import measures
from geometry.polyhedra.construct import concatenate, from_boxes
from geometry.polyhedra.measures import centroids, extents, face_areas_normals_centroids, moments, volumes, widths


def second_moments(blocks):
    return moments(blocks)[2]


def unit_box(low, high, name="units"):
    return from_boxes(np.array([low]), np.array([high]), [0], [0], [name])


def test_a_box_has_its_closed_form_volume_centroid_and_second_moments(rotate):
    a, b, c = size = np.array([0.24, 0.115, 0.113])
    box, turn = rotate(unit_box((0.0, 0.0, 0.0), size), 33.0)
    expected = a * b * c / 12 * turn @ np.diag(size**2) @ turn.T
    assert volumes(box)[0] == pytest.approx(a * b * c, rel=1e-14)
    assert np.allclose(centroids(box)[0], turn @ (size / 2) + (0.3, -0.2, 0.7), rtol=0, atol=1e-15)
    assert np.allclose(second_moments(box)[0], expected, rtol=0, atol=1e-14 * expected.max())


@pytest.mark.parametrize("seed", range(5))
def test_a_random_polyhedron_equals_the_sum_of_the_tets_that_fill_it(hull, rotate, seed):
    points = np.random.default_rng(seed).normal(size=(12, 3))
    block, turn = rotate(hull(points), 20.0 + seed)
    corners = (points @ turn.T + (0.3, -0.2, 0.7))[Delaunay(points).simplices]
    volume = np.abs(np.linalg.det(corners[:, 1:] - corners[:, :1])) / 6
    centroid = volume @ corners.mean(axis=1) / volume.sum()
    arm = corners - centroid
    total = arm.sum(axis=1)
    outer = np.einsum("tci,tcj->tij", arm, arm) + np.einsum("ti,tj->tij", total, total)
    second = np.einsum("t,tij->ij", volume / 20, outer)
    assert volumes(block)[0] == pytest.approx(volume.sum(), rel=1e-13)
    assert np.allclose(centroids(block)[0], centroid, atol=1e-13)
    assert np.allclose(second_moments(block)[0], second, atol=1e-12 * second.max())


@pytest.mark.parametrize("degrees", [0.0, 45.0, 70.0])
def test_a_brick_is_as_wide_and_reaches_as_far_however_it_lies(rotate, degrees):
    size = np.array([0.24, 0.115, 0.113])
    both = concatenate([unit_box((0.0, 0.0, 0.0), size), unit_box((0.0, 0.0, 0.0), 2.0 * size)])
    bricks, turn = rotate(both, degrees)
    assert widths(bricks) == pytest.approx([0.113, 0.226], rel=1e-14)
    assert extents(bricks, np.array([0, 0, 1]), turn.T[[0, 2, 1]]) == pytest.approx([0.24, 0.113, 0.23], rel=1e-14)
    diagonal = (turn @ (size / np.linalg.norm(size)))[None]
    assert extents(bricks, np.array([1]), diagonal) == pytest.approx([2.0 * np.linalg.norm(size)], rel=1e-14)


def test_extents_of_many_blocks_are_those_of_each(hull, monkeypatch):
    blocks = concatenate([hull(np.random.default_rng(seed).normal(size=(9, 3))) for seed in range(7)])
    block, direction = np.array([3, 0, 6, 6, 1]), np.eye(3)[[0, 1, 2, 0, 1]]
    corners = [blocks.points[np.unique(blocks.face_points[slice(*blocks.face_start[[*ends]])])]
               for ends in zip(blocks.block_face_start[:-1], blocks.block_face_start[1:], strict=True)]  # fmt: skip
    by_hand = [np.ptp(corners[b] @ n) for b, n in zip(block, direction, strict=True)]
    for most in (measures.MOST, 50, 1):
        monkeypatch.setattr(measures, "MOST", most)
        assert extents(blocks, block, direction) == pytest.approx(by_hand, rel=1e-14), "in one go, or in several"


def test_face_vectors_of_every_closed_block_cancel(hull, rotate):
    block, _ = rotate(hull(np.random.default_rng(7).normal(size=(20, 3))), 50.0)
    area, normal, centroid = face_areas_normals_centroids(block)
    assert np.allclose(area @ normal, 0.0, atol=1e-14)
    assert area * np.einsum("fi,fi->f", normal, centroid) @ np.ones(len(area)) / 3 == pytest.approx(volumes(block)[0])


def test_concatenated_blocks_keep_their_measures_and_join_groups_by_name(hull):
    parts = [
        unit_box((0, 0, 0), (1, 2, 3)),
        hull(np.random.default_rng(1).normal(size=(9, 3))),
        unit_box((0, 0, 0), (1, 1, 1), "plates"),
    ]
    whole = concatenate(parts)
    assert whole.groups == ("units", "plates")
    assert whole.group.tolist() == [0, 0, 1]
    for measure in (volumes, centroids, second_moments):
        assert np.array_equal(measure(whole), np.concatenate([measure(part) for part in parts]))

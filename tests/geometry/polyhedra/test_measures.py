import numpy as np
import pytest
from scipy.spatial import Delaunay

from geometry.polyhedra.construct import concatenate, from_boxes
from geometry.polyhedra.measures import centroids, face_areas_normals_centroids, moments, volumes


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

"""A joint face that is an L, of two polygons with unlike points: middle, second moments, reach and strips by hand."""

from dataclasses import replace

import numpy as np
import pytest

from geometry.joints.faces.strips import of_points, spread
from geometry.joints.faces.whole_faces import middles, points_of_faces, polygons_by_face, reach_along
from geometry.joints.find import find_joints
from geometry.polyhedra.construct import from_boxes

LOW = np.array([[0.0, 0.0, -0.1], [0.0, 0.0, 0.0], [0.1, 0.0, 0.0], [0.5, 0.0, 0.0]])
HIGH = np.array([[0.8, 0.3, 0.0], [0.1, 0.3, 0.2], [0.4, 0.08, 0.2], [0.7, 0.11, 0.2]])
"""m: a slab, two boxes on it that make an L, and one apart."""


@pytest.fixture(scope="module")
def joints():
    """The boxes that make an L are one block to the slab."""
    apart = find_joints(from_boxes(LOW, HIGH, np.arange(4), np.zeros(4, dtype=int), ["units"]), "gauss", 2)
    return replace(apart, block_b=np.where((apart.block_a == 0) & (apart.block_b == 2), 1, apart.block_b))


def test_an_l_is_one_face_with_the_middle_and_second_moments_of_all_its_points(joints):
    points = points_of_faces(joints)
    ell = int(np.argmax(points.area))
    mine = points.face == ell
    area, places = joints.area[mine], joints.point[mine]
    assert area.sum() == pytest.approx(0.1 * 0.3 + 0.3 * 0.08)
    middle = (0.03 * np.array([0.05, 0.15, 0.0]) + 0.024 * np.array([0.25, 0.04, 0.0])) / 0.054
    assert points.area[ell] == pytest.approx(0.054) and points.middle[ell] == pytest.approx(middle)
    assert points.arm[mine] == pytest.approx(places - middle)
    second = sum(a * np.outer(p - middle, p - middle) for a, p in zip(area, places, strict=True))
    assert points.second[ell] == pytest.approx(second)
    boxes = ((0.03, 0.1, 0.05), (0.024, 0.3, 0.25))  # Gauss points have the second moments of their rectangles
    along_x = sum(a * (length**2 / 12.0 + (x - middle[0]) ** 2) for a, length, x in boxes)
    assert points.second[ell, 0, 0] == pytest.approx(along_x)


def test_faces_without_points_have_no_area_and_no_middle(joints):
    area, middle = middles(joints, joints.patch + 1, len(joints.patch_start) + 1)
    assert area[0] == area[-1] == 0.0 and not middle[0].any()
    assert area[1:-1].sum() == pytest.approx(joints.area.sum())


def test_a_face_has_all_its_polygons_and_strips_of_its_whole_area_and_reaches_as_far_as_its_points(joints):
    points = points_of_faces(joints)
    faces = np.unique(points.face)
    polygons = dict(zip(faces.tolist(), polygons_by_face(joints, points.whole, faces), strict=True))
    ell = int(np.argmax(points.area))
    assert sorted(map(len, polygons.values())) == [1, 1, 2] and len(polygons[ell]) == 2
    middle, (x, y) = points.middle[ell], np.eye(3)[:2]
    strips = spread(polygons[ell], x, y, middle)
    assert strips.area.sum() == pytest.approx(0.054)
    assert strips.area @ strips.place == pytest.approx(0.0, abs=1e-12), "about the middle of the points"
    mine = points.face == ell
    fibres = of_points(points.arm[mine] @ x, joints.area[mine])
    assert len(fibres.place) == 4 and fibres.area.sum() == pytest.approx(0.054)
    corners = np.concatenate(polygons[ell]) - middle
    last = 0.4 - 0.15 * (1.0 - 1.0 / np.sqrt(3.0))
    far = (last - middle[0]) / (0.4 - middle[0])
    near = 1.0 - 0.05 * (1.0 - 1.0 / np.sqrt(3.0)) / middle[0]
    for along, reach in ((-x[None], far), (x[None], near), (np.array([x, -x]), min(far, near))):
        assert reach_along(points.arm[mine], corners, along) == pytest.approx(reach)

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from geometry.blocks import GeometryError
from geometry.joints.contact_points import contact_points
from geometry.joints.find import connected, facing_pairs, find_joints
from geometry.joints.point_density import Density
from geometry.polyhedra.construct import concatenate, from_boxes, from_faces
from geometry.polyhedra.measures import centroids
from geometry.polyhedra.polygons import areas_normals_centroids
from geometry.specimens.boxes import boxes
from geometry.specimens.stacked import couplet
from geometry.specimens.wallette import wallette

WALL = {
    "courses": 4,
    "units_per_course": 2,
    "unit_length": 0.24,
    "unit_height": 0.113,
    "thickness": 0.0115,
    "joint_thickness": 0.01,
}
RULES = [("gauss", 1), ("gauss", 2), ("gauss", 3), ("vertex", 2), ("vertex", 3)]


def convex_polygon(seed):
    """Corners (n, 2) on an ellipse, counter-clockwise, no two close together."""
    random = np.random.default_rng(seed)
    gaps = random.uniform(0.3, 1.0, random.integers(3, 10))
    angle = random.uniform(0, 6) + 2 * np.pi * np.cumsum(gaps) / gaps.sum()
    return np.column_stack([np.cos(angle), 0.4 * np.sin(angle)]) * random.uniform(0.05, 2)


def patch_areas(joints):
    return np.bincount(joints.patch, joints.area, minlength=len(joints.patch_start) - 1)


@pytest.mark.parametrize(("rule", "points"), RULES)
def test_areas_of_every_joint_add_up_to_its_overlap(rule, points):
    specimen = couplet(0.2, 0.05, 0.06, (4, 2, 2), mortar=(0.01, (5, 3, 1)), plates=0.02)
    joints = find_joints(specimen.blocks, rule, points)
    unit, height = specimen.blocks.unit, centroids(specimen.blocks)[:, 2]
    upward = sorted(set(unit.tolist()), key=lambda u: height[unit == u].mean())
    sides = unit[np.stack([joints.block_a, joints.block_b])]
    for below, above in zip(upward[:-1], upward[1:], strict=True):
        for low, high, up in ((0, 1, 1), (1, 0, -1)):
            between = (sides[low] == below) & (sides[high] == above)
            assert np.all(joints.normal[between] == (0, 0, up))
        pair = (sides.min(axis=0) == min(below, above)) & (sides.max(axis=0) == max(below, above))
        assert joints.area[pair].sum() == pytest.approx(0.2 * 0.05, rel=1e-14)
    within = np.all(sides == upward[1], axis=0)
    assert joints.area[within].sum() == pytest.approx(3 * 0.05 * 0.06 + 0.2 * 0.06 + 0.2 * 0.05, rel=1e-14)


def test_faces_that_overlap_in_part_meet_on_just_the_common_rectangle():
    specimen = boxes(
        [("a", (0, 0, 0), (2, 3, 1), "g", 0, (1, 1, 1)), ("b", (1.25, -1, 1), (2, 2.5, 1), "g", 1, (1, 1, 1))], 1
    )
    joints = find_joints(specimen.blocks)
    assert np.array_equal(np.sort(joints.patch_points, axis=0)[[0, -1]], [[1.25, 0, 1], [2, 1.5, 1]])
    assert joints.area.sum() == pytest.approx(0.75 * 1.5, rel=1e-15)
    assert np.allclose(joints.area @ joints.point / joints.area.sum(), (1.625, 0.75, 1), rtol=1e-14)
    assert (joints.block_a.tolist(), joints.block_b.tolist()) == ([0] * 4, [1] * 4)
    assert set(joints.node_a) == set(joints.node_b) == {-1}


def test_bed_faces_of_undivided_running_bond_overlap_by_halves():
    specimen = wallette(**WALL)
    joints = find_joints(specimen.blocks)
    areas = patch_areas(joints)
    bed = np.abs(joints.normal[np.searchsorted(joints.patch, np.arange(len(areas)))][:, 2]) == 1
    assert np.count_nonzero(bed) == 3 * 4
    assert np.allclose(areas[bed], 0.125 * 0.0115, rtol=1e-14)
    assert np.count_nonzero(~bed) == 1 + 2 + 1 + 2
    assert np.allclose(areas[~bed], 0.123 * 0.0115, rtol=1e-14)


def test_a_plate_meets_every_cell_of_the_end():
    specimen = wallette(**WALL, divisions=(6, 4), plates=0.05)
    joints = find_joints(specimen.blocks)
    left = joints.block_b == specimen.sets["left plate"][0]
    assert sorted(set(joints.block_a[left])) == specimen.sets["left end"].tolist()
    assert joints.area[left].sum() == pytest.approx(specimen.section, rel=1e-14)
    assert np.all(joints.normal[left] == (-1, 0, 0))


def test_blocks_that_touch_along_a_line_only_have_no_joint_and_are_counted():
    specimen = couplet(0.2, 0.05, 0.05, (2, 1, 1))
    joints = find_joints(specimen.blocks)
    assert len(joints.patch_start) - 1 == 4
    assert joints.dropped == 4


@pytest.mark.parametrize("degrees", [45.0, 10.0, 123.4])
@pytest.mark.parametrize(("rule", "points"), [("gauss", 2), ("vertex", 2)])
def test_a_turned_wall_has_the_same_joints(rotate, degrees, rule, points):
    blocks = wallette(**WALL, divisions=(2, 3), plates=0.05).blocks
    straight = find_joints(blocks, rule, points)
    for axis in ((0, 0, 1), (0, 1, 0), (1, 2, 0.5)):
        turned, turn = rotate(blocks, degrees, axis)
        joints = find_joints(turned, rule, points)
        assert np.array_equal(joints.block_a, straight.block_a)
        assert np.array_equal(joints.block_b, straight.block_b)
        assert np.array_equal(joints.patch_start, straight.patch_start)
        assert np.allclose(joints.point, straight.point @ turn.T + (0.3, -0.2, 0.7), atol=1e-14)
        assert np.allclose(joints.normal, straight.normal @ turn.T, atol=1e-13)
        assert np.allclose(joints.area, straight.area, rtol=1e-12)


@settings(max_examples=80, deadline=None)
@given(st.integers(0, 10**6))
def test_points_on_random_convex_polygons_sum_to_area_and_first_moments(seed):
    flat = convex_polygon(seed)
    x, y = flat.T
    after = np.roll(flat, -1, axis=0)
    cross = x * after[:, 1] - after[:, 0] * y
    area = cross.sum() / 2
    moment = cross @ (flat + after) / 6
    turn = Rotation.random(rng=seed).as_matrix()
    for rule, points in RULES:
        polygon, point, share = contact_points(
            (flat @ turn[:, :2].T)[None], np.array([len(flat)]), Density(rule, points)
        )
        assert np.all(share > 0)
        assert share.sum() == pytest.approx(area, rel=1e-14)
        size = np.abs(flat).max() * area
        assert np.allclose(share @ point @ turn, [*moment, 0], rtol=0, atol=1e-13 * size)
        assert np.all(polygon == 0)


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 10**6))
def test_gauss_points_are_exact_for_quadratic_fields_on_random_polygons(seed):
    flat = convex_polygon(seed)
    corners = np.column_stack([flat, np.zeros(len(flat))])[None]
    _, point, share = contact_points(corners, np.array([len(flat)]), Density("gauss", 2))
    x, y = flat.T
    x2, y2 = np.roll(x, -1), np.roll(y, -1)
    second = np.sum((x * y2 - x2 * y) * (x * x + x * x2 + x2 * x2)) / 12
    assert share @ point[:, 0] ** 2 == pytest.approx(second, rel=1e-12)


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 10**6))
def test_a_prism_standing_on_many_boxes_is_carried_by_its_whole_face(prism, seed):
    flat = convex_polygon(seed)
    cuts = np.linspace(-2.5, 2.5, 8)
    i, j = (index.ravel() for index in np.indices((7, 7)))
    low = np.column_stack([cuts[i], cuts[j], np.full(49, -1.0)])
    high = np.column_stack([cuts[i + 1], cuts[j + 1], np.zeros(49)])
    floor = from_boxes(low, high, np.arange(49), np.zeros(49), ["floor"])
    blocks = concatenate([floor, from_faces([prism(flat, 0.0, 1.0)], [49], [0], ["units"])])
    area, _, centroid = areas_normals_centroids(np.column_stack([flat, np.zeros(len(flat))])[None])
    for rule in ("gauss", "vertex"):
        joints = find_joints(blocks, rule)
        on = joints.block_b == 49
        assert joints.area[on].sum() == pytest.approx(area[0], rel=1e-12)
        assert np.allclose(joints.area[on] @ joints.point[on], area[0] * centroid[0], atol=1e-12 * area[0])
        polygon_areas = [
            areas_normals_centroids(joints.patch_points[a:b][None])[0][0]
            for a, b in zip(joints.patch_start[:-1], joints.patch_start[1:], strict=True)
        ]
        assert np.allclose(patch_areas(joints), polygon_areas, rtol=1e-14)


def test_vertex_points_of_a_rectangle_are_its_corners_with_a_quarter_each():
    joints = find_joints(couplet(0.2, 0.05, 0.05).blocks, "vertex", 2)
    assert sorted(map(tuple, joints.point.tolist())) == [
        (0, 0, 0.05),
        (0, 0.05, 0.05),
        (0.2, 0, 0.05),
        (0.2, 0.05, 0.05),
    ]
    assert np.allclose(joints.area, 0.2 * 0.05 / 4, rtol=1e-15)


@settings(max_examples=40, deadline=None)
@given(st.floats(-3, 3), st.floats(-1e-10, 1e-10))
def test_faces_apart_by_rounding_meet_wherever_they_lie_and_faces_apart_by_more_do_not(place, gap):
    for distance, count in ((gap, 1), (1e-7, 0)):
        low = np.array([[place, 0, 0], [place + 1 + distance, 0.25, 0]])
        blocks = from_boxes(low, low + 1, np.arange(2), np.zeros(2), ["g"])
        joints = find_joints(blocks)
        assert len(joints.patch_start) - 1 == count
        assert joints.area.sum() == pytest.approx(0.75 * count, rel=1e-9)


@pytest.mark.parametrize("count", [1, 2])
@pytest.mark.parametrize("rule", ["gauss", "vertex"])
def test_blocks_that_stand_apart_have_no_joints(count, rule):
    low = np.array([[2.0 * k, 0, 0] for k in range(count)])
    blocks = from_boxes(low, low + 1, np.arange(count), np.zeros(count), ["g"])
    joints = find_joints(blocks, rule)
    assert len(joints.area) == joints.dropped == 0
    assert joints.patch_start.tolist() == [0]
    assert connected(blocks, joints).tolist() == list(range(count))


def test_a_wrong_rule_is_refused_with_the_allowed_ones():
    blocks = couplet(0.2, 0.05, 0.05).blocks
    with pytest.raises(GeometryError, match="'simpson' is unknown; allowed: 'gauss', 'vertex'"):
        find_joints(blocks, "simpson")
    with pytest.raises(GeometryError, match="at least 2; nearest: 2"):
        find_joints(blocks, "vertex", 1)


def test_blocks_that_hang_together_share_a_label():
    specimen = boxes(
        [
            (name, (x, 0, 0), (1, 1, 1), "g", k, (1, 1, 1))
            for k, (name, x) in enumerate([("a", 0), ("b", 1), ("c", 3), ("d", 4)])
        ],
        1.0,
    )
    labels = connected(specimen.blocks, find_joints(specimen.blocks))
    assert labels[0] == labels[1] != labels[2] == labels[3]


def test_oblique_faces_that_look_along_two_axes_or_three_are_found_once():
    straight = couplet(0.2, 0.05, 0.06, (2, 1, 2)).blocks
    for way in ([1.0, 1.0, 0.0], [1.0, 1.0, 1.0]):
        turn = Rotation.align_vectors([way], [[0.0, 0.0, 1.0]])[0].as_matrix()
        turned = replace(straight, points=straight.points @ turn.T)
        pairs = list(zip(*(side.tolist() for side in facing_pairs(turned, 1e-9)), strict=True))
        assert pairs == sorted(set(pairs))
        assert set(zip(*(side.tolist() for side in facing_pairs(straight, 1e-9)), strict=True)) <= set(pairs)

"""Contact points of two faces: their areas add up to the overlap, and their middle is its centroid."""

import numpy as np
import pytest
from scipy.spatial import ConvexHull, HalfspaceIntersection
from scipy.spatial.transform import Rotation

from masonry.detection.narrow import FACE
from tests.detection.touching import Bodies, boxes, cells, random_turn, turn


def moment(contact) -> np.ndarray:
    return contact.area @ contact.point


@pytest.mark.parametrize(
    ("shift", "spin", "area", "middle"),
    [
        ((0.0, 0.0), 0.0, 1.0, (0.0, 0.0)),
        ((0.3, 0.0), 0.0, 0.7, (0.15, 0.0)),
        ((0.5, -0.25), 0.0, 0.375, (0.25, -0.125)),
        ((0.0, 0.0), np.pi / 4, 2 * (np.sqrt(2) - 1), (0.0, 0.0)),
        ((0.0, 0.0), np.pi / 6, 2 * (1 - 1 / np.sqrt(3)), (0.0, 0.0)),
        ((np.sqrt(0.5), 0.0), np.pi / 4, 0.25, (0.5 - 1 / 6, 0.0)),  # a corner as far in as half a side
    ],
)
def test_squares_on_each_other_share_the_area_of_the_closed_form(shift, spin, area, middle):
    stack = boxes(([-0.5, -0.5, -1], [0.5, 0.5, 0]), ([-0.5, -0.5, 0], [0.5, 0.5, 1]))
    contact = stack.put(1, [*shift, 0.499], turn(0, 0, spin)).touch()
    assert contact.kind == FACE and np.all(contact.area >= 0)
    assert contact.area.sum() == pytest.approx(area, rel=1e-12)
    assert moment(contact)[:2] / area == pytest.approx(middle, abs=1e-12)
    assert np.allclose(contact.gap, -0.001, atol=1e-12) and np.allclose(contact.point[:, 2], -0.0005, atol=1e-12)
    assert contact.size == pytest.approx(0.1 * np.sqrt(area))  # n is the mean of both normals


def test_random_cells_share_what_a_slow_intersection_of_half_planes_says():
    blocks, rng, seen = cells(30, 4), np.random.default_rng(6), 0
    for _ in range(80):
        bodies, (i, j) = Bodies(blocks), rng.choice(30, 2, replace=False)
        way = rng.normal(size=3)
        bodies.put(i, np.zeros(3), random_turn(rng)).put(j, 0.2 * way / np.linalg.norm(way), random_turn(rng))
        contact = bodies.touch(i, j)
        if contact.kind != FACE:
            continue
        loops = [projected(bodies, f, b, contact.axis) for f, b in zip(contact.witness[1:], (i, j), strict=True)]
        area, centroid = slow_overlap(*loops)
        across = basis(contact.axis)
        assert contact.area.sum() == pytest.approx(area, rel=1e-9)
        assert moment(contact) @ across / area == pytest.approx(centroid, abs=1e-9)
        assert np.all(contact.area >= 0)
        seen += 1
    assert seen >= 40


def basis(axis: np.ndarray) -> np.ndarray:
    return np.linalg.svd(axis[None])[2][1:].T


def projected(bodies: Bodies, face: int, body: int, axis: np.ndarray) -> np.ndarray:
    start = bodies.pieces.loop_start
    corners = bodies.turned.vertex[bodies.pieces.loop[start[face] : start[face + 1]]] + bodies.position[body]
    return corners @ basis(axis)


def slow_overlap(one: np.ndarray, two: np.ndarray) -> tuple[float, np.ndarray]:
    """Area and centroid of what two convex polygons of a plane share, by scipy."""
    from scipy.optimize import linprog

    planes = np.concatenate([ConvexHull(one).equations, ConvexHull(two).equations])
    inner = linprog([0, 0, -1], np.c_[planes[:, :2], np.ones(len(planes))], -planes[:, 2], bounds=[(None, None)] * 3)
    points = HalfspaceIntersection(planes, inner.x[:2]).intersections
    points = points[ConvexHull(points).vertices] - inner.x[:2]
    after = np.roll(points, -1, axis=0)
    part = (points[:, 0] * after[:, 1] - points[:, 1] * after[:, 0]) / 2
    return part.sum(), inner.x[:2] + part @ (points + after) / 3 / part.sum()


@pytest.mark.parametrize("seam", [0.2, 0.5, 0.4999999, 1e-7])
def test_two_neighbours_in_one_plane_share_what_one_whole_block_would(seam):
    """Sums of area and first moment, also where the seam leaves a sliver of the block above."""
    way, shift = Rotation.from_rotvec([0.4, -0.3, 0.9]).as_matrix(), np.array([3.0, -1.0, 2.0])
    block = [0.0, 0.1, 1], [1.0, 0.9, 1.5]
    whole = boxes(([-1, 0, 0], [2, 1, 1]), block).move(way, shift).touch()
    halves = boxes(([-1, 0, 0], [seam, 1, 1]), ([seam, 0, 0], [2, 1, 1]), block).move(way, shift)
    parts = [halves.touch(p, 2) for p in (0, 1)]
    assert sum(part.area.sum() for part in parts) == pytest.approx(whole.area.sum(), rel=1e-12)
    assert np.allclose(sum(moment(part) for part in parts), moment(whole), rtol=1e-12, atol=1e-12)
    assert all(np.allclose(part.axis, whole.axis, atol=1e-12) for part in parts if part.kind)


def test_a_block_that_touches_only_along_a_line_has_no_area_there():
    beside = boxes(([0, 0, 0], [1, 1, 1]), ([1, 0, 1], [2, 1, 2]))
    assert beside.touch(skin=0.1).area.sum() <= 1e-12


def test_the_overlap_is_cut_where_the_gap_is_wider_than_the_reach_and_keeps_the_least_area():
    tilt, reach = 0.1, 0.02
    rocking = boxes(([-9, -9, 0], [9, 9, 1]), ([0, 0, 1], [1, 0.5, 2]))
    hinge = np.array([1.0, 0.25, 1.0])
    rocking.put(1, hinge + turn(0, tilt, 0) @ ([0.5, 0.25, 1.5] - hinge), turn(0, tilt, 0))
    cut = rocking.touch(reach=reach, least=1e-9)
    assert cut.area.sum() == pytest.approx(0.5 * reach / np.tan(tilt), rel=1e-9)
    assert sorted(cut.gap) == pytest.approx([0, 0, reach, reach], abs=1e-12)
    assert cut.size == pytest.approx(np.sqrt(0.5 * np.cos(tilt)))
    assert rocking.touch(reach=0.002).size == pytest.approx(0.1)  # a motion of half the reach calls for a new clip
    kept = rocking.touch(reach=reach, least=0.2)
    assert kept.area.sum() == pytest.approx(0.2) and np.allclose(kept.point, cut.point)
    flat = boxes(([-9, -9, 0], [9, 9, 1]), ([0, 0, 1], [0.1, 0.1, 2])).touch(reach=reach, least=0.2)
    assert flat.area.sum() == pytest.approx(0.01)  # of an overlap that is not cut nothing is added


def test_a_corner_on_a_floor_is_the_only_point_that_is_not_open():
    brick = boxes(([-9, -9, -1], [9, 9, 0]), ([0, 0, 0], [0.24, 0.115, 0.06]))
    frame = Rotation.from_euler("xyz", [20, 35, 30], degrees=True).as_matrix()
    brick.put(1, [0, 0, 1], frame)
    brick.put(1, [0, 0, 1 - brick.corners(1)[:, 2].min() - 1e-4], frame)
    contact = brick.touch(reach=1e-3, least=1e-4)
    assert np.sum(contact.gap < 0) == 1 and contact.gap.min() == pytest.approx(-1e-4, abs=1e-12)
    assert np.allclose(contact.axis, [0, 0, 1], atol=1e-12)
    lowest = brick.corners(1)[np.argmin(brick.corners(1)[:, 2])]
    assert np.allclose(contact.point[np.argmin(contact.gap)], lowest + [0, 0, 5e-5], atol=1e-12)


def test_corners_nearer_than_a_hair_become_one_and_the_sums_stay():
    stack = boxes(([0, 0, 0], [1, 1, 1]), ([0, 0, 1], [1, 1, 2]))
    contact = stack.put(1, [0.5 + 1e-6, 0.5 - 2e-6, 1.5], turn(1e-6, 0, 0)).touch()
    assert len(contact.area) == 4
    assert contact.area.sum() == pytest.approx(1.0, abs=4e-6)
    more = stack.put(1, [0.5, 0.5, 1.5], turn(0, 0, 0.01)).touch()
    assert len(more.area) == 8 and len(set(more.feature)) == 8


def test_names_of_points_stay_while_a_block_slides():
    stack = boxes(([0, 0, 0], [1, 1, 1]), ([0, 0, 1], [1, 1, 2]))
    first = stack.put(1, [0.7, 0.65, 1.5]).touch()
    again = stack.put(1, [0.71, 0.66, 1.4999]).touch(witness=first.witness)
    assert len(first.feature) == 4 and np.array_equal(first.feature, again.feature)

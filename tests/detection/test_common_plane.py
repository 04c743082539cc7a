"""The common plane against the Minkowski difference of scipy, its symmetry, and what does not depend on the place."""

import numpy as np
import pytest
from scipy.spatial import ConvexHull

from masonry.detection.narrow import EDGE, FACE, FLAT, HOLD, NONE
from tests.detection.touching import Bodies, box_blocks, boxes, cells, random_turn, subset, turn


def facets(bodies: Bodies) -> tuple[np.ndarray, np.ndarray]:
    """Unit normals from body 0 to body 1 and the gap along each: the facets of the Minkowski difference."""
    a, b = bodies.corners(0), bodies.corners(1)
    hull = ConvexHull((a[:, None] - b[None]).reshape(-1, 3))
    return hull.equations[:, :3], hull.equations[:, 3]


def push_together(bodies, i: int, j: int, way: np.ndarray, gap: float) -> None:
    """Body j shifted along a way so that the widest gap of the pair is as asked, by bisection."""
    normal, start = facets(bodies)
    low, high = -5.0, 5.0
    for _ in range(60):
        far = (low + high) / 2
        low, high = (low, far) if (start + far * normal @ way).max() > gap else (far, high)
    bodies.put(j, bodies.position[j] + far * way)


def pairs_of_boxes(count: int):
    rng = np.random.default_rng(1)
    for _ in range(count):
        size = rng.uniform(0.2, 1.0, (2, 3))
        bodies = Bodies(box_blocks(-size / 2, size / 2)).put(0, np.zeros(3), random_turn(rng))
        bodies.put(1, np.zeros(3), random_turn(rng))
        way = rng.normal(size=3)
        push_together(bodies, 0, 1, way / np.linalg.norm(way), rng.uniform(-0.05, 0.02))
        yield bodies


def pairs_of_cells(count: int):
    blocks, rng = cells(40, 2), np.random.default_rng(3)
    for _ in range(count):
        i, j = sorted(rng.choice(40, 2, replace=False))
        bodies = Bodies(subset(blocks, (i, j)))
        bodies.put(0, np.zeros(3), random_turn(rng)).put(1, np.zeros(3), random_turn(rng))
        way = rng.normal(size=3)
        push_together(bodies, 0, 1, way / np.linalg.norm(way), rng.uniform(-0.02, 0.01))
        yield bodies


@pytest.mark.parametrize("pairs", [pairs_of_boxes, pairs_of_cells])
def test_the_axis_is_that_of_least_overlap_of_the_minkowski_difference(pairs):
    kinds = []
    for bodies in pairs(150):
        normal, gap = facets(bodies)
        contact = bodies.touch()
        best = gap.max()
        kinds.append(contact.kind)
        assert contact.separation <= best + 1e-9
        assert (contact.separation > 0) <= (best > 0)
        room = HOLD * abs(contact.separation) + 1e-8
        if contact.kind == EDGE:  # the axis itself is a facet of the difference
            assert contact.separation >= best - room
            assert contact.separation == pytest.approx(gap[np.argmax(normal @ contact.axis)], abs=1e-9)
        elif contact.kind == FACE and best < 0:
            # better axes may only be of edges that nearly lie in both faces: a corner of the overlap is as deep as they
            beyond = gap[normal @ contact.axis < FLAT - 1e-6].max()
            assert contact.separation >= beyond - room or contact.gap.min() >= best - HOLD * abs(best)
    assert kinds.count(EDGE) >= 5 and kinds.count(FACE) >= 25


@pytest.mark.parametrize("pairs", [pairs_of_boxes, pairs_of_cells])
def test_the_exchanged_pair_gives_the_same_bits(pairs):
    for bodies in pairs(60):
        one, two = bodies.touch(0, 1, reach=0.02), bodies.touch(1, 0, reach=0.02)
        assert one.kind == two.kind and one.separation == two.separation
        assert np.array_equal(one.axis, -two.axis)
        for name in ("point", "gap", "area", "feature"):
            assert np.array_equal(getattr(one, name), getattr(two, name))
        assert one.blend + two.blend == pytest.approx(1.0, abs=1e-15)
        assert one.witness[0] == two.witness[0] and tuple(one.witness[1:]) == tuple(two.witness[:0:-1])


@pytest.mark.parametrize("pairs", [pairs_of_boxes, pairs_of_cells])
def test_what_was_found_before_gives_the_same_answer_at_once(pairs):
    for bodies in pairs(60):
        first = bodies.touch(reach=0.02)
        again = bodies.touch(reach=0.02, witness=first.witness)
        assert again.kind == first.kind and np.array_equal(again.witness, first.witness)
        assert np.array_equal(again.point, first.point) and np.array_equal(again.area, first.area)


def test_nothing_depends_on_where_the_bodies_are_and_how_all_are_turned():
    rng = np.random.default_rng(5)
    for bodies in pairs_of_boxes(40):
        first = bodies.touch(reach=0.05)
        way, shift = random_turn(rng), 1000.0 * rng.normal(size=3)
        bodies.move(way, shift)
        again = bodies.touch(reach=0.05)
        assert again.kind == first.kind and np.array_equal(np.sort(again.feature), np.sort(first.feature))
        assert np.allclose(again.axis, way @ first.axis, atol=1e-9)
        assert np.allclose(again.point, first.point @ way.T + shift, atol=1e-9)
        assert np.allclose(again.gap, first.gap, atol=1e-9) and np.allclose(again.area, first.area, atol=1e-9)


def test_blocks_of_one_size_share_the_mean_of_their_normals_and_a_floor_keeps_its_own():
    tilt = 0.05
    equal = boxes(([0, 0, 0], [1, 1, 1]), ([0, 0, 1], [1, 1, 2]))
    hinge, centre = np.array([1.0, 0.5, 1.0]), np.array([0.5, 0.5, 1.5])
    equal.put(1, hinge + turn(0, tilt, 0) @ (centre - hinge), turn(0, tilt, 0))
    half = np.array([np.sin(tilt / 2), 0, np.cos(tilt / 2)])
    assert np.allclose(equal.touch().axis, half, atol=1e-9)
    floor = boxes(([-9, -9, 0], [9, 9, 1]), ([0, 0, 1], [1, 1, 2]))
    floor.put(1, hinge + turn(0, tilt, 0) @ (centre - hinge), turn(0, tilt, 0))
    contact = floor.touch()
    assert np.allclose(contact.axis, [0, 0, 1], atol=1e-12) and contact.blend == 1.0
    assert sorted(contact.gap) == pytest.approx([0, 0, np.sin(tilt), np.sin(tilt)], abs=1e-12)


def test_crossed_edges_give_one_point_with_the_area_that_was_given():
    bars = boxes(([-3, -0.5, -0.5], [3, 0.5, 0.5]), ([-0.5, -3, -0.5], [0.5, 3, 0.5]))
    high = np.sqrt(2) - 0.01
    bars.put(0, np.zeros(3), turn(np.pi / 4, 0, 0)).put(1, [0.1, 0.2, high], turn(0, np.pi / 4, 0))
    contact = bars.touch(least=0.0025)
    assert contact.kind == EDGE and len(contact.gap) == 1
    assert np.allclose(contact.axis, [0, 0, 1], atol=1e-12)
    assert contact.gap[0] == pytest.approx(-0.01, abs=1e-12) and contact.area[0] == 0.0025
    assert np.allclose(contact.point[0], [0.1, 0.0, high / 2], atol=1e-12)
    still = bars.touch(witness=contact.witness)
    assert still.kind == EDGE and np.array_equal(still.witness, contact.witness)


def test_pieces_beyond_the_skin_or_beside_each_other_do_not_touch():
    apart = boxes(([0, 0, 0], [1, 1, 1]), ([0, 0, 1.1], [1, 1, 2]))
    assert apart.touch(skin=0.09).kind == NONE and apart.touch(skin=0.11).kind == FACE
    corner = boxes(([0, 0, 0], [1, 1, 1]), ([1.01, 0, 1.02], [2, 1, 2]))
    contact = corner.touch(skin=0.1)
    assert contact.kind == NONE and contact.separation == pytest.approx(0.02)

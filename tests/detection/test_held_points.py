"""Points that are held: they follow both bodies, and say when their pair must be looked at again."""

import numpy as np
import pytest

from masonry.detection.narrow import MOVED
from masonry.detection.placing import cofactor
from masonry.detection.tracking import hold_axis, hold_points, present_pairs, quiet_distance
from tests.detection.touching import Bodies, boxes, random_turn, turn


class Held:
    """One pair as a time loop holds it."""

    def __init__(self, bodies: Bodies, **how) -> None:
        self.bodies, self.first = bodies, bodies.touch(**how)
        count = len(self.first.gap)
        self.arms = np.zeros((count, 3)), np.zeros((count, 3))
        self.normals, cof = (np.zeros((1, 3)), np.zeros((1, 3))), self.cofactors()
        hold_points(
            self.first.point,
            self.first.gap,
            count,
            self.first.axis,
            0,
            1,
            bodies.position,
            bodies.frame,
            cof,
            *self.arms,
        )
        frame = bodies.frame
        hold_axis(bodies.pieces, self.first.witness, self.first.axis, frame[0], frame[1], *(n[0] for n in self.normals))

    def cofactors(self) -> np.ndarray:
        cof = np.zeros_like(self.bodies.frame)
        for k, frame in enumerate(self.bodies.frame):
            cofactor(frame, cof[k])
        return cof

    def now(self):
        """Normal, points, gaps, and whether the pair is stale."""
        count, one = len(self.first.gap), np.ones(1, dtype=np.int64)
        axis, point, gap, stale = np.zeros((1, 3)), np.zeros((count, 3)), np.zeros(count), np.zeros(1, dtype=bool)
        bodies, blend, size = self.bodies, np.array([self.first.blend]), np.array([self.first.size])
        told = present_pairs(
            0 * one, one, 0 * one, count * one, *self.normals, blend, size,
            *self.arms, self.first.gap, bodies.position, bodies.frame, self.cofactors(), axis, point, gap, stale,
        )  # fmt: skip
        assert told == stale[0]
        return axis[0], point, gap, bool(stale[0])


def stack() -> Bodies:
    return boxes(([0, 0, 0], [1, 1, 1]), ([0.3, 0.2, 1.001], [1.3, 1.2, 2]))


def test_bodies_that_move_as_one_keep_their_gaps():
    held, rng = Held(stack()), np.random.default_rng(1)
    for _ in range(5):
        way, shift = random_turn(rng), 100 * rng.normal(size=3)
        before = held.now()
        held.bodies.move(way, shift)
        axis, point, gap, stale = held.now()
        assert not stale and np.allclose(gap, held.first.gap, atol=1e-12)
        assert np.allclose(axis, way @ before[0], atol=1e-13)
        assert np.allclose(point, before[1] @ way.T + shift, atol=1e-11)


def test_held_gaps_are_those_that_detection_finds_while_the_pair_hardly_moves():
    bodies = boxes(([-9, -9, 0], [9, 9, 1]), ([0, 0, 1], [1, 1, 2]))
    held = Held(bodies.put(1, frame=turn(0.01, 0.02, 0.0)))
    assert held.first.blend == 1.0
    bodies.put(1, bodies.position[1] + [0.002, -0.001, 0.0005], turn(0.011, 0.018, 0.0))
    axis, point, gap, stale = held.now()
    again = bodies.touch(witness=held.first.witness)
    order = [np.argmin(np.linalg.norm(again.point - p, axis=1)) for p in point]
    assert not stale and sorted(order) == [0, 1, 2, 3]
    assert np.allclose(gap, again.gap[order], atol=1e-12) and np.allclose(axis, again.axis, atol=1e-12)
    assert np.allclose(point, again.point[order], atol=0.0025)  # midway between two points that slid apart


def test_a_pair_is_stale_when_it_slid_turned_or_tilted_by_a_share_of_its_patch():
    size = Held(stack()).first.size
    corner = 0.5 * np.hypot(0.7, 0.8)  # from the middle of the patch
    far = MOVED * size
    for frame, shift in ((np.eye(3), [far, 0, 0]), (np.eye(3), [0, 0, far]), (turn(0, 0, far / corner), [0, 0, 0])):
        for share in (0.95, 1.05):
            held = Held(stack())
            middle = np.array([0.65, 0.6, 1.0])
            small = turn(*(share * rotation(frame)))
            held.bodies.put(1, middle + small @ (held.bodies.position[1] - middle) + share * np.array(shift), small)
            assert held.now()[3] == (share > 1)


def rotation(frame: np.ndarray) -> np.ndarray:
    from scipy.spatial.transform import Rotation

    return Rotation.from_matrix(frame).as_rotvec()


def test_the_normal_of_blocks_of_one_size_turns_with_the_mean_of_both():
    held = Held(boxes(([0, 0, 0], [1, 1, 1]), ([0, 0, 1], [1, 1, 2])))
    held.bodies.put(1, frame=turn(0, 0.008, 0))
    assert np.allclose(held.now()[0], [np.sin(0.004), 0, np.cos(0.004)], atol=1e-9)


def test_crossed_edges_and_affine_blocks_are_held_too():
    bars = boxes(([-3, -0.5, -0.5], [3, 0.5, 0.5]), ([-0.5, -3, -0.5], [0.5, 3, 0.5]))
    bars.put(0, np.zeros(3), turn(np.pi / 4, 0, 0)).put(1, [0.1, 0.2, np.sqrt(2) - 0.01], turn(0, np.pi / 4, 0))
    held = Held(bars)
    way = turn(0.4, 0.2, 0.1)
    held.bodies.move(way, np.ones(3))
    assert np.allclose(held.now()[0], way[:, 2], atol=1e-12) and held.now()[2] == pytest.approx(-0.01, abs=1e-12)
    affine = Held(stack())
    strain = np.array([[1.001, 0.002, 0.003], [0.0, 0.999, 0.001], [0.0, 0.001, 1.002]])
    affine.bodies.put(0, frame=strain)
    axis, point, gap, _ = affine.now()
    one, two = affine.arms[0] @ strain.T + affine.bodies.position[0], affine.arms[1] + affine.bodies.position[1]
    across = np.cross(strain[:, 0], strain[:, 1])
    mean = across + [0, 0, 1]
    assert np.allclose(axis, mean / np.linalg.norm(mean), atol=1e-14)
    assert np.allclose(point, (one + two) / 2, atol=1e-14) and np.allclose(gap, (two - one) @ axis, atol=1e-14)


def test_normals_of_affine_blocks_stay_across_their_faces():
    bodies, strain = stack(), np.array([[1.3, 0.4, 0.0], [0.1, 0.8, -0.3], [0.2, 0.0, 1.1]])
    bodies.put(0, frame=strain)
    pieces, turned = bodies.pieces, bodies.turned
    for f in range(6):
        corners = turned.vertex[pieces.loop[pieces.loop_start[f] : pieces.loop_start[f + 1]]]
        assert np.allclose(corners @ turned.normal[f], turned.offset[f], atol=1e-14)
        assert np.linalg.norm(turned.normal[f]) == pytest.approx(1.0, abs=1e-15)
        assert turned.normal[f] @ turned.centre[0] < turned.offset[f]


def test_pieces_that_touch_nowhere_wait_for_their_distance_or_a_share_of_the_skin():
    assert quiet_distance(0.003, 0.01) == 0.003 and quiet_distance(-0.5, 0.01) == pytest.approx(1e-4)

"""Shear tractions that go over to another patch: they turn with the normal, and never gain energy."""

import numpy as np
import pytest
from scipy.spatial import ConvexHull

from masonry.detection.transfer import energy, transfer, turn_tractions
from tests.detection.touching import boxes, random_turn, turn

UP = np.array([0.0, 0.0, 1.0])
SCRATCH = boxes(([0, 0, 0], [1, 1, 1])).scratch


class Patch:
    """A flat polygon (n, 2) with the points that detection gives it, turned by `way`."""

    def __init__(self, corners: np.ndarray, way=None, scale: float = 1.0) -> None:
        after = np.roll(corners, -1, axis=0)
        self.area, centroid = measure(corners)
        triangle = [cross(p - centroid, q - centroid) / 2 for p, q in zip(corners, after, strict=True)]
        self.area = scale * (np.array(triangle) + np.roll(triangle, 1)) / 2
        self.way = np.eye(3) if way is None else way
        self.point = np.c_[corners, np.zeros(len(corners))] @ self.way.T
        self.feature = np.arange(len(corners))

    @property
    def axis(self):
        return self.way @ UP


def cross(a, b) -> float:
    return a[0] * b[1] - a[1] * b[0]


def measure(corners):
    after = np.roll(corners, -1, axis=0)
    part = (corners[:, 0] * after[:, 1] - corners[:, 1] * after[:, 0]) / 2
    return part.sum(), part @ (corners + after) / 3 / part.sum()


def carried(old: Patch, tau: np.ndarray, new: Patch):
    """Tractions of the new points, and the loss."""
    new_tau = np.zeros((len(new.area), 3))
    loss = transfer(
        old.point, old.area, old.feature, tau, len(old.area),
        new.point, new.area, new.feature + 100, new_tau, len(new.area), new.axis, SCRATCH,
    )  # fmt: skip
    return new_tau, loss


def tangent(rng, patch: Patch) -> np.ndarray:
    return np.c_[rng.normal(size=(len(patch.area), 2)), np.zeros(len(patch.area))] @ patch.way.T


def random_polygon(rng) -> np.ndarray:
    """Convex, up to 4 corners (room of a pair of boxes), some of them slivers."""
    points = rng.normal(size=(4, 2)) * [1, rng.choice([1.0, 0.1, 1e-4])] @ turn(0, 0, rng.uniform(0, 6))[:2, :2]
    return points[ConvexHull(points).vertices] + 0.5 * rng.normal(size=2)


def square(x: float = 0.0, y: float = 0.0) -> np.ndarray:
    return np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]]) + [x, y]


def losses(made: type[Patch], rng, count: int) -> list[float]:
    """Of random patches that become others, over the energy before: never below 0, and as `transfer` says."""
    lost = []
    for _ in range(count):
        way, first = random_turn(rng), random_polygon(rng)
        second = random_polygon(rng) if rng.random() < 0.5 else first + 0.02 * rng.normal(size=2)
        old, new = (made(corners, way, rng.uniform(1, 3)) for corners in (first, second))
        tau = tangent(rng, old)
        if rng.random() < 0.5:
            tau[:] = tau[0]
        shear, loss = carried(old, tau, new)
        before, after = (np.sum(a * np.sum(t**2, axis=1)) / 2 for a, t in ((old.area, tau), (new.area, shear)))
        assert after <= before * (1 + 1e-12)
        assert loss == pytest.approx(before - after, abs=1e-12 * before)
        lost.append(loss / before)
    return lost


def test_random_patches_never_gain_energy():
    lost = losses(Patch, np.random.default_rng(1), 600)
    assert min(lost) >= -1e-12 and max(lost) > 0.99 and min(lost) < 0.3


def test_force_is_kept_where_the_new_patch_covers_the_old_one_and_lost_with_area_that_goes():
    rng = np.random.default_rng(2)
    old = Patch(square())
    tau = tangent(rng, old)
    wide = Patch(2 * square() - 0.4)
    assert wide.area @ carried(old, tau, wide)[0] == pytest.approx(old.area @ tau, abs=1e-12)
    even = np.tile([3.0, -1.0, 0.0], (4, 1))
    for slid in (0.0, 0.01, 0.3):
        new = Patch(np.clip(square(slid), 0, 1))
        shear, loss = carried(old, even, new)
        assert np.allclose(shear, even, atol=1e-12)  # an even traction stays even
        assert loss == pytest.approx(5.0 * slid, abs=1e-12)


def test_the_same_points_keep_every_bit():
    old, rng = Patch(square()), np.random.default_rng(3)
    tau, shear = tangent(rng, old), np.zeros((4, 3))
    same = old.point + 0.01, old.area, old.feature, shear, 4, UP, SCRATCH
    assert transfer(old.point, old.area, old.feature, tau, 4, *same) == 0.0 and np.array_equal(shear, tau)


def test_the_same_region_under_other_names_changes_nothing():
    old, rng = Patch(square()), np.random.default_rng(4)
    tau = tangent(rng, old)
    shear, loss = carried(old, tau, old)
    assert np.allclose(shear, tau, atol=1e-14) and loss == pytest.approx(0.0, abs=1e-14)


def test_a_single_point_takes_and_gives_what_its_area_can_hold():
    rng = np.random.default_rng(5)
    old, one = Patch(square()), Patch(square())
    one.point, one.area, one.feature = one.point[:1], np.array([0.2]), one.feature[:1]
    tau = tangent(rng, old)
    down, loss = carried(old, tau, one)
    assert loss >= 0 and np.allclose(down[0], tau.mean(axis=0))
    up, more = carried(one, down, old)
    assert more >= 0 and np.allclose(old.area @ up, 0.2 * down[0])


def test_tractions_turn_with_the_normal_and_keep_their_norm():
    rng = np.random.default_rng(6)
    for _ in range(50):
        way, tilt = random_turn(rng), turn(*(0.3 * np.r_[rng.normal(size=2), 0]))
        old, new = way @ UP, way @ tilt @ UP
        tau = np.c_[rng.normal(size=(5, 2)), np.zeros(5)] @ way.T
        before, spin = tau.copy(), rng.uniform(-3, 3)
        turn_tractions(tau, 5, old, new, spin)
        assert np.allclose(tau @ new, 0, atol=1e-14)
        assert np.allclose(np.linalg.norm(tau, axis=1), np.linalg.norm(before, axis=1), rtol=1e-14)
        assert np.allclose(tau, before @ (turn(*(spin * new)) @ way @ tilt @ way.T).T, atol=1e-13)


def test_tractions_begin_anew_where_the_normal_turns_over():
    """What has gone through another block meets it from its far side: no rotation from n to -n is the least."""
    for tilt in (0.0, 1e-9, 0.1):
        tau = np.array([[3.0, 4.0, 0.0], [1.0, 0.0, 0.0]])
        turn_tractions(tau, 2, UP, -turn(tilt, 0.0, 0.0) @ UP, 0.0)
        assert np.array_equal(tau, np.zeros((2, 3)))


def test_the_energy_is_that_of_the_tractions():
    assert energy(np.array([2.0, 1.0]), np.array([[3.0, 0, 0], [0, 4, 0]]), 2) == 17.0

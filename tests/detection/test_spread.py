"""Points inside a patch: they carry its area, its moments and its gaps, and pass on shear without gaining energy."""

import numpy as np
import pytest

from masonry.detection.features import INNER
from masonry.detection.spread import AT_CORNERS, rounds_of, spread, spread_in_rounds
from tests.detection.test_history import Patch, carried, losses, measure, random_polygon, square

SLOPE = np.array([2e-4, -1e-4, 3e-4])


class Spread(Patch):
    """A patch with points inside; gaps are linear over it."""

    def __init__(self, corners, way=None, scale: float = 1.0) -> None:
        super().__init__(corners, way, scale)
        n = len(self.area)
        self.point = np.vstack([self.point, np.zeros((n, 3))])
        self.gap = self.point @ SLOPE
        self.area, self.feature = np.r_[self.area, np.zeros(n)], np.r_[self.feature, np.zeros(n, dtype=int)]
        assert spread(self.point, self.gap, self.area, self.feature, n) == 2 * n


class InRounds(Patch):
    """A patch with `along` points along its edges."""

    def __init__(self, corners, along: int, scale: float = 1.0) -> None:
        super().__init__(corners, None, scale)
        n, m = len(self.area), along // 2
        self.point = np.vstack([self.point, np.zeros(((m - 1) * n, 3))])
        self.gap = self.point @ SLOPE
        self.area = np.r_[self.area, np.zeros((m - 1) * n)]
        self.feature = np.r_[self.feature, np.zeros((m - 1) * n, dtype=int)]
        assert spread_in_rounds(self.point, self.gap, self.area, self.feature, n, rounds_of(along)) == m * n


def polar(corners) -> float:
    """Second moment of a polygon about its centroid, by the corners of its triangles."""
    centroid = measure(corners)[1]
    a = corners - centroid
    b = np.roll(a, -1, axis=0)
    triangle = (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) / 2
    return float(triangle @ (a * a + a * b + b * b).sum(axis=1)) / 6


def test_area_first_moment_and_polar_moment_are_those_of_the_polygon():
    rng = np.random.default_rng(2)
    for _ in range(300):
        corners = random_polygon(rng)
        area, centroid = measure(corners)
        patch = Spread(corners, scale=1.7)
        from_middle = patch.point[:, :2] - centroid
        size = np.abs(from_middle).max()
        assert patch.area.min() > 0.0 and patch.area.sum() == pytest.approx(1.7 * area, rel=1e-12)
        assert patch.area @ from_middle == pytest.approx([0.0, 0.0], abs=1e-11 * area * size)
        assert patch.area @ (from_middle**2).sum(axis=1) == pytest.approx(1.7 * polar(corners), rel=1e-9)


@pytest.mark.parametrize("corners", [square(), square()[:3], square() @ np.array([[3.0, 0.4], [-0.2, 0.5]])])
def test_of_triangles_and_parallelograms_the_moments_about_all_axes_are_exact(corners):
    """A triangle (a, b, c) from its middle: A/12 sum r r^T; a parallelogram of edges e, f: A/12 (e e^T + f f^T)."""
    area, centroid = measure(corners)
    edges = corners - centroid if len(corners) == 3 else np.array([corners[1] - corners[0], corners[3] - corners[0]])
    patch = Spread(corners)
    arm = patch.point[:, :2] - centroid
    assert (patch.area[:, None] * arm).T @ arm == pytest.approx(area / 12.0 * edges.T @ edges, rel=1e-12)


def test_corners_keep_their_places_and_a_share_and_gaps_stay_linear():
    patch = Spread(random_polygon(np.random.default_rng(3)))
    n = len(patch.area) // 2
    assert patch.area[:n] / (patch.area[:n] + patch.area[n:]) == pytest.approx(np.full(n, AT_CORNERS), rel=1e-12)
    assert patch.gap == pytest.approx(patch.point @ SLOPE, abs=1e-16)
    assert np.array_equal(patch.feature[n:], INNER + patch.feature[:n])


def test_random_spread_patches_never_gain_energy_and_report_what_they_lose():
    lost = losses(Spread, np.random.default_rng(4), 300)
    assert min(lost) >= -1e-12 and max(lost) > 0.99 and min(lost) < 0.3


def test_an_even_traction_goes_over_whole_to_a_patch_within_and_corners_pass_nothing_inwards():
    old, new = Spread(square()), Spread(0.5 * square() + 0.2)
    even = np.tile([2.0, 1.0, 0.0], (8, 1))
    shear, _ = carried(old, even, new)
    assert shear == pytest.approx(even, rel=1e-12)
    at_corners = even * (np.arange(8) < 4)[:, None]
    shear, _ = carried(old, at_corners, new)
    assert shear == pytest.approx(at_corners, rel=1e-12)


@pytest.mark.parametrize("along", [4, 10, 20])
def test_in_rounds_a_rectangle_has_the_points_of_gauss_and_lobatto_along_each_edge(along):
    """Even powers up to 2 along - 4 of the distance from the middle are integrated exactly, along both edges."""
    sides = np.array([3.0, 0.7])
    patch = InRounds(square() @ np.diag(sides), along)
    arm = (patch.point[:, :2] - patch.point[:, :2].mean(axis=0)) / (0.5 * sides)
    assert np.unique(patch.feature // INNER).tolist() == list(range(along // 2))
    assert np.abs(arm).max() == pytest.approx(1.0)
    for power in range(0, 2 * along - 3, 2):
        assert patch.area @ arm**power == pytest.approx(np.full(2, patch.area.sum() / (power + 1)), rel=1e-12)
    assert patch.gap == pytest.approx(patch.point @ SLOPE, abs=1e-15)


def test_in_rounds_area_first_moment_and_polar_moment_of_any_polygon_are_exact():
    rng = np.random.default_rng(5)
    for _ in range(100):
        corners = random_polygon(rng)
        area, centroid = measure(corners)
        patch = InRounds(corners, 10, 1.3)
        arm = patch.point[:, :2] - centroid
        assert patch.area.min() > 0.0 and patch.area.sum() == pytest.approx(1.3 * area, rel=1e-12)
        assert patch.area @ arm == pytest.approx([0.0, 0.0], abs=1e-11 * area * np.abs(arm).max())
        assert patch.area @ (arm**2).sum(axis=1) == pytest.approx(1.3 * polar(corners), rel=1e-9)

import numpy as np
import pytest

from geometry.polyhedra.weld import weld

WIDTH = 1e-3


def plainly(points, rank):
    """Every two points compared, and numbers handed on until none changes."""
    near = np.linalg.norm(points[:, None] - points[None], axis=2) <= WIDTH
    least = np.arange(len(points))
    for _ in points:
        least = np.array([least[near[i]].min() for i in range(len(points))])
    number = np.unique(least, return_inverse=True)[1]
    order = np.lexsort((np.arange(len(points)), -rank))
    return np.array([next(i for i in order if number[i] == n) for n in range(number.max() + 1)]), number


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("ranked", [False, True])
def test_points_that_hang_together_are_one_however_often_each_is_there(seed, ranked):
    random = np.random.default_rng(seed)
    places = random.integers(0, 3, (12, 3)) + 0.6 * WIDTH * random.integers(0, 4, (12, 3))  # chains of near points
    points = places[random.integers(0, 12, 60)] * random.choice([-1.0, 1.0], (60, 1))  # -0 and 0 are one place
    rank = random.integers(0, 3, 60) if ranked else None
    kept, number = weld(points, WIDTH, rank)
    plain = plainly(points, np.zeros(60) if rank is None else rank)
    assert kept.tolist() == plain[0].tolist() and number.tolist() == plain[1].tolist()


def test_of_no_points_none_is_kept():
    kept, number = weld(np.zeros((0, 3)), WIDTH)
    assert len(kept) == 0 and len(number) == 0

import numpy as np
import pytest

from geometry.polyhedra.loops import free_regions

# A 5 x 5 lattice of points: number 5 j + i at (i, j); the outline runs through all points on the rim.
LATTICE = np.array([[i, j, 0.0] for j in range(5) for i in range(5)])
RIM = [0, 1, 2, 3, 4, 9, 14, 19, 24, 23, 22, 21, 20, 15, 10, 5]


def square(i, j):
    corner = 5 * j + i
    return [corner, corner + 1, corner + 6, corner + 5]


def area(loop):
    x, y = LATTICE[loop, :2].T
    return np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y) / 2


def test_a_face_without_joints_is_one_region():
    assert free_regions(LATTICE, RIM, [], np.array([0, 0, 1.0])) == [[RIM]]


def test_a_face_wholly_covered_leaves_nothing():
    every = [square(i, j) for i in range(4) for j in range(4)]
    assert free_regions(LATTICE, RIM, every, np.array([0, 0, 1.0])) == []


@pytest.mark.parametrize(
    ("covering", "regions"),
    [
        ([square(1, 1)], [(16, [-1])]),
        ([square(1, 1), square(2, 1)], [(16, [-2])]),
        ([square(0, 1), square(1, 1), square(2, 1), square(3, 1)], [(4, []), (8, [])]),
        ([square(0, 1), square(1, 1), square(2, 1), square(3, 1), square(1, 2)], [(4, []), (7, [])]),
        ([square(1, 0), square(1, 1), square(1, 2), square(1, 3), square(2, 1)], [(4, []), (7, [])]),
        ([[2, 14, 22, 10]], [(2, [])] * 4),
        ([[0, 4, 24]], [(8, [])]),
        ([square(1, 1), square(2, 2)], [(16, [-2])]),
        ([square(0, 0), square(1, 1), square(2, 2), square(3, 3)], [(6, [])] * 2),
        ([[5, 6, 7, 8, 9, 14, 13, 12, 11, 10], square(1, 3)], [(4, []), (8 - 1, [])]),
    ],
)
@pytest.mark.parametrize("looking", [1.0, -1.0])
def test_regions_beside_the_joints_are_told_apart(covering, regions, looking):
    orient = (lambda loop: loop) if looking > 0 else (lambda loop: loop[::-1])
    if looking < 0:
        covering = [polygon[::-1] for polygon in covering]
    refined = [[v for edge in zip(p, p[1:] + p[:1], strict=True) for v in on_edge(*edge)] for p in covering]
    free = free_regions(LATTICE, orient(RIM), refined, np.array([0, 0, looking]))
    outer = sorted((looking * area(region[0]), sorted(looking * area(hole) for hole in region[1:])) for region in free)
    assert outer == sorted(regions)


def on_edge(start, end):
    """The start and the lattice points between it and the end."""
    step = LATTICE[end] - LATTICE[start]
    count = int(np.gcd(*np.abs(step[:2]).astype(int)))
    point = LATTICE[start] + step * np.arange(count)[:, None] / count
    return (5 * point[:, 1] + point[:, 0]).astype(int).tolist()

"""Structures turned at random whose corners have lost digits: none is refused, and their joints are what they were."""

import numpy as np
import pytest

from geometry.polyhedra.measures import volumes
from tests.geometry.files.noisy import STRUCTURES, clad_roof, read_again, rounded, shell, turned, worst_joint

SINGLE = 5e-7
"""m, of coordinates of up to 4 m in single precision."""
NOISES = (None, 1e-8, 1e-7, 1e-6, 1e-5)


def require_same(make, seed, noise, suffix, folder):
    random = np.random.default_rng(seed)
    exact = turned(make(random), random)
    noisy, _ = read_again(rounded(exact, noise, random), folder / f"noisy{suffix}")
    worst, lost, _ = worst_joint(exact, noisy)
    assert lost == 0, (make.__name__, seed, noise, suffix)
    assert worst <= 3 * (noise or SINGLE), (make.__name__, seed, noise, suffix)
    assert volumes(noisy).sum() == pytest.approx(volumes(exact).sum(), rel=1e-6 + 100 * (noise or SINGLE))


@pytest.mark.parametrize("make", [m for m in STRUCTURES if m.__name__ != "shell"], ids=lambda make: make.__name__)
def test_structures_in_single_precision_and_with_noise_keep_their_joints(make, tmp_path):
    """The area of a joint changes by no more than noise along its perimeter."""
    for seed, (noise, suffix) in enumerate([(None, ".stl"), (1e-5, ".obj")]):
        require_same(make, seed, noise, suffix, tmp_path)


@pytest.mark.parametrize("seed", range(0, 25, 3))
def test_three_touching_stones_in_single_precision_are_taken_whichever_way_they_are_turned(seed, tmp_path):
    require_same(STRUCTURES[0], seed, None, ".obj", tmp_path)


@pytest.mark.parametrize("noise", [None, 1e-8, 1e-7, 1e-6])
def test_slivers_that_end_in_an_edge_shorter_than_the_tolerance_stay_in_their_faces(noise, tmp_path):
    """Taken for a part of the neighbour, such a sliver moves corners by as much as it is high."""
    for seed in range(4):
        require_same(clad_roof, seed, noise, (".obj", ".stl")[seed % 2], tmp_path)


def test_a_dome_with_four_planes_at_each_corner_is_not_given_up_early(tmp_path):
    require_same(shell, 13, 1e-6, ".obj", tmp_path)


@pytest.mark.slow
@pytest.mark.parametrize("make", STRUCTURES, ids=lambda make: make.__name__)
def test_two_hundred_random_turns(make, tmp_path):
    for seed in range(34):
        require_same(make, seed, NOISES[seed % 5], (".obj", ".stl")[(seed // 5) % 2], tmp_path)

"""Pieces that overlap, however little and with whatever corner or edge, have a point that presses."""

import numpy as np
import pytest
from scipy.optimize import linprog
from scipy.spatial.transform import Rotation

from geometry.blocks import Blocks
from geometry.polyhedra.construct import from_faces
from masonry.detection.narrow import NONE
from tests.detection.touching import Bodies, box_blocks, cells

COUNT, PAIRS = 24, 60


def largest_ball(bodies: Bodies, *pieces: int) -> float:
    """Radius (m) of the largest ball in the intersection of some pieces, < 0 without any: a linear programme."""
    normals, heights = [], []
    for p in pieces:
        own = slice(bodies.pieces.face_start[p], bodies.pieces.face_start[p + 1])
        normal = bodies.turned.normal[own]
        normals.append(np.column_stack([normal, np.ones(len(normal))]))
        heights.append(bodies.turned.offset[own] + normal @ bodies.position[bodies.pieces.body[p]])
    rows, right = np.vstack(normals), np.concatenate(heights)
    return -float(linprog([0, 0, 0, -1], A_ub=rows, b_ub=right, bounds=[(None, None)] * 4).fun)


def meeting(seed: int):
    """Two cells of random shape and attitude, the direction between them, and how far apart they just touch (m)."""
    rng = np.random.default_rng(seed)
    bodies, (p, q) = Bodies(cells(COUNT, 5)), sorted(rng.choice(COUNT, 2, replace=False))
    way = rng.normal(size=3)
    way /= np.linalg.norm(way)
    bodies.put(p, np.zeros(3), np.eye(3)).put(q, frame=Rotation.random(random_state=seed).as_matrix())
    low, high = 0.0, 2.0
    for _ in range(24):
        middle = 0.5 * (low + high)
        overlaps = largest_ball(bodies.put(q, way * middle), p, q) > 0.0
        low, high = (middle, high) if overlaps else (low, middle)
    return bodies, p, q, way, high


@pytest.mark.parametrize("seed", range(PAIRS))
def test_what_overlaps_presses_and_by_about_as_much(seed):
    bodies, p, q, way, apart = meeting(seed)
    for depth in (1e-4, 1e-3, 5e-3):
        touching = bodies.put(q, way * (apart - depth)).touch(p, q, skin=0.01)
        ball = largest_ball(bodies, p, q)
        assert touching.kind != NONE
        assert ball > 0.0 and touching.gap.min() < -2.0 * ball * (1.0 - 1e-6), "a ball fits between the two sides"
        assert touching.gap.min() >= touching.separation * (1.0 + 1e-9)


@pytest.mark.parametrize("seed", range(PAIRS))
def test_what_is_apart_does_not_press(seed):
    bodies, p, q, way, apart = meeting(seed)
    rng = np.random.default_rng(seed)
    for scale in np.repeat((0.03, 0.1, 0.2), 40):
        touching = bodies.put(q, way * apart + scale * rng.uniform(-1.0, 1.0, 3)).touch(p, q, skin=0.02)
        assert touching.gap.min(initial=0.0) >= 0.0 or largest_ball(bodies, p, q) > 0.0


def ridged(kink: float) -> Blocks:
    """A unit cube below z = 0 whose top is two triangles, bent by a kink (m), and a small cube."""
    x = np.array([[0, 0, -1], [1, 0, -1], [1, 1, -1], [0, 1, -1], [0, 0, -kink], [1, 0, 0], [1, 1, -kink], [0, 1, 0.0]])
    loops = [[0, 3, 2, 1], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7], [4, 5, 7], [5, 6, 7]]
    cube = box_blocks([[-0.1] * 3], [[0.1] * 3])
    return from_faces([[x[loop] for loop in loops], [cube.face(f) for f in range(6)]], [0, 1], [0, 0], ("units",))


@pytest.mark.parametrize("kink", [1e-6, 1e-4, 1e-3])
def test_a_corner_that_goes_over_to_a_face_that_is_nearly_level_with_the_last_one_presses_on(kink):
    """The axis of the first face parts both by as much as that of the second, which the corner has come to lie over."""
    depth = 0.005
    for seed in range(10):
        bodies, witness = Bodies(ridged(kink)), None
        bodies.put(1, frame=Rotation.random(random_state=seed).as_matrix())
        lowest = bodies.turned.vertex[bodies.pieces.vertex_start[1] :][:, 2].min()
        for at in np.linspace(0.3, 0.7, 41):
            bodies.put(1, [at, at, -lowest - depth])
            touching = bodies.touch(0, 1, skin=0.01, witness=witness)
            witness = touching.witness
            assert touching.gap.min() < -0.49 * (depth - kink)

"""Pieces that overlap, however little and with whatever corner or edge, have a point that presses."""

import numpy as np
import pytest
from scipy.optimize import linprog
from scipy.spatial.transform import Rotation

from masonry.detection.narrow import NONE
from tests.detection.touching import Bodies, cells

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

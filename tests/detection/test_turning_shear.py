"""The shear of a patch turns with it and keeps its size, however little it turns in a step."""

import numpy as np
import pytest

from masonry.jit.compiler import jit
from masonry.patches.press import turned_with

STEPS = 100_000


@jit
def turn(steps, t, rotation, n):
    x, y, z = t[0], t[1], t[2]
    for _ in range(steps):
        (x, y, z), out = turned_with(
            (x, y, z), x * x + y * y + z * z, (rotation[0], rotation[1], rotation[2]), (n[0], n[1], n[2])
        )
        x, y, z = x - out * n[0], y - out * n[1], z - out * n[2]
    t[0], t[1], t[2] = x, y, z


@pytest.mark.parametrize("angle", [1e-12, 1e-9, 1e-8, 3e-8, 1e-7, 1e-6, 1e-4])
def test_shear_keeps_its_size_and_turns_by_the_angle(angle):
    n = np.array([2.0, -1.0, 2.0]) / 3.0
    start = np.array([1.0, 2.0, 0.0]) * 1e5
    t = start.copy()
    turn(STEPS, t, angle * n, n)
    whole = STEPS * np.arctan(angle)
    assert np.linalg.norm(t) == pytest.approx(np.linalg.norm(start), rel=1e-10)
    assert t == pytest.approx(np.cos(whole) * start + np.sin(whole) * np.cross(n, start), abs=1e-9 * 1e5)

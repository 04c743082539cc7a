"""Several numbers at once give what one after the other gives: in a run of each kinematics, and in exp."""

import json
import math
import os
import subprocess
import sys

import numpy as np
import pytest

from masonry.jit.compiler import jit
from masonry.simd import PLAIN, eight, put, put_rows, take

RUNS = {
    "rigid": ["wallette-mode-1", "specimen.divisions=[2, 1]", "drive.rate=20 mm/s"],
    "affine": ["couplet", "kinematics=affine", "law=exponential", "drive.steps=2000", "settle.steps=500"],
    "scattered": [
        "wallette-mode-1",
        "specimen.divisions=[2, 1]",
        "drive.rate=20 mm/s",
        "scatter.seed=1",
        "scatter.unit_unit.tensile_strength=0.3",
        "scatter.unit_unit.fracture_energy_mode_2=0.3",
    ],
    "patches": ["triplet-dry", "displacements=large"],
    "tets": ["couplet", "kinematics=tets", "specimen.mesh_size=40 mm", "drive.steps=2000", "settle.steps=500"],
}
TAKE = """
import json, sys
import masonry
name, *changes = json.loads(sys.argv[1])
rows = masonry.run(masonry.load(name, changes)).history.rows
print(json.dumps([rows[key].tolist() for key in ("stress", "fracture_mode_1", "fracture_mode_2", "friction")]))
"""


def curves(kind: str, lanes: str) -> np.ndarray:
    """(4, rows) of a run, in a process of its own."""
    done = subprocess.run(
        [sys.executable, "-c", TAKE, json.dumps(RUNS[kind])],
        env=os.environ | {"MASONRY_LANES": lanes},
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    return np.array(json.loads(done.stdout))


@pytest.mark.parametrize(
    "kind",
    ["rigid", *(pytest.param(kind, marks=pytest.mark.slow) for kind in ("affine", "patches", "scattered", "tets"))],
)
def test_a_run_in_lanes_and_a_run_in_single_numbers_agree_past_the_peak(kind):
    lanes, plain = curves(kind, "1"), curves(kind, "0")
    peak = int(np.argmax(plain[0]))
    fallen = np.flatnonzero(plain[0, peak:] < 0.8 * plain[0, peak])
    last = peak + int(fallen[0]) if len(fallen) else plain.shape[1]  # beyond, a wall that cracks amplifies round-off
    assert last > peak and plain[1:, last - 1].max() > 0.0, "something softened, or slid"
    scale = np.abs(plain[:, :last]).max(axis=1, keepdims=True)
    assert np.all(np.abs(lanes - plain)[:, :last] <= 1e-9 * scale)


@pytest.mark.skipif(PLAIN, reason="single numbers use the exp of the C library")
def test_exp_of_lanes_is_exp_to_fourteen_digits_and_keeps_its_limits():
    @jit
    def apply(x, y):
        for k in range(len(x) // 8):
            put(y, 8 * k, math.exp(take(x, 8 * k, eight())))

    x = np.random.default_rng(1).uniform(-707.0, 708.0, 80_000)
    x[:8] = 0.0, -0.0, np.nan, np.inf, -np.inf, -1e300, 1e-300, -1e-17
    y = np.zeros_like(x)
    apply(x, y)
    wanted = np.exp(x)
    np.testing.assert_array_equal(y[:8], wanted[:8])
    assert np.abs(y[8:] / wanted[8:] - 1.0).max() < 1e-14


EIGHT_NUMBERS = """
import numba
import numpy as np
numba.njit(lambda x: x + 1)(1)  # from here on Numba's own rules come before those that follow
from masonry.simd import eight_rows

@numba.njit
def double(numbers, at):
    numbers[eight_rows(at)] = numbers[eight_rows(at)] + numbers[eight_rows(at)]

numbers = np.arange(10.0)
double(numbers, 1)
print(numbers.astype(int).tolist())
"""


@pytest.mark.skipif(PLAIN, reason="without lanes it is one number")
def test_eight_numbers_of_a_row_are_eight_whatever_was_compiled_before():
    done = subprocess.run([sys.executable, "-c", EIGHT_NUMBERS], capture_output=True, text=True, check=True)
    assert json.loads(done.stdout) == [0, 2, 4, 6, 8, 10, 12, 14, 16, 9]


@pytest.mark.parametrize("number", [1, 3, 8, 11])
def test_rows_are_written_as_far_as_there_are_any_and_those_behind_are_left_alone(number):
    @jit
    def write(rows, number, x):
        like = take(x, 0, eight())
        put_rows(rows, 2, number, like, 2.0 * like, 3.0 * like)

    rows, x = np.full((14, 4), -1.0), np.arange(1.0, 9.0)
    write(rows, number, x)
    last = 2 + (1 if PLAIN else min(number, 8))
    np.testing.assert_array_equal(rows[2:last, :3], np.outer(x[: last - 2], [1.0, 2.0, 3.0]))
    assert (rows[:2] == -1.0).all() and (rows[last:] == -1.0).all()

"""Reading a wall of bricks from an OBJ file, beside reading its numbers by hand; and growth with the bricks."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from benchmarks.growing import growth
from geometry.files.surfaces.reader import read_surfaces
from geometry.files.surfaces.writer import surface_text
from geometry.polyhedra.construct import from_boxes
from verification.reference_step.interleaved import in_turn

NUMBERS = [300, 3000]
"""Bricks of the walls."""
LINEAR = 1.2
"""Largest exponent that passes for linear on a shared machine."""
BY_HAND = 30.0
"""Times as long as its lines take to be split into numbers that a file may take to become blocks (measured: 20)."""


def wall(count: int) -> str:
    """The text of a running bond of bricks, turned in plan, each an object of its own."""
    side = round(count**0.5)
    k, i = (x.ravel() for x in np.indices((side, side)))
    low = np.stack([0.25 * i + 0.125 * (k % 2), 0.0 * i, 0.0625 * k], axis=1)
    number = np.arange(side * side)
    blocks = from_boxes(low, low + [0.25, 0.12, 0.0625], number, 0 * number, ("units",))
    turn = np.array([[np.cos(0.5), np.sin(0.5), 0.0], [-np.sin(0.5), np.cos(0.5), 0.0], [0.0, 0.0, 1.0]])
    blocks.points[:] = np.round(blocks.points @ turn, 6)
    return "".join(surface_text(blocks, [f"brick{n}" for n in number], ".obj"))


def by_hand(path: Path) -> Callable[[], object]:
    """Reads the numbers of all lines."""

    def read() -> list[list[float]]:
        lines = path.read_text(encoding="utf-8").splitlines()
        return [[float(word) for word in line.split()[1:]] for line in lines if line[0] in "vf"]

    return read


@pytest.fixture
def walls(tmp_path) -> list[tuple[int, Path]]:
    paths = [(round(count**0.5) ** 2, tmp_path / f"{count}.obj") for count in NUMBERS]
    for count, path in paths:
        path.write_text(wall(count), encoding="utf-8")
    return paths


def test_bricks_are_read_within_a_few_times_the_time_of_their_numbers(figure, walls):
    calls = [call for _, path in walls for call in (lambda p=path: read_surfaces(p, 1.0), by_hand(path))]
    times = [clock.least for clock in in_turn(*calls, rounds=5)]
    counts, ours = [count for count, _ in walls], times[::2]
    ratio = ours[-1] / times[-1]
    figure(f"reading {counts[-1]} bricks", counts[-1] / ours[-1], "bricks/s")
    figure(f"reading {counts[-1]} bricks, over their numbers by hand", ratio, "", reach=BY_HAND)
    power = growth(counts, ours)
    assert power <= LINEAR, f"the time of reading grows with power {power:.2f} of the bricks; 1 is linear"
    assert ratio <= BY_HAND, f"reading takes {ratio:.1f} times as long as the numbers by hand; the gate is {BY_HAND}"

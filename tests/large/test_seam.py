"""A block that is pushed over the seam of two slabs feels nothing of it, and loses what friction takes."""

import numpy as np
import pytest

from masonry.laboratory import laboratory
from tests.large.made import DENSITY, G, dry
from tests.scenes import box

SUPPORTS = (
    'on = "slab"\nfix = "all"',
    'on = "slab beyond"\nfix = "all"',
    'on = "block"\nfix = ["y", "rotation"]',
)
PUSH = '[drive]\non = "block"\ndirection = "x"\ndisplacement = "200 mm"\nrate = "1 m/s"\nramp = 0.1\n'


@pytest.mark.parametrize("points", ["corners", "spread"])
def test_the_force_is_friction_times_weight_on_either_side_and_over_the_seam(points):
    boxes = [
        box("slab", (-0.5, -0.2, -0.1), (0.5, 0.4, 0.1), "units", 0),
        box("slab beyond", (0.0, -0.2, -0.1), (0.5, 0.4, 0.1), "units", 1),
        box("block", (-0.15, -0.05, 0.0), (0.1, 0.1, 0.05), "units", 2),
    ]
    spread = f'patch_points = "{points}"'
    scene = dry(boxes, 0.5, duration=0.4, turned=spread, settle=20000, supports=SUPPORTS, more=PUSH)
    result = laboratory.run(scene)
    rows, limit = result.history.rows, 0.5 * DENSITY * 0.1 * 0.1 * 0.05 * G
    moving = (rows["displacement"] > 0.03) & (rows["displacement"] < 0.19)
    force = rows["force"][moving]
    across = (rows["displacement"][moving] > 0.05) & (rows["displacement"][moving] < 0.15)
    assert across.sum() > 20, "rows at which the block stands on both slabs"
    assert force == pytest.approx(np.full(len(force), limit), rel=1e-8)
    assert rows["displacement"][-1] == pytest.approx(0.2, rel=1e-4)
    assert rows["friction"][-1] == pytest.approx(limit * rows["displacement"][-1], rel=1e-4)
    assert 0.0 <= rows["redetection"][-1] < 1e-6 * rows["friction"][-1]
    assert abs(rows["area"][-1]) < 1e-8 * rows["friction"][-1]
    assert result.summary["energy_imbalance"] < 1e-12


@pytest.mark.parametrize(("pressure", "speed"), [(0.0, "0.5 m/s"), (1e5, "0.5 m/s"), (1e5, "0.05 m/s")])
def test_the_edge_of_a_sunk_block_gives_the_next_slab_no_blow_between_two_rows(pressure, speed):
    """Pressed by p it is sunk by p / k_n in the first slab; its edge meets the second with springs, but no dashpot."""
    boxes = [
        box("slab", (-0.5, -0.2, -0.1), (0.5, 0.4, 0.1), "units", 0),
        box("slab beyond", (0.0, -0.2, -0.1), (0.5, 0.4, 0.1), "units", 1),
        box("block", (-0.105, -0.05, 0.0), (0.1, 0.1, 0.05), "units", 2),
    ]
    drive = f'[drive]\non = "block"\ndirection = "x"\ndisplacement = "10 mm"\nrate = "{speed}"\nramp = 0.1\n'
    load = f'[[traction]]\non = "block.z+"\nstress = {{z = "-{pressure} Pa"}}\n' if pressure else ""
    result = laboratory.run(dry(boxes, 0.5, duration=0.3, settle=20000, supports=SUPPORTS, more=drive + load))
    limit = 0.5 * (DENSITY * 0.05 * G + pressure) * 0.1 * 0.1
    assert result.summary["peak_force_n"] == pytest.approx(limit, rel=5e-4)
    assert result.history.rows["displacement"][-1] == pytest.approx(0.01, rel=1e-4)

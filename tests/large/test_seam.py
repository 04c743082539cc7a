"""A block that is pushed over the seam of two slabs feels nothing of it, and loses what friction takes."""

import numpy as np
import pytest

from masonry.laboratory import laboratory
from tests.large.made import DENSITY, G, dry
from tests.scenes import box, listed

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


def over_the_seam(pressure, speed="1 m/s", step=0.0, others=(), stiff="10 GPa/m", rows=200):
    """The result of a block that is pushed from one slab wholly onto the next, which is higher by a step (m), and what
    friction there is. Others: name, low corner (m), size (m) and pressure (Pa) of more blocks."""
    blocks = [("block", (-0.105, -0.05, 0.0), (0.1, 0.1, 0.05), pressure), *others]
    boxes = [
        box("slab", (-0.5, -0.2, -0.1), (0.5, 0.4, 0.1), "units", 0),
        box("slab beyond", (0.0, -0.2, -0.1), (0.5, 0.4, 0.1 + step), "units", 1),
        *(box(name, low, size, "units", k + 2) for k, (name, low, size, _) in enumerate(blocks)),
    ]
    drive = '[drive]\non = "block"\ndirection = "x"\ndisplacement = "120 mm"\nramp = 0.1\n' + f'rate = "{speed}"\n'
    loads = [f'on = "{name}.z+"\nstress = {{z = "-{load} Pa"}}' for name, _, _, load in blocks if load]
    more = drive + listed("traction", loads)
    text = dry(boxes, 0.5, duration=0.3, settle=20000, supports=SUPPORTS, more=more, stiff=stiff, rows=rows)
    return laboratory.run(text), 0.5 * (DENSITY * 0.05 * G + pressure) * 0.1 * 0.1


@pytest.mark.parametrize(("pressure", "speed"), [(0.0, "1 m/s"), (1e5, "1 m/s"), (1e6, "1 m/s"), (1e6, "0.5 m/s")])
def test_no_step_at_which_an_edge_passes_the_seam_gives_a_blow(pressure, speed):
    """Pressed by p the block is sunk by p / k_n, and its edges meet a slab from the side: the peak, which is looked
    for at every step, is friction times weight all the same."""
    result, limit = over_the_seam(pressure, speed)
    assert result.summary["peak_force_n"] == pytest.approx(limit, rel=1e-9)
    assert result.history.rows["displacement"][-1] == pytest.approx(0.12, rel=1e-4)


def test_an_edge_that_is_hardly_sunk_gives_no_blow_either():
    """By p / k_n = 1e-9 m: the corners of its narrow overlap are two."""
    result, limit = over_the_seam(0.0, stiff="1000 GPa/m")
    assert result.summary["peak_force_n"] == pytest.approx(limit, rel=1e-6)


def test_soft_springs_do_not_stop_a_block_at_the_seam():
    """It is sunk by a hundredth of its size as its contact with the next slab begins: nothing was born in it."""
    result, limit = over_the_seam(1e5, stiff="0.1 GPa/m")
    assert result.summary["peak_force_n"] == pytest.approx(limit, rel=1e-9)


@pytest.mark.parametrize("far", [0.0, 3e6])
def test_a_slab_that_stands_out_by_more_than_the_block_is_sunk_is_hit(far):
    """However deep something else is sunk into that slab."""
    others = [("far", (0.35, -0.05, 3e-4), (0.1, 0.1, 0.05), far)]
    result, limit = over_the_seam(1e5, step=3e-4, others=others)
    assert result.summary["peak_force_n"] > 1.2 * limit


def test_a_block_that_bears_more_on_top_than_below_feels_no_seam():
    """The patch on which it lies is not its deepest one."""
    rider = "rider", (-0.08, -0.05, 0.05), (0.05, 0.1, 0.05), 1e6
    result, limit = over_the_seam(0.0, "0.5 m/s", others=[rider], rows=4000)
    rows = result.history.rows
    moving = (rows["displacement"] > 0.03) & (rows["displacement"] < 0.118)
    every = 1.5 * limit + 0.5 * 1e6 * 0.05 * 0.1
    assert rows["force"][moving] == pytest.approx(np.full(moving.sum(), every), rel=2e-5)

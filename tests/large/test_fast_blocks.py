"""Blocks that come fast: they do not pass through what is thin, and what enters deeply at once ends the run; what
tumbles gets no energy from contacts that are found anew."""

from math import sqrt

import numpy as np
import pytest

from geometry.polyhedra.measures import bounds
from masonry import scene
from masonry.assembly.assemble import assemble
from masonry.laboratory import laboratory
from masonry.patches.arrays import DASHPOT, NORMAL_GAINED
from masonry.patches.refreshing import refresh
from tests.large.by_hand.patch_calls import deepest, stored_energy
from tests.large.made import DENSITY, G, dry, slab
from tests.scenes import box

THIN = 0.01
BRICK, DROP = (0.24, 0.115, 0.06), 0.15


def shot(speed: float, duration: float = 0.05):
    """A cube of 0.1 m that is thrown down (m/s) upon a plate, a tenth of its size thick."""
    boxes = [
        box("slab", (-0.5, -0.5, -THIN), (1.0, 1.0, THIN), "units", 0),
        box("cube", (-0.05, -0.05, 0.05), (0.1, 0.1, 0.1), "units", 1),
    ]
    thrown = f'[[motion]]\non = "cube"\nvelocity = [0, 0, "-{speed} m/s"]\n'
    return dry(boxes, duration=duration, more=thrown + '[[gauge]]\nname = "z"\nat = "cube"\ndirection = "z"')


def test_a_cube_at_10_metres_a_second_does_not_pass_through_a_thin_plate():
    result = laboratory.run(shot(10.0))
    rows = result.history.rows
    assert rows["z"].min() > -0.05 - 0.2 * THIN
    assert rows["z"][-1] > -0.05, "it comes back"
    left = rows["kinetic"] - rows["external_work"] + rows["elastic_contacts"]
    assert left + rows["dashpot"] + rows["friction"] == pytest.approx(np.full(len(left), left[0]), abs=0.02 * 100.0)
    assert result.summary["energy_imbalance"] < 1e-12


def test_a_contact_that_begins_with_a_deep_overlap_ends_the_run_with_both_blocks_named():
    built = assemble(shot(1.0))
    built.model.bodies.rigid.q[1, 2] = -0.053
    outcome = laboratory.timeloop.run(built.model, built.plan, built.recording)
    assert outcome.stopped.startswith("blocks 0 and 1 (units and units) overlap at once by more than a hundredth")
    assert outcome.steps < 10


def test_what_would_leave_a_block_on_its_far_side_ends_the_run_with_both_blocks_named():
    """A contact so soft that a cube at 10 m/s enters a plate, as thick as itself, by more than half of that."""
    boxes = [slab(1.0), box("cube", (-0.05, -0.05, 0.01), (0.1, 0.1, 0.1), "units", 1)]
    thrown = '[[motion]]\non = "cube"\nvelocity = [0, 0, "-10 m/s"]\n'
    built = assemble(dry(boxes, duration=0.05, more=thrown))
    assert built.model.large is not None
    built.model.large.near.rules.normal_stiffness[:] *= 1e-4
    outcome = laboratory.timeloop.run(built.model, built.plan, built.recording)
    assert "blocks 0 and 1 (units and units) overlap by 0.5" in outcome.stopped and "far side" in outcome.stopped
    assert all(np.isfinite(rows).all() for rows in outcome.history.rows.values())


def tumbling():
    """A brick that is let go above a slab, on its way round about a skew axis."""
    spin = '[[motion]]\non = "brick"\nspin = ["7 rad/s", "5 rad/s", "1 rad/s"]\n'
    brick = box("brick", (-0.12, -0.06, DROP), BRICK, "units", 1)
    return laboratory.run(dry([slab(2.0), brick], 0.4, duration=0.5, rows=4000, more=spin))


def test_contacts_that_are_found_anew_only_lose_energy():
    rows, work = tumbling().history.rows, DENSITY * float(np.prod(BRICK)) * G * DROP
    assert rows["dashpot"][-1] > 0.1 * work, "it hits the slab"
    lost = np.diff(rows["area"] + rows["redetection"])
    assert lost.min() > -1e-12 * work
    assert np.abs(rows["area"]).max() < 1e-12 * work, "what its one patch holds does not change as it gets smaller"
    assert 0.0 < rows["redetection"][-1] < 1e-3 * work
    assert np.abs(rows["imbalance"]).max() < 1e-11 * work


@pytest.mark.parametrize("share", [0.0, 0.4, 3.0])
def test_a_dashpot_pays_for_what_springs_gain_as_a_patch_grows_up_to_what_it_has_taken(share):
    """A block that presses with half of its face comes to press with all of it, which doubles what its springs hold."""
    block, depth = box("block", (0.45, -0.05, 0.0), (0.1, 0.1, 0.1), "units", 1), 1e-5
    model = assemble(dry([slab(1.0), block])).model
    near, rigid = model.large.near, model.bodies.rigid
    rigid.q[1, 2] = -depth
    assert refresh(near) >= 0.0
    half = 0.5 * 1e10 * 0.005 * depth**2
    assert stored_energy(near) == pytest.approx(half, rel=1e-9)
    near.pairs.damped[0], taken = share * half, near.account[DASHPOT]
    rigid.q[1, 0] -= 0.05
    near.motion.travel[1] += 0.05
    assert refresh(near) >= 0.0
    paid = min(share, 1.0) * half
    assert stored_energy(near) == pytest.approx(half + paid, rel=1e-9)
    assert near.pairs.slack[0] == pytest.approx(depth - sqrt((half + paid) / (0.5 * 1e10 * 0.01)), abs=1e-9 * depth)
    assert near.account[DASHPOT] == pytest.approx(taken - paid, abs=1e-9 * half)
    assert near.account[NORMAL_GAINED] == pytest.approx(0.0, abs=1e-9 * half)
    assert near.pairs.damped[0] == pytest.approx(share * half - paid, abs=1e-9 * half)


@pytest.mark.slow
def test_a_pile_of_200_cells_comes_to_rest_and_none_stays_in_another():
    built = assemble(scene.load("rubble-pile"))
    rows = laboratory.timeloop.run(built.model, built.plan, built.recording).history.rows
    low, high = bounds(built.model.blocks)
    assert rows["time"][-1] < 4.0, "it rests before the scene's end"
    assert rows["kinetic"][-1] < 1e-6 * rows["external_work"][-1]
    assert deepest(built.model.large.near, (high - low).min(axis=1)) < 1e-3
    assert np.abs(rows["imbalance"]).max() < 1e-11 * rows["external_work"][-1]


def thrown(velocity: str, gap: float, size: float = 2.0, more: str = "", duration: float = 0.1):
    """Rows of a cube of 0.1 m that is thrown from a gap (m) above the slab."""
    cube = box("cube", (-0.05, -0.05, gap), (0.1, 0.1, 0.1), "units", 1)
    motion = f'[[motion]]\non = "cube"\nvelocity = {velocity}\n[[gauge]]\nname = "x"\nat = "cube"\ndirection = "x"\n'
    result = laboratory.run(dry([slab(size), cube], duration=duration, more=f"{more}\n{motion}"))
    return result.history.rows, result.summary


def test_a_block_may_fly_faster_than_a_hundredth_of_its_size_in_a_step():
    rows, summary = thrown('["100 m/s", 0, "1 m/s"]', 0.5, duration=0.2)
    assert 100.0 * summary["time_step_s"] > 0.01 * 0.1
    assert not summary["stopped"]
    assert rows["x"][-1] == pytest.approx(100.0 * rows["time"][-1], rel=1e-9)


def test_how_far_neighbours_are_looked_for_changes_no_bit_of_an_impact():
    first, *others = (thrown('[0, 0, "-20 m/s"]', 0.1, more=f"skin = {skin}")[0] for skin in (0.02, 1e-4, 0.1))
    assert first["dashpot"][-1] > 1.0
    for other in others:
        assert all(np.array_equal(first[name], other[name]) for name in first)


def test_how_heavy_a_held_block_is_changes_nothing_of_what_hits_it():
    small, large = (thrown('[0, 0, "-2 m/s"]', 0.01, size)[0] for size in (0.12, 4.0))
    assert small["kinetic"][-1] == pytest.approx(large["kinetic"][-1], rel=1e-9)
    assert small["kinetic"][-1] < 0.5 * large["kinetic"][0]

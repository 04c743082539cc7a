"""Blocks that come fast: they do not pass through what is thin, and what enters deeply at once ends the run; what
tumbles gets no energy from contacts that are found anew."""

import numpy as np
import pytest

from masonry.assembly.assemble import assemble
from masonry.laboratory import laboratory
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
    assert outcome.stopped.startswith("blocks 0 and 1 overlap at once by more than a hundredth")
    assert outcome.steps < 10


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

"""The doubts that a summary measures are those of its rows: worked out here once more, from the curve alone."""

import numpy as np
import pytest

from masonry.laboratory import laboratory
from verification.scene_runs import loaded

SETTLE, DRIVE = 800, 3000


@pytest.fixture(scope="module")
def ran():
    """Five rigid blocks, pushed faster than is good for them, and the share of the ramp of their drive."""
    with loaded("energy-of-five-blocks", {"law": "elastic"}) as scene:
        return laboratory.run(scene), scene.drive.ramp


@pytest.fixture(scope="module")
def rows(ran):
    """Rows of the history, and which of them are those after the ramp of the drive, or from the peak on."""
    rows = ran[0].history.rows
    driven = rows["step"] > SETTLE
    peak = rows["step"][driven][np.argmax(rows["stress"][driven])]
    return rows, driven & (rows["step"] >= min(SETTLE + np.ceil(ran[1] * DRIVE), peak))


def test_the_ends_differ_by_the_largest_difference_of_their_forces_over_the_peak(ran, rows):
    rows, after = rows
    apart = np.abs(rows["stress"] - rows["support_stress"])[after].max() / ran[0].summary["peak_stress_pa"]
    assert apart > 1e-8 and ran[0].summary["reaction_mismatch_max"] == pytest.approx(apart, rel=1e-12)


def test_kinetic_energy_is_taken_over_what_blocks_and_contacts_have_taken(ran, rows):
    rows, after = rows
    share = (rows["kinetic"][after] / (rows["elastic_blocks"] + rows["contact_work"])[after]).max()
    assert share > 1e-9 and ran[0].summary["kinetic_over_internal_max"] == pytest.approx(share, rel=1e-9)


def test_damping_is_taken_from_the_settling_to_rest_over_the_work_since_then(ran, rows):
    rows, _ = rows
    since = {
        key: rows[key] - rows[key][np.searchsorted(rows["step"], SETTLE)]
        for key in ("damping", "kinetic", "external_work")
    }
    share = (since["damping"] + since["kinetic"])[-1] / np.abs(since["external_work"][rows["step"] >= SETTLE]).max()
    assert share > 1e-9 and ran[0].summary["damping_over_external"] == pytest.approx(share, rel=1e-12)

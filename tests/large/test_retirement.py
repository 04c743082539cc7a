"""Bonds that are broken retire: friction takes over where they were, and every joule of theirs is booked."""

from functools import cache
from math import radians, tan

import numpy as np
import pytest

from masonry import scene
from masonry.kernels.patches import BORN, NORMAL_GAINED, SHEAR_LOST
from masonry.laboratory import laboratory
from masonry.monitors.energy import open_in_contacts
from masonry.timeloop import loop
from masonry.timeloop.retirement import areas_of, pressures_of

WEIGHT = 1900.0 * 0.2 * 0.05 * 0.05 * 9.81
ROUGH = {"dilation_angle": "5 deg", "dilation_cutoff": "0.3 mm"}
SLID = {"drive.displacement": "30 mm", "solver.duration": "0.4 s", "solver.until": None, "drive.rate": "200 mm/s"}


@cache
def slid():
    """The couplet's upper unit pushed on after its joint has cracked."""
    return laboratory.run(scene.load("couplet-slid-off", SLID))


def test_what_was_cracked_slides_under_its_weight_by_friction_alone():
    rows = slid().history.rows
    late = (rows["displacement"] > 0.01) & (rows["displacement"] < 0.028)
    assert rows["force"][late] == pytest.approx(np.full(late.sum(), 0.73 * WEIGHT), rel=0.05)
    assert np.mean(rows["force"][late]) == pytest.approx(0.73 * WEIGHT, rel=2e-3)
    assert slid().summary["collapse"] is None


def test_what_bonds_have_dissipated_is_final_once_they_retired():
    rows = slid().history.rows
    for key in ("fracture_mode_1", "fracture_mode_2"):
        late = rows[key][rows["displacement"] > 0.01]
        assert late[-1] == late[0] > 0.0, key
    assert rows["fracture_mode_2"][-1] == pytest.approx(58.0 * 0.2 * 0.05, rel=0.1)


def test_every_joule_is_booked_as_bonds_retire():
    rows = slid().history.rows
    left = np.array(
        [open_in_contacts({key: values[k] for key, values in rows.items()}) for k in range(len(rows["step"]))]
    )
    begun = int(np.argmax(rows["area"] != 0.0))
    assert begun > 0
    work = np.abs(rows["external_work"]).max()
    assert abs(left[begun] - left[begun - 1]) < 1e-6 * work, "at the row at which they retire"
    assert np.abs(rows["imbalance"]).max() < 1e-12 * work


def handed_over(monkeypatch, **settings):
    """By what (J) the account changes as bonds retire, and the rows of the couplet of the paper."""
    seen, usual = [], loop.retire

    def watched(model):
        before = model.large.near.account.copy()
        usual(model)
        change = model.large.near.account - before
        if model.contacts.area.max() == 0.0 and not seen:
            seen.append(change)
            assert press_of(model) == pytest.approx(1.0, abs=3e-3), "of the thrust of the bonds"

    monkeypatch.setattr(loop, "retire", watched)
    rows = laboratory.run(scene.load("couplet", {"displacements": "large", **settings})).history.rows
    (change,) = seen
    return change, rows


def press_of(model) -> float:
    """What the patches press with, over the confinement of 0.5 MPa."""
    near = model.large.near
    held = range(int(near.pairs.number[0]))
    pressed = 0.0
    for p in (p for p in held if near.pairs.slot[p] >= 0):
        pressed += float(areas_of(near, p) @ pressures_of(near, p))
    return pressed / (0.5e6 * 0.2 * 0.05)


def test_patches_hold_what_their_bonds_held_although_the_joint_has_become_smaller(monkeypatch):
    change, rows = handed_over(monkeypatch)
    work = rows["external_work"].max()
    assert abs(change[SHEAR_LOST]) < 1e-12 * work
    assert abs(change[NORMAL_GAINED] + change[BORN]) < 1e-12 * work
    assert max(abs(rows[key]).max() for key in ("redetection", "area")) < 1e-6 * work
    assert rows["stress"][-1] == pytest.approx(0.73 * 0.5e6, rel=3e-3)


def test_what_has_dilated_stays_apart_as_it_slides_on_under_pressure():
    """Dry and brittle: it rises by tan psi a slip, as in small displacement, less what the pressure closes."""
    dry = {"law": "brittle", "tensile_strength": "0 Pa", "cohesion": "0 Pa"} | ROUGH
    over = {f"contact.unit_unit.{key}": value for key, value in dry.items()} | {"displacements": "large"}
    gauge = [{"name": "rise", "at": "top", "direction": "z"}]
    result = laboratory.run(scene.load("couplet", over | {"gauge": gauge}))
    rows, closed = result.history.rows, 0.5e6 / 150e9
    late = rows["displacement"] > 0.4e-3
    assert rows["rise"][late] == pytest.approx(np.full(late.sum(), tan(radians(5.0)) * 0.3e-3 - closed), rel=2e-3)
    assert rows["stress"][late] == pytest.approx(np.full(late.sum(), 0.73 * 0.5e6), rel=1e-3)
    begun = int(np.argmax(rows["redetection"] != 0.0))
    assert 0.3e-3 < rows["displacement"][begun] < 0.4e-3, "bonds retire once they do not dilate any more"
    lost = np.abs(rows["redetection"] - rows["area"]).max()
    assert lost < 1e-5 * rows["external_work"].max()

"""Bonds that are broken retire: friction takes over where they were, and every joule of theirs is booked."""

from functools import cache
from math import radians, tan

import numpy as np
import pytest

from masonry import scene
from masonry.configuration import large
from masonry.configuration.energy import open_in_contacts
from masonry.configuration.retirement import areas_of, pressures_of
from masonry.laboratory import laboratory
from masonry.patches.arrays import BORN, NORMAL_GAINED, SHEAR_LOST
from tests.large.made import G, dry, slab
from tests.scenes import box

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
    seen, usual = [], large.retire

    def watched(model, parts, crushing):
        before = model.large.near.account.copy()
        usual(model, parts, crushing)
        change = model.large.near.account - before
        if model.contacts.area.max() == 0.0 and not seen:
            seen.append(change)
            assert press_of(model) == pytest.approx(1.0, abs=3e-3), "of the thrust of the bonds"

    monkeypatch.setattr(large, "retire", watched)
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


def test_what_has_dilated_stays_apart_as_it_slides_on_under_pressure(monkeypatch):
    """Dry and brittle: it rises by tan psi a slip, as in small displacement, less what the pressure closes."""
    dry = {"law": "brittle", "tensile_strength": "0 Pa", "cohesion": "0 Pa"} | ROUGH
    over = {f"contact.unit_unit.{key}": value for key, value in dry.items()} | {"displacements": "large"}
    gauge = [{"name": "rise", "at": "top", "direction": "z"}]
    gone, usual = [], large.retire

    def watched(model, parts, crushing):
        usual(model, parts, crushing)
        gone.append(model.contacts.area.max() == 0.0)

    monkeypatch.setattr(large, "retire", watched)
    result = laboratory.run(scene.load("couplet", over | {"gauge": gauge}))
    rows, closed = result.history.rows, 0.5e6 / 150e9
    late = rows["displacement"] > 0.4e-3
    assert rows["rise"][late] == pytest.approx(np.full(late.sum(), tan(radians(5.0)) * 0.3e-3 - closed), rel=2e-3)
    assert rows["stress"][late] == pytest.approx(np.full(late.sum(), 0.73 * 0.5e6), rel=1e-3)
    begun = rows["displacement"][len(rows["step"]) - len(gone) + gone.index(True)]
    assert len(rows["step"]) - len(gone) in (0, 1), "bonds are looked at after each row but the first"
    assert 0.3e-3 < begun < 0.4e-3, "bonds retire once they do not dilate any more"
    lost = np.abs(rows["redetection"] - rows["area"]).max()
    assert lost < 1e-5 * rows["external_work"].max()


WEAK = 'law = "{law}"\ntensile_strength = "{strength}"\ncohesion = "{cohesion}"\nresidual_cohesion = "{left}"\n'
ENERGIES = 'fracture_energy_mode_1 = "1 N/m"\nfracture_energy_mode_2 = "5 N/m"\n'
GAUGES = "\n".join(f'[[gauge]]\nname = "{axis}"\nat = "block"\ndirection = "{axis}"\n' for axis in "xz")


def weak(law: str, strength: str = "0 Pa", cohesion: str = "0 Pa", left: str = "0 Pa") -> str:
    """The keys of a joint."""
    return WEAK.format(law=law, strength=strength, cohesion=cohesion, left=left) + (
        "" if law == "brittle" else ENERGIES
    )


def moving(block: str, motion: str, duration: float, **others):
    """A block that is given a motion on a slab."""
    return laboratory.run(
        dry([slab(), block], duration=duration, more=f'{GAUGES}[[motion]]\non = "block"\n{motion}', **others)
    )


@pytest.mark.parametrize("law", ["brittle", "linear"])
def test_joints_whose_strengths_are_0_slide_off_as_dry_ones_do(law):
    block = box("block", (1.8, -0.1, 0.0), (0.2, 0.2, 0.1), "units", 1)
    weight = {"friction": 0.1, "duration": 0.25, "motion": 'velocity = ["1 m/s", 0, 0]\n', "settle": 1000}
    dry_one, weak_one = (moving(block, joint=joint, **weight) for joint in ("", weak(law)))
    assert dry_one.summary["rotation_max_rad"] > 0.2, "it tips over the edge of the slab"
    for column in ("x", "z", "friction"):
        there = dry_one.history.rows[column]
        assert weak_one.history.rows[column] == pytest.approx(there, abs=1e-6 * np.ptp(there)), column


def test_residual_cohesion_acts_on_the_area_that_two_blocks_share():
    """A plate that sticks out slides in: m v^2 / 2 = c b (area it covers, summed over its way) + mu W s."""
    size, out, cohesion, speed, friction = (0.2, 0.2, 0.01), 0.03, 1000.0, 2.0, 0.6
    block = box("block", (1.8 + out, -0.1, 0.0), size, "units", 1)
    joint = weak("brittle", cohesion="1 kPa", left="1 kPa")
    result = moving(block, f'velocity = ["-{speed} m/s", 0, 0]\n', 0.06, joint=joint, settle=1000)
    mass, per_length = 2000.0 * np.prod(size), cohesion * size[1]
    as_it_covers_more = per_length * ((size[0] - out) * out + 0.5 * out**2) + friction * mass * G * out
    left = 0.5 * mass * speed**2 - as_it_covers_more
    way = out + left / (per_length * size[0] + friction * mass * G)
    assert left > 0.0
    assert -result.history.rows["x"][-1] == pytest.approx(way, rel=2e-3)
    assert result.history.rows["kinetic"][-1] < 1e-6 * 0.5 * mass * speed**2
    assert np.abs(result.history.rows["imbalance"]).max() < 1e-12 * mass * speed**2


@pytest.mark.parametrize("left", ["0 Pa", "20 kPa"])
def test_a_block_that_topples_about_bonds_that_hold_comes_to_lie_on_its_side(left):
    block = box("block", (-0.1, -0.1, 0.0), (0.2, 0.2, 0.6), "units", 1)
    joint = weak("linear", "20 kPa", "50 kPa", left)
    spin = 'spin = [0, "3 rad/s", 0]\nabout = ["0.1 m", "0 m", "0 m"]\n'
    result = moving(block, spin, 1.5, joint=joint, settle=1000)
    assert result.history.rows["z"][-1] == pytest.approx(0.1 - 0.3, abs=1e-4)
    assert result.summary["energy_j"]["fracture_mode_1"] > 0.0
    assert np.abs(result.history.rows["imbalance"]).max() < 1e-12 * 100.0


def test_what_glides_on_glue_without_shear_falls_once_it_is_past_its_joint():
    block = box("block", (1.8, -0.1, 0.0), (0.2, 0.2, 0.1), "units", 1)
    glued = {"joint": 'law = "elastic"\n', "shear": "0 Pa/m"}
    rows = moving(block, 'velocity = ["2 m/s", 0, 0]\n', 0.25, **glued).history.rows
    past = rows["x"] > 0.2
    fallen = -0.5 * G * (rows["time"] - 0.1) ** 2
    assert np.abs(rows["z"][~past]).max() < 1e-5
    assert rows["z"][past] == pytest.approx(fallen[past], abs=1e-3)

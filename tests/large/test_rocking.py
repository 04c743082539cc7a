"""Free rocking: when a slender block hits the floor, what it keeps of its spin, and a ledger that closes."""

from functools import cache
from math import atan, cos, hypot, sqrt

import numpy as np
import pytest

from masonry import scene
from masonry.configuration.energy import open_in_contacts
from masonry.judgement.sentence import trust
from masonry.laboratory import laboratory

HALF, HIGH, G = 0.125, 0.5, 9.81
MASS = 2000.0 * 0.25 * 0.5 * 1.0
IMPACTS = (0.34917, 0.91745, 1.39964)
BETWEEN = (0.2, 0.6, 1.15, 1.55)
"""s: once before each impact and after the last, when the block is in the middle of a swing."""

FLAT = {
    "specimen.turned": None,
    "specimen.box": [{"name": "block", "origin": ["0 m", "0 m", "0 m"], "size": ["1 m", "0.5 m", "0.1 m"]}],
}
FLAT |= {"solver.until": "rest", "solver.damping": 0.5}
"""The block as a slab that lies on the floor: its weight lets it swing, and damping brings it to rest."""


@cache
def rocking(fraction: float = 0.8):
    """Rows of the packaged scene, and its summary."""
    settings = {"solver.rows": 3000, "solver.duration": "1.6 s", "solver.step_fraction": fraction}
    result = laboratory.run(scene.load("block-rocking", settings))
    return result.history.rows, result.summary


def energies(rows):
    """Of all rows (J), from the place at which the block stands upright."""
    alpha = atan(HALF / HIGH)
    leant = MASS * G * hypot(HALF, HIGH) * (cos(0.5 * alpha) - cos(alpha))
    return rows["kinetic"] - rows["external_work"] + leant


def test_it_hits_the_floor_at_the_times_of_housner():
    rows, _ = rocking()
    energy, time = energies(rows), rows["time"]
    swings = np.interp(BETWEEN, time, energy)
    halfway = 0.5 * (swings[1:] + swings[:-1])
    assert [time[energy > limit][-1] for limit in halfway] == pytest.approx(IMPACTS, rel=0.01)


def test_a_run_that_was_to_end_at_rest_and_did_not_says_so():
    still_rocks = {"solver.duration": "1 s", "solver.until": "rest"}
    told = laboratory.run(scene.load("block-rocking", still_rocks)).summary
    assert (
        "not all was at rest, as solver.until asks" in trust(told)
        and "longer solver.duration" in told["doubts"][0]["advice"]
    )
    lying = laboratory.run(scene.load("block-rocking", {**FLAT, "solver.duration": "2 s"})).summary
    assert lying["steps"] * lying["time_step_s"] < 1.9 and "at rest, as" not in trust(lying)
    assert lying["joints_opened_or_slid"] is None, "patches do not remember that they slid, which is not 0"


def test_each_impact_keeps_the_share_of_the_spin_that_two_corner_points_give():
    rows, _ = rocking()
    swings = np.interp(BETWEEN, rows["time"], energies(rows))
    assert np.sqrt(swings[1:] / swings[:-1]) == pytest.approx([0.9117] * 3, rel=0.01)
    per_swing = [np.ptp(energies(rows)[np.abs(rows["time"] - t) < 0.1]) for t in BETWEEN[:3]]
    assert max(per_swing) < 1e-3 * swings[0], "what is lost is lost at impacts"


@pytest.mark.parametrize(("dashpot", "more"), [(0.5, 0.0127), (2.0, -0.0006)])
def test_a_stocky_block_keeps_more_spin_than_by_hand_unless_its_dashpot_is_twice_critical(dashpot, more):
    """What docs/large-displacement.md says of a block of 0.4 x 1.2 m, which keeps 1 - 1.5 / (1 + (h / b)^2) by hand."""
    half, high = 0.2, 0.6
    alpha, by_hand = atan(half / high), 1.0 - 1.5 / (1.0 + (high / half) ** 2)
    settings = {
        "specimen.turned": {"about": "y", "angle": f"{0.5 * alpha!r} rad"},
        "specimen.box": [{"name": "block", "origin": ["-0.4 m", "0 m", "0 m"], "size": ["0.4 m", "0.5 m", "1.2 m"]}],
        "contact.floor_units.normal_dashpot": dashpot,
        "solver.duration": "0.75 s",
        "solver.rows": 1500,
    }
    rows = laboratory.run(scene.load("block-rocking", settings)).history.rows
    leant = 2000.0 * 4.0 * half * high * 0.5 * G * hypot(half, high) * (cos(0.5 * alpha) - cos(alpha))
    before, after = np.interp((0.2, 0.65), rows["time"], rows["kinetic"] - rows["external_work"] + leant)
    assert sqrt(after / before) == pytest.approx(by_hand + more, abs=1.5e-3)


def test_the_balance_closes_at_every_row_and_a_plane_rotor_loses_nothing():
    rows, summary = rocking()
    work = np.abs(rows["external_work"]).max()
    assert work > 0.1 * MASS * G * HALF * HALF
    assert np.abs(rows["imbalance"]).max() < 1e-12 * work
    assert np.abs(rows["rotor"]).max() < 1e-20 * work
    assert summary["energy_imbalance"] < 1e-12


def test_what_contacts_take_up_is_known_and_what_is_not_falls_with_the_step():
    left = []
    for fraction in (0.8, 0.2):
        rows, _ = rocking(fraction)
        terms = [{key: values[row] for key, values in rows.items()} for row in range(len(rows["time"]))]
        left.append(max(abs(open_in_contacts(term)) for term in terms) / np.abs(rows["external_work"]).max())
    assert left[0] < 1e-4
    assert left[1] < 0.3 * left[0], "of first order, as impacts are"


def test_two_steps_agree_on_what_dashpots_dissipate():
    one, two = (rocking(fraction)[0]["dashpot"][-1] for fraction in (0.8, 0.4))
    assert one == pytest.approx(two, rel=1e-3)
    assert one > 0.2 * sqrt(2.0)


def test_a_run_in_real_time_is_judged_by_its_energies():
    _, summary = rocking()
    assert summary["in_real_time"]
    assert summary["energy_j"]["dashpot"] > 0.0 and {"rotor", "redetection", "area"} < summary["energy_j"].keys()
    assert summary["collapse"] is None
    assert summary["dissipation_mismatch"] < 1e-4

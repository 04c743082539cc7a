"""The numbers of a summary, from rows written down by hand: each is worked out beside them, with its limits."""

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from masonry.assembly.assemble import Assembly, assemble
from masonry.laboratory.summary.extremes import rise_at_end
from masonry.laboratory.summary.run_summary import summarise
from masonry.loading.collapse.catching import CaughtFall
from masonry.loading.collapse.factor_path import FactorPath
from masonry.loading.collapse.outcome import CollapseOutcome
from masonry.monitors.events import Event
from masonry.monitors.mode_2_area import TakenInShear
from masonry.monitors.observer import ObserverRecords
from masonry.monitors.reactions import WorkDone
from masonry.results.summary import Summary
from masonry.rows.columns import UNITS
from masonry.rows.history import Frame, History, Standing
from masonry.scene import load
from masonry.timeloop.run_outcome import Outcome
from tests.judgement.frames import frame

SECTION, SETTLE, RAMP = 0.01, 4000, 300
CLOSED = {
    "step": [0, 2000, 4000, 4100, 4200, 4400, 4700, 5000],
    "time": [0.0, 0.02, 0.04, 0.041, 0.042, 0.044, 0.047, 0.05],
    "displacement": [0.0, 0.0, 0.0, 1e-4, 2e-4, 4e-4, 7e-4, 1e-3],
    "stress": [0.0, 0.0, 0.0, 2e5, 4e5, 8e5, 6e5, 5e5],
    "support_stress": [0.0, 0.0, 0.0, 2e5, 4e5, 8e5, 6e5, 5e5],
    "external_work": [0.0, 0.5, 0.5, 1.0, 2.0, 4.0, 7.0, 10.5],
    "contact_work": [0.0, 0.5, 0.5, 1.0, 2.0, 4.0, 7.0, 10.5],
    "elastic_contacts": [0.0, 0.5, 0.5, 1.0, 2.0, 2.0, 1.0, 0.5],
    "fracture_mode_2": [0.0, 0.0, 0.0, 0.0, 0.0, 2.0, 4.0, 5.0],
    "friction": [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 2.0, 5.0],
}
"""A couplet that settles for 4000 steps; its drive comes to its speed in 300, and it cracks after 4200."""


@cache
def couplet(**changes: Any) -> Assembly:
    return assemble(load("couplet").with_({"drive.accuracy": None, "drive.steps": 1000} | changes))


def summary(
    assembly: Assembly | None = None,
    events: tuple[Event, ...] = (),
    last: Frame | None = None,
    **columns: dict[int, float],
) -> Summary:
    """That of the rows, where some columns have other numbers in some rows, with such a last frame."""
    assembly = assembly or couplet()
    rows = {key: np.zeros(8) for key in UNITS} | {key: np.array(values) for key, values in CLOSED.items()}
    for key, values in columns.items():
        for row, value in values.items():
            rows[key][row] = value
    looks = ("unbalanced", "still_moving", "of_a_block", "energy_of_a_block", "block")
    observed = {key: np.zeros(8) for key in (*looks, "rotation", "overlap", "slip", "widest")}
    records = ObserverRecords([WorkDone(np.array([0.5]), np.array([0.5])), TakenInShear(1.0, np.zeros(4))])
    nothing = np.zeros(6)
    standing = Standing(5000, 1e-3, np.zeros((3, 6)), np.zeros((1, 6)), nothing, nothing, np.zeros((4, 3)))
    outcome = Outcome(
        History(rows, [frame(assembly, damage_tension=np.ones(4)), last or frame(assembly)]),
        peak_force=8e5 * SECTION,
        displacement_at_peak=4e-4,
        observed=observed,
        records=records,
        steps=5000,
        events=list(events),
        standing={"end": standing, "peak": standing},
    )
    return summarise(assembly, outcome)


def test_rows_that_close_have_no_doubtful_number():
    numbers = summary()
    zero = ("energy_imbalance", "dissipation_mismatch", "reaction_mismatch_max", "kinetic_over_internal_max")
    zero += ("damping_over_external", "released_over_dissipated", "force_balance", "motion_at_end")
    assert [numbers[key] for key in zero] == [0.0] * len(zero)
    assert numbers["peak_stress_pa"] == pytest.approx(8e5) and numbers["final_stress_pa"] == 5e5
    assert numbers["work_of_drive_j"] == pytest.approx(10.0) and numbers["work_of_loads_j"] == {"traction.0": 0.5}
    assert numbers["work_of_loads_after_settling_j"] == {"traction.0": 0.0}


@pytest.mark.parametrize(("row", "counts"), [(2, False), (3, False), (4, False), (5, True), (7, True)])
def test_ends_and_motion_count_from_the_end_of_the_ramp_on(row, counts):
    """The ramp ends with step 4300."""
    numbers = summary(support_stress={row: CLOSED["stress"][row] + 4e4}, kinetic={row: 0.1})
    assert numbers["reaction_mismatch_max"] == pytest.approx(4e4 / 8e5 * counts)
    assert numbers["kinetic_over_internal_max"] == pytest.approx(0.1 / CLOSED["contact_work"][row] * counts)


@pytest.mark.parametrize(("row", "counts"), [(3, False), (4, True), (5, True)])
def test_they_count_from_the_peak_on_where_it_comes_within_the_ramp(row, counts):
    numbers = summary(stress={4: 9e5}, support_stress={4: 9e5, row: 1e5})
    assert (numbers["reaction_mismatch_max"] > 0.1) == counts


@pytest.mark.parametrize(("row", "counts"), [(3, False), (4, False), (5, True)])
def test_a_drive_to_an_accuracy_counts_from_its_first_damage_on(row, counts):
    assembly = assemble(load("couplet"))
    numbers = summary(assembly, support_stress={row: 1e5}, kinetic={row: 0.1})
    assert (numbers["reaction_mismatch_max"] > 0.1) == (numbers["kinetic_over_internal_max"] > 0.01) == counts


@pytest.mark.parametrize(("row", "counts"), [(4, False), (5, False), (6, False), (7, True)])
def test_the_end_of_a_drive_counts_where_it_waits_there_and_all_stayed_elastic(row, counts):
    wait = Event(first=4300, last=5000, released=0.0, contact=-1)
    still = {"fracture_mode_2": dict.fromkeys(range(8), 0.0), "friction": dict.fromkeys(range(8), 0.0)}
    numbers = summary(assemble(load("couplet")), (wait,), support_stress={row: 1e5}, kinetic={row: 0.2}, **still)
    assert (numbers["reaction_mismatch_max"] > 0.1) == (numbers["kinetic_over_internal_max"] > 0.01) == counts


@pytest.mark.parametrize(("row", "counts"), [(4, True), (5, False), (6, False), (7, True)])
def test_rows_within_a_sudden_crack_do_not_count(row, counts):
    event = Event(first=4200, last=4700, released=0.0, contact=-1)
    numbers = summary(couplet(**{"drive.ramp": 0.0}), (event,), stress={4: 8e5}, support_stress={4: 8e5, row: 1e5})
    assert (numbers["reaction_mismatch_max"] > 0.1) == counts


def test_damping_is_what_was_taken_since_the_settling_over_the_work_since_then():
    numbers = summary(damping={k: 0.3 for k in (1, 2, 3, 4, 5, 6)} | {7: 0.5}, kinetic={7: 0.05})
    assert numbers["damping_over_external"] == pytest.approx((0.2 + 0.05) / 10.0)


@pytest.mark.parametrize(("released", "told"), [(0.99, False), (1.01, True)])
def test_a_sudden_crack_is_told_from_a_thousandth_of_all_energy_lost_on(released, told):
    """Ten J by cracks and friction, and one by damping."""
    event = Event(first=4200, last=4400, released=released * 0.011, contact=1)
    numbers = summary(None, (event,), damping={7: 1.0})
    assert bool(numbers["sudden_cracks"]) == told
    assert numbers["released_over_dissipated"] == pytest.approx(released * 1e-3 * told)
    assert numbers["damping_over_external"] == pytest.approx((1.0 - released * 0.011 * told) / 10.0)
    if told:
        assert numbers["sudden_cracks"][0]["displacement_m"] == 4e-4


@pytest.mark.parametrize(
    ("last", "rise"),
    [(7.9e5, 0.0), (8e5, 0.2 / 3 / 8.0 * 10), (9e5, 0.3 / 3 / 9.0 * 10), (6e5, 0.0)],
    ids=["passed", "as high", "higher", "lower"],
)
def test_the_force_rose_at_the_end_by_what_its_last_tenth_brought(last, rise):
    """The last tenth of 1 mm is a third of the last row's way, from 600 kPa on."""
    assembly = couplet()
    rows = {key: np.array(values) for key, values in CLOSED.items()}
    rows["stress"][-1] = last
    assert rise_at_end(rows, max(8e5, last)) == pytest.approx(rise)
    assert rise_at_end(rows, 0.0) == 0.0, "a force against the drive has no peak"
    rows["displacement"] *= -1.0
    assert rise_at_end(rows, max(8e5, last)) == pytest.approx(rise)
    rows["displacement"][-2] = 0.0
    assert rise_at_end(rows, max(8e5, last)) is None, "a drive that turns back"
    assert rise_at_end(rows | {"displacement": np.zeros(8)}, 8e5) is None
    assert summary(assembly)["rise_at_end"] == 0.0


def test_the_imbalance_is_its_largest_over_the_largest_work():
    assert summary(imbalance={1: -2e-8, 5: 1e-8})["energy_imbalance"] == pytest.approx(2e-8 / 10.5)


def test_the_mismatch_of_the_dissipation_is_what_the_laws_left_out_over_what_they_booked():
    assert summary(friction={7: 4.0})["dissipation_mismatch"] == pytest.approx(1.0 / 9.0)
    assert summary(friction={7: 6.0})["dissipation_mismatch"] == pytest.approx(1.0 / 11.0)
    little = summary(friction={7: 0.05}, fracture_mode_2={7: 0.0}, elastic_contacts={7: 10.0})
    assert little["dissipation_mismatch"] == pytest.approx(0.45 / (0.01 * 10.5)), "a hundredth of the work at least"


@pytest.mark.parametrize(("share", "broken"), [(0.99, False), (1.01, True)])
def test_areas_are_broken_from_95_per_cent_on_and_damaged_from_5(share, broken):
    """Two of four points; damage in tension and in shear make up one."""
    assembly = couplet()
    for limit, key in ((0.95, "broken_area_m2"), (0.05, "damaged_area_m2")):
        combined = np.array([1.0, 1.0, 0.0, 0.0]) * share * limit
        shear = np.full(4, 0.02)
        tension = np.maximum(1.0 - (1.0 - combined) / (1.0 - shear), 0.0)
        last = replace(frame(assembly), damage_shear=shear, damage_tension=tension)
        assert summary(last=last)[key]["unit_unit"] == pytest.approx(0.5 * SECTION * broken)


def test_blocks_that_move_by_a_twentieth_of_the_fastest_belong_to_the_mechanism():
    sets = {"top": np.array([2]), "rest": np.array([0, 1]), "all": np.arange(3)}
    outcome = CollapseOutcome(
        pattern="weight",
        path=FactorPath(accuracy=0.01, most=1.0),
        loops_over=None,
        borne=0.5,
        falls=0.6,
        trials=7,
        leg=1,
        undecided=0,
        falls_by_turning=False,
        swayed=1e-3,
        freely=False,
        mechanism=np.array([0.0505, 0.0495, 1.0]),
        branch=None,
        travel=0.04,
        caught=(CaughtFall(0.3, 0.31, 5e-3, 2), CaughtFall(0.4, 0.41, 8e-3, 1)),
        later=None,
    )
    numbers = outcome.collapse_load({}, sets)
    assert (numbers["moving"], numbers["first"], numbers["sets"]) == (2, 2, ["all", "top"])
    assert (numbers["borne"], numbers["falls"], numbers["trials"], numbers["swayed_over_block"]) == (0.5, 0.6, 7, 1e-3)
    assert (numbers["travel_m"], numbers["moves_from"], numbers["later_m"]) == (0.04, 0.3, None)
    assert numbers["caught"][1] == {"borne": 0.4, "falls": 0.41, "travel_m": 8e-3, "block": 1}

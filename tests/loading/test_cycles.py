"""Drives that turn back and loads that vary: they arrive, stay on the closed form, and never gain energy in a cycle."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from masonry.assembly.assemble import assemble
from masonry.configuration.energy import Seen
from masonry.laboratory import laboratory
from masonry.loading.drive.adaptive import AdaptiveLoading, Controlled
from masonry.loading.programs import rise
from masonry.loading.scheduled import ScheduledLoading
from masonry.rows.cycles import bounds, table
from masonry.scene import load
from tests.loading.test_controlled import COARSE, TERMS
from verification.cases.fracture.joint_that_closes import KEYS
from verification.references.closed_forms import Joint, dissipated_in_tension, unloaded

QUICK = {"settle.steps": 200}
WALL = {"base": "wallette-mode-1", "specimen.divisions": [4, 2], "drive.accuracy": 0.02}
DISSIPATED = ("fracture_mode_1", "fracture_mode_2", "friction")


def test_a_joint_that_opens_closes_and_opens_again_stays_on_its_closed_form():
    rows = laboratory.run(load("couplet", KEYS)).history.rows
    place, widest = rows["displacement"], np.maximum.accumulate(rows["displacement"])
    wanted = [float(unloaded("exponential", Joint(), x, w)) for x, w in zip(place, widest, strict=True)]
    assert rows["stress"] == pytest.approx(np.array(wanted), abs=1e-9 * Joint().fT)
    gone = 0.01 * dissipated_in_tension("exponential", Joint(), 40e-6)
    assert rows["fracture_mode_1"][-1] == pytest.approx(gone, rel=1e-9)
    for turn in (20e-6, 0.0, -8e-6, 40e-6):
        assert np.min(np.abs(place - turn)) < 1e-18, "it is at each of its places, and a row says so"


@settings(max_examples=6, deadline=None, derandomize=True)
@given(st.lists(st.integers(-30, 30), min_size=2, max_size=5), st.sampled_from(["x", "-x"]))
def test_no_cycle_of_any_history_gains_energy(places, direction):
    history = [f"{b * 10} um" for a, b in zip([0, *places], places, strict=False) if a != b]
    if not history:
        return
    over = {**QUICK, "drive.history": history, "drive.direction": direction, "drive.accuracy": 0.05}
    result = laboratory.run(load("couplet", over))
    rows, cycles = result.history.rows, result.summary["cycles"]
    for key in DISSIPATED:
        assert np.min(np.diff(rows[key])) >= -1e-12 * (1e-3 + rows[key][-1])
    for cycle in cycles:
        assert min(cycle[f"{key}_j"] for key in DISSIPATED) >= -1e-12 * (1e-3 + cycle["dissipated_j"])
    if cycles:
        total = sum(rows[key][-1] - rows[key][0] for key in DISSIPATED)
        assert sum(cycle["dissipated_j"] for cycle in cycles) == pytest.approx(total, rel=1e-9, abs=1e-12)
    assert rows["displacement"][-1] == pytest.approx(float(history[-1].split()[0]) * 1e-6, abs=1e-15)
    assert result.summary["energy_imbalance"] < 1e-10


def test_a_wall_that_is_cracked_closed_and_opened_again_softens_and_keeps_its_energy_balance():
    over = {key: value for key, value in WALL.items() if key != "base"}
    history = ["0.06 mm", "-0.01 mm", "0.12 mm", "-0.01 mm", "0 mm"]
    summary = laboratory.run(load("wallette-mode-1", {**over, "drive.history": history})).summary
    first, second = summary["cycles"]
    assert first["closed"] and second["closed"]
    assert 0.0 < first["dissipated_j"] < second["dissipated_j"]
    assert second["stiffness_pa_per_m"] < 0.7 * first["stiffness_pa_per_m"]
    assert 0.0 < first["opening_left_m"] < 0.5 * first["widest_opening_m"], "slipped joints do not close altogether"
    assert first["lowest_stress_pa"] < -0.05e6 and first["highest_stress_pa"] > 0.1e6
    assert summary["energy_imbalance"] < 1e-10 and summary["dissipation_mismatch"] < 0.01
    for key, of_run, extreme in (("lowest", "lowest", min), ("highest", "peak", max)):
        of_cycles = extreme(cycle[f"{key}_stress_pa"] for cycle in summary["cycles"])
        assert summary[f"{of_run}_stress_pa"] == pytest.approx(of_cycles, rel=1e-12)


def test_an_expression_in_steps_and_its_turning_points_to_an_accuracy_take_the_same_energy():
    sine = {"drive.history": "0.1 mm * sin(2 pi t / 1 s) * (1 + ramp(t / 2 s))", "drive.duration": "2 s"}
    runs = [load("couplet", {**QUICK, **sine, **pace}) for pace in ({"drive.steps": 8000}, {"drive.accuracy": 0.01})]
    stepped, paced = (laboratory.run(scene) for scene in runs)
    assert stepped.history.rows["displacement"][-1] == pytest.approx(0.0, abs=1e-18)
    assert stepped.history.rows["displacement"].max() == pytest.approx(max(runs[0].drive.reversals), rel=1e-4)
    one, two = ([cycle["dissipated_j"] for cycle in run.summary["cycles"]] for run in (stepped, paced))
    assert len(one) == 2 and one == pytest.approx(two, rel=1e-3)


@pytest.mark.parametrize(
    ("history", "steps", "cycles"),
    [("0.05 mm * (1 - cos(2 pi t / 1 s))", 5999, 3), ("0.05 mm * sin(2 pi t / 1 s)", 6000, 3)],
)
def test_cycles_in_steps_are_the_same_however_many_rows_there_are(history, steps, cycles):
    over = {**QUICK, "drive.history": history, "drive.duration": "3 s", "drive.steps": steps}
    few, many = (laboratory.run(load("couplet", {**over, "solver.rows": rows})).summary for rows in (10, 1000))
    assert len(few["cycles"]) == len(many["cycles"]) == cycles
    for one, other in zip(few["cycles"], many["cycles"], strict=True):
        assert one["closed"] and other["closed"]
        for key in ("dissipated_j", "external_work_j", "farthest_m", "farthest_back_m", "opening_left_m"):
            assert one[key] == pytest.approx(other[key], rel=1e-9, abs=1e-15)


def test_a_pace_in_steps_goes_on_to_the_same_rows():
    built = assemble(load("couplet-cyclic", {"drive.accuracy": None, "drive.steps": 5000, **QUICK}))
    one, other = (ScheduledLoading(built.model, built.plan, 7) for _ in range(2))
    for _ in range(9):
        one.next()
    other.restore(one.state())
    rest = [[(chunk.steps, chunk.row) for chunk in iter(pace.next, None)] for pace in (one, other)]
    assert rest[0] == rest[1] and sum(row for _, row in rest[0]) > 7


def test_increments_reach_every_turning_point_whatever_the_energies_say():
    assembly = assemble(load("couplet", {"drive.accuracy": 0.05}))
    rng = np.random.default_rng(0)
    turns = (-3e-4, 1e-6, 2e-6, -1e-3, 1e-3)
    plan, place, visited = Controlled(rise(10, 10), turns[0], 0.05, turns), 0.0, []
    pace = AdaptiveLoading(assembly.model, plan, 100, COARSE)
    while (chunk := pace.next()) is not None:
        before = place
        place += chunk.speed[:-1].sum() * assembly.model.dt
        assert np.all(chunk.speed * np.sign(place - before) >= 0.0), "each increment goes one way"
        if chunk.place is not None:
            assert place == pytest.approx(chunk.place, abs=1e-14) and chunk.speed[-1] == 0.0
            visited.append(chunk.place)
        force, *energies = (float(x) for x in rng.lognormal(0, 1, 7))
        seen = Seen(*rng.lognormal(0, 1, (4, len(assembly.model.group))))
        pace.look(force, 0.9 * force, seen, dict(zip(TERMS, energies, strict=True)))
    assert tuple(visited) == turns
    assert pace.progress() == (1_000_000, 1_000_000)


def test_a_pace_goes_on_from_what_it_remembers():
    assembly = assemble(load("couplet-cyclic", {"settle.steps": 10}))
    plan = assembly.plan
    one, other = (AdaptiveLoading(assembly.model, plan, 100) for _ in range(2))
    for _ in range(12):
        one.next()
    other.restore(one.state())
    for _ in range(5):
        a, b = one.next(), other.next()
        assert np.array_equal(a.speed, b.speed) and a.place == b.place


@pytest.mark.parametrize(
    ("places", "wanted"),
    [
        ([0, 2, 0, -1, 0, 2, 4], [0, 4, 6]),
        ([0, 0, 0, 2, 0, -1, 0, 2], [2, 6, 7]),
        ([0, 1, 0, 1, 0], [0, 2, 4]),
        ([0, -2, 2, -2, 4, 0], [0, 2.5, 5]),
        ([0, 1, -1, 1, 1], [0, 2.5, 4]),
        ([0, 2, 1e-5, 2, -1e-5, 2, 1e-5], [0, 2, 4, 6]),
        ([0, 1, -1, 1e-5, -1, 1], [0, 4.5, 5]),
    ],
)
def test_a_cycle_ends_where_the_drive_leaves_its_start_the_way_it_left_it_first(places, wanted):
    assert bounds(np.array(places, dtype=float)) == wanted


@pytest.mark.parametrize(
    ("places", "wanted"),
    [
        ([0, 3, 2, 3, 2], [0, 1, 3, 4]),
        ([0, 1e-5, 1e-3, 2, 1, 2], [0, 3, 5]),
        ([0, -2, -8, -8, -2, -8], [0, 3, 5]),
        ([0, 5, 2, 9, 4, 12], [0, 1, 3, 5]),
        ([0, 5, 2, 4], [0, 3]),
        ([0, 8, 2, 8, 0], [0, 4]),
    ],
)
def test_where_the_drive_never_comes_back_cycles_go_from_turn_to_turn(places, wanted):
    assert bounds(np.array(places, dtype=float)) == wanted


def test_a_drive_that_goes_one_way_makes_no_cycle():
    rows = {"displacement": np.linspace(0, 1, 5), "stress": np.zeros(5)}
    assert table(rows, np.zeros(5)) == []


@pytest.mark.slow
def test_the_shipped_wallette_keeps_to_a_run_four_times_as_careful():
    shipped, careful = (laboratory.run(load("wallette-cyclic", {"drive.accuracy": a})).summary for a in (0.01, 0.0025))
    assert shipped["peak_stress_pa"] == pytest.approx(careful["peak_stress_pa"], rel=0.01)
    for one, other in zip(shipped["cycles"], careful["cycles"], strict=True):
        assert one["dissipated_j"] == pytest.approx(other["dissipated_j"], rel=0.02), "it leaves its symmetry later"
        assert one["opening_left_m"] == pytest.approx(other["opening_left_m"], abs=1e-6)
    whole, careful_whole = (sum(cycle["dissipated_j"] for cycle in run["cycles"]) for run in (shipped, careful))
    assert whole == pytest.approx(careful_whole, rel=0.01)
    assert shipped["energy_imbalance"] < 1e-6 and shipped["reaction_mismatch_max"] < 0.02

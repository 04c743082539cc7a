"""What a load goes by, part by part, without a run: enclosing, pace, ways, drift, brakes, limits of rest and leaps."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from masonry.assembly.assemble import assemble
from masonry.configuration import energy
from masonry.configuration.energy import Seen
from masonry.loading import crack_watch, scheduled
from masonry.loading.collapse import phases
from masonry.loading.collapse.enclosing import Enclosing
from masonry.loading.collapse.factor_path import FactorPath
from masonry.loading.collapse.growing_settings import GROWING
from masonry.loading.collapse.pace import Pace
from masonry.loading.collapse.watching import FallWatch
from masonry.loading.drive.utilisation import utilisation
from masonry.loading.moves.drift import Drift
from masonry.loading.moves.moved import places, reach, relative_travel
from masonry.loading.programs import landmarks, passage, steps_at
from masonry.loading.scheduled import Program, ScheduledLoading
from masonry.loading.varying_loads import SharedLoads, knots
from masonry.scene import load

STEPWISE = {"drive.accuracy": None, "drive.steps": 100}


def enclosed(path: FactorPath, falls_from: float) -> tuple[Enclosing, list[float]]:
    """The search for a factor that is borne below a bound, and what it tried."""
    search, tried = Enclosing(path, 0.0, GROWING), []
    for _ in range(200):
        search.begin()
        tried.append(search.tried)
        if abs(search.tried) <= falls_from:
            search.bear()
            if not search.go_on():
                return search, tried
        else:
            search.fail()
            if search.is_narrow:
                return search, tried
            search.go_on()
    raise AssertionError("no end")


@pytest.mark.parametrize("limit", [3e-3, 0.0411, 0.37, 1.0, 29.0])
@pytest.mark.parametrize("accuracy", [0.02, 1e-3])
def test_a_factor_is_enclosed_to_the_accuracy_from_both_sides_in_few_trials(limit, accuracy):
    search, tried = enclosed(FactorPath(accuracy, 100.0), limit)
    assert search.stands <= limit < search.falls
    assert search.falls - search.stands <= accuracy * search.falls * (1.0 + 1e-12)
    assert tried[0] == pytest.approx(0.0103)
    ups = [b - a for a, b in zip(tried, tried[1:], strict=False) if b <= limit]
    assert all(step <= max(0.0103, 0.5 * b) * (1.0 + 1e-9) for step, b in zip(ups, tried[1:], strict=False))
    assert len(tried) < 12 + np.log2(max(limit, 0.0103) / 0.0103) + np.log2(1.0 / accuracy)
    first = next(k for k, factor in enumerate(tried) if factor > limit)
    assert tried[first + 1] == pytest.approx(0.5 * (tried[first] + max([0.0, *tried[:first]])))
    assert (search.borne, search.fallen, search.trials) == (search.stands, search.falls, len(tried))


def test_a_load_that_ends_before_it_falls_is_borne_whole():
    search, tried = enclosed(FactorPath(0.01, 0.5), 9.0)
    assert search.borne == tried[-1] == 0.5 and search.fallen is None


def test_a_load_to_and_fro_goes_through_its_turns_and_is_enclosed_by_the_greatest_that_was_borne():
    path = FactorPath(0.05, 100.0, reversals=(0.5, -0.5, 0.2))
    search, tried = enclosed(path, 9.0)
    assert {0.5, -0.5, 0.2} <= set(tried) and search.borne == 0.2
    assert np.abs(np.diff([0.0, *tried])).max() <= 0.05 + 1e-12, "a twentieth of all it goes through, at most"
    search, tried = enclosed(replace(path, reversals=(0.5, -1.0)), 0.6)
    assert search.fallen == pytest.approx(-0.6, abs=0.05 * 0.65) and abs(search.borne) <= 0.6
    assert abs(search.fallen - search.borne) <= 0.05 * 0.65


def test_a_fall_that_is_borne_from_nearer_is_taken_back():
    search = Enclosing(FactorPath(0.01, 100.0), 0.0, GROWING)
    search.stands, search.falls, search.target = 1.0, 1.2, 1.3
    search.bear()
    assert search.falls == np.inf and search.stands == 1.3
    assert search.increment == pytest.approx(2.0 * 0.5 * 0.01 * 1.3)


def test_increments_take_longer_in_proportion_to_what_damping_took_beyond_twice_the_accuracy():
    pace = Pace(0.01, GROWING)
    pace.learn(10.0, 0.3)  # 3 % where 2 % is aimed at
    assert pace.slower == pytest.approx(1.5)
    pace.learn(-20.0, 0.375)  # of a mean work of 15 J: a quarter more
    assert pace.slower == pytest.approx(1.5 * 1.25)
    pace.learn(15.0, 30.0)  # twice at most
    assert pace.slower == pytest.approx(1.5 * 1.25 * 2.0)
    pace.learn(15.0, 0.0)
    assert pace.slower == pytest.approx(1.5 * 1.25 * 2.0 * 0.7)
    for _ in range(20):
        pace.learn(15.0, 0.0)
    assert pace.slower == 1.0
    for _ in range(20):
        pace.learn(15.0, 15.0)
    assert pace.slower == 64.0


def test_a_passage_is_at_rest_at_each_turn_and_its_greatest_speed_is_the_rate():
    turns, rate, dt = (1e-3, -0.5e-3, 0.2e-3), 0.01, 1e-5
    way = passage(turns, steps_at(rate, dt, turns))
    speed = np.diff(way) / dt
    assert way[0] == 0.0 and way[-1] == pytest.approx(turns[-1], abs=1e-18)
    assert np.abs(speed).max() == pytest.approx(rate, rel=1e-3)
    for turn in turns[:-1]:
        k = int(np.argmin(np.abs(way - turn)))
        assert way[k] == pytest.approx(turn, abs=1e-15) and np.abs(speed[k - 1 : k + 1]).max() < 1e-3 * rate


def test_rows_do_not_miss_turns_nor_the_way_through_the_start():
    """Out of the start, to 3 and a stop there, through the start to -2, and back."""
    places = np.array([0.0, 1.0, 2.0, 3.0, 3.0, 2.0, 1.0, -1.0, -2.0, -1.5])
    assert landmarks(places).tolist() == [0, 1, 3, 4, 6, 7, 8]
    assert landmarks(np.array([0.0, 1.0, 2.0, 3.0])).tolist() == [0, 1]


@pytest.mark.parametrize("straight", [1e-2, 1e-4])
def test_between_knots_a_history_leaves_its_line_by_no_more_than_it_may(straight):
    history = np.sin(np.linspace(0.0, 9.0, 3001))[None] * 5.0
    at = knots(history, 100, straight)
    line = np.interp(np.arange(3001), at, history[0, at])
    off = np.abs(line - history[0]).max() / 5.0
    assert off <= straight and np.diff(at).max() <= 200 and 100 in at
    assert len(knots(0.0 * history, 0, straight)) == 3000 // 200 + 1


def test_loads_pass_from_factor_to_factor_as_the_steps_do():
    """Two histories on one block: what it bears at the start, and by how much that changes."""
    model = assemble(
        load("arch").with_({"limit": {"pattern": "weight", "direction": "x", "accuracy": 0.01}, "settle": None})
    ).model
    body = model.bodies.rigid
    one = model.varying[0]["rigid"]
    still = body.load.copy()
    shared = SharedLoads(model)
    up = np.abs(still[:, :3]).sum() / np.abs(one[:, :3]).sum()
    assert shared.rest_over_each() == pytest.approx(up) == pytest.approx(1.0)
    passed = shared.pass_over(np.array([0.2]), np.array([0.5]), 4)
    assert passed == pytest.approx([0.0, 0.25, 0.5, 0.75, 1.0])
    assert body.load == pytest.approx(still + 0.2 * one) and body.change == pytest.approx(0.3 * one)


def test_how_far_blocks_moved_counts_turns_by_a_length():
    model = assemble(load("arch")).model
    model.bodies.rigid.q[3] = 3e-3, 0.0, 4e-3, 0.0, 0.05, 0.0
    model.bodies.rigid.q[5] = 0.0, 1e-3, 0.0, 0.0, 0.0, 0.0
    moved = places(model, 0.2)
    assert reach(moved[0]) == pytest.approx(np.hypot(5e-3, 0.2 * 0.05))
    found = relative_travel(model, moved)
    which = model.layout.members["rigid"]
    assert (found[which[3]], found[which[5]]) == (1.0, pytest.approx(1e-3 / reach(moved[0])))
    assert np.count_nonzero(found) == 2


def test_a_drift_is_told_from_a_swing_by_the_masses_and_the_swing_alone_is_braked():
    """v = 3 m + w with m M w = 0, and 5 m + 3 w a step earlier: the drift is 4, the swing 2 w. It is left by its share;
    what that takes is booked by half of it times the velocities before."""
    model = assemble(load("arch")).model
    body, rng = model.bodies.rigid, np.random.default_rng(1)
    mass = model.masses["rigid"]
    free = body.dt_over_mass > 0.0
    mechanism = np.where(free, rng.normal(size=body.v.shape), 0.0)
    swing = np.where(free, rng.normal(size=body.v.shape), 0.0)
    swing -= mechanism * np.sum(mass * mechanism * swing) / np.sum(mass * mechanism**2)
    body.v[...] = 3.0 * mechanism + swing
    before = [5.0 * mechanism + 3.0 * swing]
    kinetic = energy.kinetic(model, before)
    drift = Drift({"rigid": mechanism}, 0.9)
    assert drift.brake(model, before, 0.4) == pytest.approx(4.0)
    assert body.v == pytest.approx(3.0 * mechanism + swing - 0.6 * 2.0 * swing)
    gained = energy.kinetic(model, before) - kinetic  # the bilinear form, by which the ledger closes
    assert body.work[:, 1].sum() == pytest.approx(gained) and gained < 0.0
    assert body.hold[free] == pytest.approx((mass * -1.2 * swing / model.dt)[free])
    body.q[...] = 0.0
    drift.look(model)
    body.q[...] = 2.0 * swing
    drift.look(model)
    assert drift.moved["rigid"] == pytest.approx(0.9 * mechanism + 2.0 * swing)


@pytest.mark.parametrize(
    ("narrow", "can_lead", "goes_on", "phase", "is_put_back"),
    [
        (False, False, True, "rising", True),
        (False, False, False, "end", True),
        (True, True, True, "leading", True),
        (True, False, True, "dropping", False),
    ],
)
def test_what_is_not_borne_is_tried_again_from_the_last_rest_until_the_factor_is_enclosed(
    narrow, can_lead, goes_on, phase, is_put_back
):
    calls = []
    trials = SimpleNamespace(
        settings=GROWING,
        freely=False,
        travels=SimpleNamespace(size=0.1),
        branch=object(),
        enclosing=SimpleNamespace(is_narrow=narrow, go_on=lambda: goes_on),
        fail=lambda turning: calls.append("fail"),
        can_lead=lambda: can_lead,
        put_back=lambda: calls.append("put back"),
        begin=lambda: calls.append("begin"),
    )
    assert phases.not_borne(trials).name == phase
    assert ("put back" in calls) == is_put_back and ("begin" in calls) == (phase == "rising")


def gathering(travels: list[float]) -> list[bool]:
    """Whether a specimen accelerates by these travels, a window of ten looks each."""
    watched = FallWatch(SimpleNamespace(damping=0.8), GROWING)
    return [watched.accelerates(travel) for travel in np.repeat(travels, 10)][9::10]


@pytest.mark.parametrize(("faster", "falls"), [(1.19, False), (1.21, True)])
def test_what_goes_a_fifth_further_in_the_last_third_than_in_the_one_before_accelerates(faster, falls):
    assert gathering([0.0, 1.0, 1.5, 2.0, 2.5, 2.0 + faster])[-1] is not None
    third = [0.0, 1.0, 0.0, 2.0, 0.0, 2.0 + faster]  # the last of each third counts
    assert gathering(third) == [False] * 5 + [falls]


@pytest.mark.parametrize(("kinetic", "leaps"), [(0.99, False), (1.01, True)])
def test_a_leap_is_ten_times_the_usual_energy_or_a_hundred_thousandth_of_what_is_stored(kinetic, leaps, monkeypatch):
    watch = crack_watch.CrackWatch(assemble(load("couplet").with_(STEPWISE)).model)
    monkeypatch.setattr(watch.cracks, "anything_dissipated", lambda: True)
    watch.usual = 1.0
    watch.see(2.0)
    assert watch.leaps(kinetic * 10.0 * 0.3, 0.3) == leaps
    assert watch.leaps(kinetic * 1e-5 * 2.0, 1e-9) == leaps
    watch.see(0.01)  # it came apart: a fiftieth of the most that was stored
    assert watch.leaps(kinetic * 1e-5 * 0.02 * 2.0, 1e-12) == leaps
    watch.learning = 1
    assert not watch.leaps(1e9, 0.0)


@pytest.mark.parametrize(("share", "rests"), [(0.99, True), (1.01, False)])
def test_the_drive_goes_on_when_twenty_brakings_on_end_found_it_still(share, rests, monkeypatch):
    watch = crack_watch.CrackWatch(assemble(load("couplet").with_(STEPWISE)).model)
    watch.see(3.0)
    watch.hold(10)
    monkeypatch.setattr(crack_watch, "brake", lambda *_: None)
    kinetic = [1.0] + [share * 1e-7 * 3.0] * 19
    monkeypatch.setattr(crack_watch.energy, "kinetic", lambda *_: kinetic.pop(0) if kinetic else share * 1e-7 * 3.0)
    held = []
    for step in range(21):
        watch.look(step, 0.0, [])
        held.append(bool(watch.pause))
    assert held == [True] * 20 + [not rests]


@pytest.mark.parametrize(
    ("share", "of_one", "rests"), [(0.99, 0.99, True), (1.01, 0.0, False), (0.0, 1.01, False), (0.99, 1.01, False)]
)
def test_all_is_at_rest_after_twenty_rows_below_a_hundred_millionth_of_the_largest_energy(
    share, of_one, rests, monkeypatch
):
    """Of all together; each block may have a hundred times that of its own part."""
    monkeypatch.setattr(scheduled, "left_of_motion", lambda model, most: np.array([0.0, of_one * 1e-6]))
    program = Program(np.ones(1001), np.zeros(1001), 0, 0, rest_from=0)
    loading = ScheduledLoading(None, program, 100)
    loading.done = 1  # all that moves it is at its end
    loading.look(0.0, 0.0, None, {"kinetic": 5.0})
    for row in range(20):
        assert loading.last == 1000, row
        loading.look(0.0, 0.0, None, {"kinetic": share * 5e-8})
    assert (loading.last < 1000) == rests


def test_a_contact_is_used_by_its_shear_over_coulomb_and_by_its_tension_since_the_settling():
    """c = 0.87 MPa, tangent 1.01, f_t = 0.58 MPa; it rested under a pressure of 0.5 MPa."""
    model, none = assemble(load("couplet")).model, np.zeros(4)
    rested = np.full(4, -0.5e6)

    def used(sigma: float, tau: float) -> float:
        one = np.array([1.0, 0.0, 0.0, 0.0])
        seen = Seen(none, none, np.where(one > 0.0, sigma, -0.5e6), tau * one)
        return utilisation(model, seen, rested)

    assert used(-0.5e6, 0.3e6) == pytest.approx(0.3 / (0.87 + 1.01 * 0.5))
    assert used(0.04e6, 0.0) == pytest.approx(0.54 / 1.08)
    assert used(0.2e6, 0.6e6) == pytest.approx(0.6 / (0.87 - 1.01 * 0.2))
    assert used(-0.5e6, 3e6) == 1.0

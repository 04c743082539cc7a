"""Rows, peaks and checkpoints of the loop, by hand: what a row says, which frame is that of the peak, when to write."""

from types import SimpleNamespace

import numpy as np
import pytest

from masonry.assembly.assemble import assemble
from masonry.configuration import energy
from masonry.configuration.chunk import Chunk
from masonry.rows.history import History
from masonry.scene import load
from masonry.timeloop import checkpointer as module
from masonry.timeloop.checkpointer import Checkpointer
from masonry.timeloop.loop import Loop
from masonry.timeloop.run_outcome import Outcome
from tests.kinematics.bricks import turn


def loop_of(**changes) -> Loop:
    """The loop of a couplet, before its first step."""
    scene = load("couplet").with_({"drive.accuracy": None, "drive.steps": 100} | changes)
    built = assemble(scene)
    loading = built.plan.loading(built.model, 10)
    return Loop(built.model, loading, built.plan.settle, built.recording, 1, Outcome(History()))


@pytest.mark.parametrize(("direction", "sign"), [("x", 1.0), ("-x", -1.0)])
def test_a_row_has_the_forces_at_drive_and_support_over_the_section_along_the_drive(direction, sign):
    loop = loop_of(**{"drive.direction": direction})
    loop.model.bodies.rigid.hold[1, 0], loop.model.bodies.rigid.hold[0, 0] = sign * 300.0, sign * -295.0
    loop.place = sign * 2e-4
    row = loop.drive(7, [1.0])
    assert (row["step"], row["time"], row["displacement"]) == (7, 7 * loop.model.dt, pytest.approx(2e-4))
    assert row["stress"] == pytest.approx(300.0 / 0.01) and row["force"] == pytest.approx(300.0)
    assert row["support_stress"] == pytest.approx(295.0 / 0.01)


def test_dead_loads_along_the_drive_count_with_its_support():
    """The confinement of 5 kN presses down, as the drive does."""
    loop = loop_of(**{"drive.direction": "-z"})
    loop.model.bodies.rigid.hold[1, 2], loop.model.bodies.rigid.hold[0, 2] = -700.0, 5700.0
    row = loop.drive(0, [1.0])
    assert row["stress"] == pytest.approx(700.0 / 0.01)
    assert row["support_stress"] == pytest.approx((5700.0 - 5000.0) / 0.01)
    assert loop.drive(0, [0.5])["support_stress"] == pytest.approx((5700.0 - 2500.0) / 0.01)


def test_the_peak_is_looked_for_at_each_step_and_counts_where_the_first_was_within_a_thousandth():
    loop = loop_of()
    loop.peak.see(np.array([0.0, 1.0, 2.0, 3.0]), np.array([10.0, 99.95, 100.0, 50.0]), True, False)
    assert (loop.outcome.peak_force, loop.outcome.displacement_at_peak) == (100.0, 1.0)
    loop.peak.see(np.array([4.0, 5.0]), np.array([100.04, -7.0]), False, False)
    assert (loop.outcome.peak_force, loop.outcome.displacement_at_peak) == (100.04, 1.0)
    assert (loop.outcome.lowest_force, loop.outcome.displacement_at_lowest) == (-7.0, 5.0)
    loop.peak.see(np.array([6.0, 7.0]), np.array([100.2, 3.0]), False, False)
    assert (loop.outcome.peak_force, loop.outcome.displacement_at_peak) == (100.2, 6.0)


def test_a_drive_that_turns_back_has_its_extremes_in_rows_of_the_curve():
    place = np.array([0.0, 1.0, 2.0, 1.0, 0.0, -1.0, -2.0, -1.0])
    force = np.array([0.0, 99.95, 100.0, 40.0, -10.0, -60.0, -50.0, 0.0])
    rows = {"step": np.arange(8.0), "displacement": place, "force": force, "stress": 10.0 * force}
    outcome = Outcome(History(rows), 140.0, 1.5, lowest_force=-75.0, displacement_at_lowest=-0.5)
    outcome.take_extremes_of_rows()
    assert (outcome.peak_force, outcome.displacement_at_peak) == (100.0, 2.0), "neither between rows, nor near to it"
    assert (outcome.lowest_force, outcome.displacement_at_lowest) == (-60.0, -1.0)
    outcome.history.rows = {key: values[:3] for key, values in rows.items()}
    outcome.peak_force = 140.0
    outcome.take_extremes_of_rows()
    assert outcome.peak_force == 140.0, "a drive that goes one way"


def test_the_frame_of_the_peak_is_the_first_of_those_within_a_thousandth_of_it():
    loop, kept, taken = loop_of(), [], []
    for number, stress in enumerate((50.0, 99.95, 99.951, 100.0, 100.04, 100.2)):
        taken.append(loop.peak.shows_more(stress))
        if taken[-1]:
            loop.peak.near.append((stress, f"frame {number}", f"standing {number}"))
        loop.peak.keep(stress)
        kept.append((loop.peak.near[0][1], len(loop.peak.near)))
    assert taken == [True, True, False, True, True, True], "none is higher by less than a ten thousandth"
    assert kept == [("frame 0", 1), *[("frame 1", n) for n in (1, 1, 2, 3)], ("frame 5", 1)]
    assert loop.outcome.standing["peak"] == "standing 5"


def test_the_place_of_the_drive_is_the_sum_of_its_way_or_what_the_loading_knows_better(monkeypatch):
    loop, taken = loop_of(), []
    monkeypatch.setattr(loop.configuration, "advance", lambda *args: taken.append(args[2:4]))
    loop.take_steps(4000, Chunk(np.ones(4), np.array([0.0, 1.0, 2.0, 3.0]), True))
    assert loop.place == pytest.approx(3.0 * loop.model.dt) and taken == [(0, 2), (2, 1)]
    loop.take_steps(4003, Chunk(np.full(3, 1.7), np.array([3.0, 3.0, 0.0]), True, place=0.125))
    assert loop.place == 0.125 and loop.dead_load_factor == 1.0


@pytest.mark.parametrize(("every", "first"), [(600.0, 60.0), (10.0, 10.0)])
def test_checkpoints_come_after_a_minute_at_the_latest_and_then_at_their_distance(every, first, monkeypatch):
    clock, written = [1000.0], []
    monkeypatch.setattr(module.time, "monotonic", lambda: clock[0])
    monkeypatch.setattr(module.model_state, "fingerprint", lambda model: "one")
    monkeypatch.setattr(module.model_state, "state", lambda model: {})
    folder = SimpleNamespace(write=lambda state: written.append(clock[0] - 1000.0), states=list)
    asked = [False]
    looks, run = Checkpointer(folder, {}, every, lambda: asked[0]), SimpleNamespace(state=dict)
    assert not looks.start(None, run)
    for passed in (first - 0.1, first, first + 1.0, first + every - 0.1, first + every):
        clock[0] = 1000.0 + passed
        assert not looks.look(run)
    assert written == [first, first + every] and looks.written == 2
    asked[0] = True
    assert looks.look(run) and len(written) == 3, "where it is asked to end it writes at once"


@pytest.mark.parametrize("way", [np.eye(3), turn(0, 0.7) @ turn(1, 1.1) @ turn(2, -2.0)], ids=["straight", "askew"])
def test_what_contacts_show_and_store_is_that_of_their_springs(way):
    """Opened by 2, closed by 3 um, slid by 4 and 5 um along x and y: k d^2 / 2 on each quarter of 0.01 m2; seen from
    anywhere."""
    built = assemble(load("couplet", {"law": "elastic", "confinement": "0 MPa"}))
    model, kn, ks = built.model, 150e9, 70e9
    moved = np.array([[0.0, 0.0, 2e-6], [0.0, 0.0, -3e-6], [4e-6, 0.0, 0.0], [3e-6, 4e-6, 1e-6]])
    sides, stress = model.contacts.sides[:, 1].astype(int), moved * [ks, ks, kn]
    model.contacts.normal[...] = way[:, 2]
    model.contacts.u[sides, :3] = moved @ way.T
    model.contacts.force[:, :3] = stress @ way.T * model.contacts.area[:, None]
    found = energy.observe(model)
    assert found.seen.opening == pytest.approx(moved[:, 2], abs=1e-18)
    assert found.seen.slip == pytest.approx([0.0, 0.0, 4e-6, 5e-6], abs=1e-13)
    assert found.seen.sigma == pytest.approx(kn * moved[:, 2], abs=1e-6)
    assert found.seen.tau == pytest.approx([0.0, 0.0, ks * 4e-6, ks * 5e-6], abs=0.1)
    assert found.elastic_contacts == pytest.approx(0.5 * 0.0025 * float(np.sum(stress * moved)))

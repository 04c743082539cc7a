"""A drive paced by its error: it arrives, keeps its word, costs few steps, and its guide neither drags nor rings."""

from dataclasses import replace

import numpy as np
import pytest

from masonry.assembly.assemble import assemble
from masonry.configuration.energy import Seen
from masonry.errors import SceneError
from masonry.kinematics.motion import Guided, resist
from masonry.laboratory import laboratory
from masonry.laboratory.text import accuracy_text
from masonry.loading.drive.adaptive import AdaptiveLoading, Controlled
from masonry.loading.drive.adaptive_settings import SETTINGS
from masonry.loading.drive.increments import DriveRow
from masonry.loading.programs import rise
from masonry.scene import load
from tests.couplet.curve import couplet as curve_of
from tests.timeloop.test_loop import bits, corner_numbers, couplet
from tests.timeloop.test_loop import load as load_text
from verification import timed_run
from verification.convergence.joint_in_tension import SCENE as PULLED_APART
from verification.references.closed_forms import Joint


@pytest.mark.parametrize("kinematics", ["rigid", "affine", "tets"])
@pytest.mark.parametrize("direction", ["x", "-x"])
def test_the_drive_makes_exactly_the_asked_displacement(kinematics, direction):
    text = couplet(kinematics, settle=200, displacement="0.05 mm", direction=direction, pace='accuracy = "5 %"')
    result = laboratory.run(load_text(text))
    rows, frame = result.history.rows, result.history.frames[-1]
    top = np.unique(np.concatenate([corner_numbers(result, b) for b in result.specimen.sets["top"]]))
    assert frame.corners[top, 0] == pytest.approx((-1.0 if direction == "-x" else 1.0) * 5e-5, rel=1e-10)
    assert rows["displacement"][-1] == pytest.approx(5e-5, rel=1e-10)
    assert np.diff(rows["displacement"]).min() >= 0.0
    assert result.summary["energy_imbalance"] < 1e-10, "the guide's forces are booked as any other"


@pytest.mark.slow
def test_a_drive_of_several_block_lengths_arrives_and_is_not_taken_for_an_instability():
    """Its increments keep below the share of a block in a step that the watch calls a leap."""
    tough = {
        "contact.unit_unit.fracture_energy_mode_2": "73000 N/m",
        "drive.displacement": "0.7 m",
        "solver.slip_limit": 10,
    }
    result = laboratory.run(load("couplet", tough))
    assert result.history.rows["displacement"][-1] == pytest.approx(0.7, rel=1e-10)
    assert result.summary["peak_stress_pa"] == pytest.approx(0.87e6 + 1.01 * 0.5e6, rel=1e-3)


def test_one_and_two_threads_give_the_same_bits():
    scene = load_text(couplet("rigid", settle=200, displacement="0.05 mm", pace='accuracy = "5 %"'))
    assert bits(laboratory.run(scene, threads=1)) == bits(laboratory.run(scene, threads=2))


@pytest.mark.parametrize("accuracy", [0.05, 0.01])
def test_the_shipped_couplet_keeps_the_accuracy_that_was_asked(accuracy):
    scene = load("couplet", {"drive.accuracy": accuracy})
    result = laboratory.run(scene)
    rows = result.history.rows
    after = rows["step"] > scene.settle.steps
    wanted = curve_of("exponential", Joint(), rows["displacement"][after], 0.5e6)
    assert np.abs(rows["stress"][after] - wanted).max() < accuracy * wanted.max()
    assert result.summary["peak_stress_pa"] == pytest.approx(1.375e6, rel=accuracy)


COARSE = replace(SETTINGS, finest=2_000)
"""Of random energies every increment is the finest there is."""
TERMS = ("damping", "elastic_blocks", "elastic_contacts", "fracture_mode_1", "fracture_mode_2", "kinetic")


def elastic_wall(pace: str):
    over = {"drive.displacement": "0.002 mm", "contact.unit_unit.law": "elastic", "contact.within_units.law": "elastic"}
    scene = load("wallette-mode-1", over)
    drive = scene.drive.model_copy(update={"rate": None, "accuracy": None, "steps": None, **eval_pace(pace)})
    return laboratory.run(scene.model_copy(update={"drive": drive}))


def eval_pace(pace: str) -> dict:
    key, value = pace.split("=")
    return {key: float(value) if key == "accuracy" else int(value)}


def test_while_elastic_a_guided_drive_meets_no_drag():
    guided, slow = elastic_wall("accuracy=0.05"), elastic_wall("steps=60000")
    assert guided.summary["steps"] <= 5250
    stiffness = [r.history.rows["stress"][-1] / r.history.rows["displacement"][-1] for r in (guided, slow)]
    assert stiffness[0] == pytest.approx(stiffness[1], rel=2e-4)
    assert guided.summary["reaction_mismatch_max"] < 3e-4
    assert guided.summary["kinetic_over_internal_max"] < 1e-6 and guided.verdict == "sound", "it has come to rest"


def test_a_tighter_accuracy_takes_smaller_increments_and_says_so():
    done = [laboratory.run(load("wallette-mode-2", {"drive.accuracy": a})).summary for a in (0.05, 0.005)]
    assert done[1]["steps"] > 1.5 * done[0]["steps"]
    control = done[1]["control"]
    assert control["accuracy"] == 0.005
    assert control["increments"] * SETTINGS.steps == pytest.approx(done[1]["steps"], rel=0.01)
    assert done[0]["dissipation_mismatch"] < 0.02 and done[1]["peak_stress_pa"] < done[0]["peak_stress_pa"] * 1.001


def test_the_unexpected_part_of_a_velocity_decays_as_leapfrog_with_a_viscosity_does():
    damping, v, mass, stiffness, dt = Guided(0.1, 0.0), 1.0, 2.0, 3.0, 0.2
    place, peaks = 0.0, []
    for _ in range(60):
        place += dt * v
        force = -stiffness * place
        before = v
        v += dt / mass * (force + resist(damping, dt / mass, force, v, 0.0, 0.0))
        if before > 0.0 >= v:
            peaks.append(place)
    c = 2 * 0.1 / dt  # viscosity over mass; the discrete root of z^2 (1 + b) - (2 - (w dt)^2) z + 1 - b = 0
    ratio = ((1 - 0.1) / (1 + 0.1)) ** 0.5
    turn = np.arccos((2 - stiffness / mass * dt**2) / (2 * np.sqrt((1 - 0.1) * (1 + 0.1))))
    assert c > 0 and len(peaks) >= 2
    assert peaks[1] / peaks[0] == pytest.approx(ratio ** (2 * np.pi / turn), rel=0.05)


def test_what_is_expected_needs_no_force():
    assert resist(Guided(0.2, 0.0), 0.5, 0.0, 3.0, 3.0, 3.0) == pytest.approx(0.0, abs=1e-15)
    assert resist(Guided(0.2, 0.0), 0.5, 0.0, 3.0, 4.0, 3.0) == pytest.approx(2.0), "it follows a faster drive at once"


def test_increments_add_up_whatever_the_energies_say():
    scene = load("wallette-mode-1", {"drive.accuracy": 0.05})
    assembly = assemble(scene)
    rng = np.random.default_rng(0)
    pace, moved = AdaptiveLoading(assembly.model, Controlled(rise(10, 10), -3e-4, 0.05), 100, COARSE), 0.0
    while (chunk := pace.next()) is not None:
        moved += chunk.speed[:-1].sum() * assembly.model.dt
        assert np.all(chunk.speed <= 0.0)
        force, *energies = (float(x) for x in rng.lognormal(0, 3, 7))
        seen = Seen(*rng.lognormal(0, 3, (4, len(assembly.model.group))))
        pace.look(force, 0.9 * force, seen, dict(zip(TERMS, energies, strict=True)))
    assert moved == pytest.approx(-3e-4, rel=1e-10)


@pytest.mark.parametrize(
    ("over", "words"),
    [
        (["drive.accuracy=0 %"], "accuracy"),
        (["drive.accuracy=50 %"], "accuracy"),
        (["drive.accuracy=fine"], "accuracy"),
        (["drive.accuracy=1 %", "solver.masses=real"], "real masses"),
    ],
)
def test_what_cannot_be_asked_is_said(over, words):
    with pytest.raises(SceneError, match=words):
        load("wallette-mode-1", over)


def test_where_all_motion_is_prescribed_an_increment_takes_few_steps():
    summary = laboratory.run(load("couplet", {"drive.accuracy": 0.01})).summary
    assert summary["steps"] < 4000 + 800, "4000 of them settle the confinement"
    assert summary["peak_stress_pa"] == pytest.approx(1.375e6, rel=1e-3)
    assert summary["control"]["largest_lag"] < 1e-9, "nothing lags where nothing is free to"


def test_the_drive_slows_down_before_the_first_crack_and_says_how_far_it_ran_ahead():
    result = laboratory.run(load("wallette-mode-2", {"drive.accuracy": 0.01}))
    rows, control = result.history.rows, result.summary["control"]
    first = int(np.argmax(rows["fracture_mode_1"] > 0.0))
    ways = np.diff(rows["displacement"])
    assert ways[first - 1] < 0.2 * ways[:first].max() and ways[first - 1] < 0.1 * rows["displacement"][first]
    assert 0.0 < control["mean_lag"] <= control["largest_lag"] < 0.1
    assert f"{100 * control['mean_lag']:.2g} % of the work on average" in accuracy_text(result.summary)


def test_a_specimen_that_came_apart_holds_up_the_drive_no_longer() -> None:
    """Nothing is stored any more, so that any motion is large beside it."""
    done = timed_run.run(PULLED_APART, {"law": "linear"})
    row = int(np.argmax(done.rows["fracture_mode_1"] >= (1 - 1e-9) * done.rows["fracture_mode_1"][-1]))
    assert done.rows["displacement"][row] < 0.6 * done.rows["displacement"][-1]
    assert done.summary["steps"] - done.rows["step"][row] < done.rows["step"][row]


def test_the_lag_is_the_force_over_the_way_that_a_spring_follows_late():
    """A mass m on a spring k, driven at v, follows by v / w late: the force k u does k u v / w of work too early."""
    mass, spring, v, u = 3.0, 700.0, 0.02, 0.4
    pace = AdaptiveLoading(assemble(load("wallette-mode-1")).model, Controlled(rise(10, 10), 1.0, 0.01), 100)
    last, work = pace.increments, 0.5 * spring * u**2
    last.made, last.most_force, last.most_stored, last.work = 1e-3, spring * u, 56.0, work
    row = DriveRow(spring * u, spring * u, None, work, 0.0, 0.0, 0.0)
    pace.bounds.factor(row, last, 0.5 * mass * v**2, 0.0, takes_few_steps=False)
    late = v / np.sqrt(spring / mass)
    assert pace.bounds.looks[-1].lag == pytest.approx(spring * u * late / work, rel=1e-12)

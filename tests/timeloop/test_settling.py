"""Dead loads settle until they are at rest where a scene does not say how many steps that takes."""

from math import inf

import pytest

from masonry.assembly.assemble import assemble
from masonry.assembly.schedule import FEWEST
from masonry.errors import Stopped
from masonry.laboratory import laboratory
from masonry.rows.rest_criterion import SETTLED
from masonry.scene import load as load_scene
from masonry.timeloop.checkpoint import Checkpoints
from masonry.timeloop.checkpointer import Checkpointer
from tests.faults.test_same_bits import TURNS, WAVE, after, everything
from tests.scenes import ELASTIC, MATERIAL, box, listed, load, specimen, tables
from tests.timeloop.test_loop import couplet

FRICTION = 'law = "friction"\nnormal_stiffness = "200 GPa/m"\nshear_stiffness = "80 GPa/m"\ntan_friction_angle = 0.6'
SCENES = {
    "rigid, steps": lambda: load(couplet("rigid", pace="steps = 800", displacement="0.02 mm")),
    "affine, accuracy": lambda: load(couplet("affine", pace='accuracy = "5 %"', displacement="0.02 mm")),
    "a load that varies": lambda: load_scene("couplet", {**TURNS, "traction": [WAVE], "solver.rows": 30}),
}


def without_steps(scene):
    return scene.with_({"settle": None})


@pytest.mark.parametrize("name", SCENES)
def test_a_run_that_finds_its_steps_has_the_bits_of_one_that_was_given_them(name):
    scene = without_steps(SCENES[name]())
    result = laboratory.run(scene)
    given = laboratory.run(scene.with_({"settle.steps": FEWEST}))
    assert result.scene_toml == given.scene_toml and f"[settle]\nsteps = {FEWEST}" in result.scene_toml
    first, second = everything(result), everything(given)
    assert not [key for key in first if first[key] != second[key]]
    assert result.summary["unbalanced_after_settling"] < SETTLED.force


def column(damping: float):
    """Twenty elastic blocks one on the other, pushed at the top: it sways slowly."""
    blocks = [box(f"block {k}", (0, 0, 0.1 * k), (0.1, 0.1, 0.1), "units", k) for k in range(20)]
    text = (
        'kinematics = "rigid"\n'
        + specimen(blocks, 0.01)
        + tables("material", {"units": MATERIAL})
        + tables("contact", {"unit_unit": ELASTIC})
        + listed("support", ['on = "block 0"\nfix = "all"'])
        + listed("traction", ['on = "block 19.z+"\nstress = {x = "1 kPa"}'])
    )
    return load(text, solver__damping=damping)


def pushed_block(push: str):
    """A block of 10 kN on a fixed one, without strength, that is pushed along the joint."""
    blocks = [
        box("base", (0, 0, 0), (0.4, 0.1, 0.1), "units", 0),
        box("block", (0.1, 0, 0.1), (0.2, 0.1, 0.1), "units", 1),
    ]
    text = (
        'kinematics = "rigid"\n'
        + specimen(blocks, 0.02)
        + tables("material", {"units": MATERIAL})
        + tables("contact", {"unit_unit": FRICTION})
        + listed("support", ['on = "base"\nfix = "all"'])
        + listed("traction", [f'on = "block.z+"\nstress = {{x = "{push}", z = "-0.5 MPa"}}'])
    )
    return load(text)


def test_what_swings_for_long_gets_as_many_steps_as_it_needs():
    scene = column(0.05)
    result = laboratory.run(scene)
    (steps,) = {int(line.split()[-1]) for line in result.scene_toml.split("\n") if line.startswith("steps = ")}
    assert steps > FEWEST and steps == result.summary["steps"]
    assert result.summary["unbalanced_after_settling"] < SETTLED.force
    half = laboratory.run(scene.with_({"settle.steps": steps // 2}))
    late = half.history.rows["kinetic"][-steps // 20 :].max()
    assert late > result.history.rows["kinetic"][-steps // 20 :].max(), "half as many leave it swinging"


def test_what_cannot_stand_is_told_with_what_moves_and_what_to_look_at():
    with pytest.raises(Stopped) as stopped:
        laboratory.run(pushed_block("350 kPa"))
    message = str(stopped.value)
    assert "the dead loads move the specimen away: step " in message
    assert "block 1 at" in message and "--set settle.steps=2000" in message
    assert stopped.value.result is None


def test_without_damping_nothing_comes_to_rest(monkeypatch):
    monkeypatch.setattr("masonry.laboratory.settling_search.LONGEST", 4000)
    with pytest.raises(Stopped, match=r"not come to rest in 4000 steps: .* of them are still unbalanced.*damping"):
        laboratory.run(column(0.0))


def test_a_run_that_goes_on_finds_the_steps_in_its_scene(tmp_path):
    scene, kept = without_steps(SCENES["rigid, steps"]()), Checkpoints(tmp_path)
    kept.begin("", {})
    looks = []
    whole = laboratory.run(scene, checkpointer=Checkpointer(None, {}, inf, asked=lambda: bool(looks.append(1))))
    part = laboratory.run(scene, checkpointer=Checkpointer(kept, {}, inf, asked=after(len(looks) - 3)))
    assert part.summary["interrupted"]
    going_on = Checkpointer(kept, {}, inf)
    going_on.saved, _ = kept.newest()
    assert going_on.saved["origin"]["its scene"]
    result = laboratory.run(load_scene(kept.scene), checkpointer=going_on)
    assert everything(result)["displacement"] == everything(whole)["displacement"]


def test_a_trial_ends_when_the_run_is_asked_to_end():
    with pytest.raises(KeyboardInterrupt):
        laboratory.run(
            without_steps(SCENES["rigid, steps"]()), checkpointer=Checkpointer(None, {}, inf, asked=after(3))
        )


def test_progress_and_the_check_say_that_the_steps_are_looked_for():
    said = []
    scene = without_steps(SCENES["rigid, steps"]())
    laboratory.run(scene, progress=lambda step, steps, note: said.append(note))
    assert any(note.startswith("settling, trial of 2000 steps: step ") for note in said)
    assert any("of the dead loads unbalanced" in note for note in said)
    assert "found as the run begins; 2000 are counted" in laboratory.check(scene)["settling"]


def test_a_scene_without_dead_loads_settles_nothing():
    scene = load_scene("wallette-mode-1")
    assert scene.settle is None and assemble(scene).plan.settle == 0

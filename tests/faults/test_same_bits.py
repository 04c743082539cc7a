"""A run in pieces is the run in one: every row, frame and number of the summary, to the bit."""

from dataclasses import fields
from math import inf
from random import Random

import numpy as np
import pytest

from masonry.assembly.assemble import assemble
from masonry.configuration import model_state
from masonry.errors import SceneError
from masonry.laboratory import laboratory
from masonry.scene import load as load_scene
from masonry.timeloop.checkpoint import Checkpoints
from masonry.timeloop.checkpointer import Checkpointer
from tests.couplet.test_crushing_couplet import PRESSED
from tests.kinematics.test_lines_of_action import FIXED, pushed_over
from tests.large.by_hand.test_crushing_runs import CUT_OFF, rocking
from tests.large.test_invariance import scene as toppling
from tests.loading.test_swing import SCENE as SWING
from tests.model.test_motion import GRAVITY, flight, standing
from tests.scenes import load
from tests.timeloop.test_loop import couplet
from verification import scene_runs

SHORT = {"settle": 200, "displacement": "0.03 mm"}
WAVE = {"on": "top.z+", "stress": {"z": "-0.5 MPa"}, "history": "1 + 0.2 * sin(40 pi t / 1 s)", "duration": "1 s"}
INCOMING = {"x": "1 mm/s * sin(2 pi t / 3 ms)", "quantity": "velocity", "duration": "6 ms"}
ELASTIC = {"material.units.young_modulus": "10 GPa", "material.units.poisson_ratio": 0.2, "solver.rows": 30}
TURNS = {"drive.accuracy": None, "drive.history": ["0.1 mm", "0 mm", "0.1 mm"], "drive.steps": 900}
LED = {
    "settle.steps": 2000,
    "solver.rows": 30,
    "limit.accuracy": 0.2,
    "limit.control": "top",
    "limit.until": "2 mm",
    "gauge": [{"name": "top", "at": "top course", "direction": "-x"}],
}
TO_AND_FRO = {
    "settle.steps": 500,
    "limit.accuracy": 0.05,
    "limit.history": [0.02, -0.02, 0.03],
    "gauge": LED["gauge"],
}
SHAKEN = {
    "settle.steps": 400,
    "solver.rows": 30,
    "ground.x": "0.5 g * sin(2 pi t / 0.01 s)",
    "ground.duration": "0.01 s",
}
DASHPOTS = '[damping]\nstiffness = "2e-5 s"\nmaxwell = {ratio = "5 %", between = ["1e2 Hz", "1e3 Hz"]}\n'
CRUSHES = {
    **PRESSED,
    "contact.unit_unit.crushing": "cap",
    "contact.unit_unit.closing_at_peak": "0.05 mm",
    "drive.displacement": "0.3 mm",
    "settle.steps": 300,
    "solver.rows": 30,
}
WALL_THAT_CRUSHES = {
    "specimen.courses": 3,
    "specimen.units_per_course": 1.5,
    "confinement": "2.5 MPa",
    "settle.steps": 1000,
    "drive.history": ["0.8 mm", "-0.4 mm"],
    "drive.accuracy": "5 %",
    "solver.rows": 30,
}
SCENES = {
    "rigid, steps": lambda: load(couplet("rigid", settle=400, pace="steps = 800", displacement="0.02 mm")),
    "tets, steps": lambda: load(couplet("tets", settle=400, pace="steps = 800", displacement="0.02 mm")),
    "rigid, accuracy": lambda: load(couplet("rigid", **SHORT, pace='accuracy = "5 %"')),
    "affine, accuracy": lambda: load(couplet("affine", **SHORT, pace='accuracy = "5 %"')),
    "tets, accuracy": lambda: load(couplet("tets", **SHORT, pace='accuracy = "5 %"')),
    "turns beside a load that varies": lambda: load_scene(
        "couplet", {**TURNS, "traction": [WAVE], "settle.steps": 300, "solver.rows": 30}
    ),
    "a load whose line stays in space": lambda: pushed_over(FIXED, pace="steps = 900", settle__steps=300),
    "gravity that turns": lambda: load_scene(
        "arch", {"gravity.tilt": {"about": "y", "angle": "2 deg", "steps": 900}, "settle.steps": 300, "solver.rows": 30}
    ),
    "a load that grows until it falls": lambda: load_scene(
        "wall-tilted", {"settle.steps": 500, "limit.accuracy": 0.05, "limit.up_to": 0.03, "solver.rows": 30}
    ),
    "a wall whose top is led on behind the collapse": lambda: load_scene("wall-tilted", LED),
    "a wall on ground that is tilted to and fro": lambda: load_scene("wall-tilted", TO_AND_FRO),
    "a wall on ties that yield": lambda: load_scene(
        "wall-tied", {"settle.steps": 500, "limit.accuracy": 0.05, "limit.up_to": 0.3, "solver.rows": 30}
    ),
    "a blow after the settling": lambda: standing('["1 m/s", 0, 0]', 300).with_({"solver.rows": 30}),
    "ground that moves": lambda: scene_runs.load("block-on-ground", SHAKEN),
    "supports that move": lambda: scene_runs.load("block-on-ground", {**SHAKEN, "ground.as": "base"}),
    "dashpots after the settling": lambda: load(SWING.format(damping=DASHPOTS)).with_(
        {"solver.rows": 30, "solver.step_fraction": 0.3, "settle.steps": 300}
    ),
    "a flight": lambda: flight(gravity=GRAVITY),
    "blocks that topple and are found anew": lambda: toppling(duration=0.4).with_({"solver.rows": 30}),
    "a wave that leaves through a quiet boundary": lambda: scene_runs.load(
        "stack", {"kinematics": "affine", "quiet": [{"on": "block 1.z+"}], **ELASTIC}
    ),
    "a wave that comes in through a quiet boundary": lambda: scene_runs.load(
        "stack", {"kinematics": "affine", "quiet": [{"on": "block 1.x-", "wave": INCOMING}], **ELASTIC}
    ),
    "a joint that crushes": lambda: load_scene("couplet", CRUSHES),
    "bonds that turn with their blocks, and crush": lambda: load_scene("couplet", CRUSHES | {"displacements": "large"}),
    "faces of patches that crush as a block rocks": lambda: rocking(CUT_OFF, 0.25),
    "a wall whose toes crush to and fro": lambda: load_scene("wall-cyclic-shear", WALL_THAT_CRUSHES),
    "a wall that cracks": lambda: load_scene(
        "wallette-mode-1", ["specimen.divisions=[4, 2]", "drive.rate=50 mm/s", "solver.rows=60"]
    ),
}


def everything(result) -> dict:
    """Bytes of all rows and frames, and the summary without seconds."""
    frames = [[getattr(frame, entry.name) for entry in fields(frame)] for frame in result.history.frames]
    return {
        **{name: values.tobytes() for name, values in result.history.rows.items()},
        "frames": [[v.tobytes() if hasattr(v, "tobytes") else v for v in frame] for frame in frames],
        "summary": {key: value for key, value in result.summary.items() if not key.startswith("seconds")},
    }


def after(chunks: int):
    """Says no at first and for so many chunks of steps less one, then yes."""
    answers = iter([False] * chunks)
    return lambda: next(answers, True)


SLOW = ("tets, steps", "affine, accuracy", "turns beside a load that varies")
"""Their kinds of step are compiled for nobody else; others have steps of tets, an accuracy, and a load that varies."""


@pytest.mark.parametrize("name", [pytest.param(n, marks=pytest.mark.slow if n in SLOW else ()) for n in SCENES])
def test_a_run_in_pieces_on_changing_threads_has_the_bits_of_the_run_in_one(name, tmp_path):
    scene, kept, looks = SCENES[name](), Checkpoints(tmp_path), []
    whole = everything(
        laboratory.run(scene, checkpointer=Checkpointer(None, {}, inf, asked=lambda: bool(looks.append(1))))
    )
    ends = sorted(Random(name).sample(range(1, len(looks) - 2), 5))
    kept.begin("", {})
    saved = None
    for n, chunks in enumerate(np.diff([0, *ends])):
        checkpointer = Checkpointer(kept, {}, inf, asked=after(int(chunks)))
        checkpointer.saved = saved
        part = laboratory.run(scene, threads=1 if "wall" in name else 1 + n % 2, checkpointer=checkpointer)
        assert part.summary["interrupted"]
        saved, wrong = kept.newest()
        assert not wrong and saved["run"]["done"] >= part.summary["steps"]
    checkpointer = Checkpointer(kept, {}, inf)
    checkpointer.saved = saved
    result = laboratory.run(scene, checkpointer=checkpointer)
    assert result.log[-1] == f"resumed at step {saved['run']['done']}"
    bits = everything(result)
    assert not [key for key in whole if whole[key] != bits[key]]
    if "crush" in name:
        assert 0.0 < saved["run"]["rows"]["crushing"][-1] < result.history.rows["crushing"][-1]


@pytest.mark.parametrize("name", ["rigid, steps", "affine, accuracy", "tets, accuracy"])
def test_what_steps_change_is_what_is_kept_and_nothing_else_in_a_model_changes(name, tmp_path):
    assembly = assemble(SCENES[name]())
    model = assembly.model
    before, fixed = model_state.state(model), model_state.fingerprint(model)
    laboratory.timeloop.run(model, assembly.plan, assembly.recording)
    assert model_state.fingerprint(model) == fixed
    now = model_state.state(model)
    assert {"u", "force", "contacts.0.4"} < {key for key in now if now[key].tobytes() != before[key].tobytes()}


def test_a_checkpoint_of_another_model_is_refused(tmp_path):
    kept = Checkpoints(tmp_path)
    kept.begin("", {})
    laboratory.run(SCENES["rigid, steps"](), checkpointer=Checkpointer(kept, {}, inf, asked=after(4)))
    other = Checkpointer(kept, {}, inf)
    other.saved, _ = kept.newest()
    with pytest.raises(SceneError, match="belongs to another model"):
        laboratory.run(load(couplet("rigid", settle=400, pace="steps = 800", masses="real")), checkpointer=other)

"""Tractions that vary over time, each by a history of its own: static answers, works, and the same bits without one."""

import numpy as np
import pytest

from masonry import scene as scenes
from masonry.assembly.assemble import assemble
from masonry.errors import SceneError
from masonry.laboratory import laboratory
from masonry.loading.varying_loads import knots
from tests.scenes import ELASTIC, MATERIAL, box, listed, load, specimen, tables

KN, KS, AREA = 200e9, 80e9, 0.2 * 0.1


def block(tractions: list[str], more: str = "", steps: int = 2000) -> str:
    """A rigid block that stands on another by an elastic joint, and may not turn."""
    boxes = [box(n, (0, 0, z), (0.2, 0.1, 0.05), "units", k) for k, (n, z) in enumerate((("low", 0), ("top", 0.05)))]
    gauges = [f'name = "along {a}"\nat = "top"\ndirection = "{a}"' for a in "xz"]
    return (
        specimen(boxes, AREA)
        + tables("material", {"units": MATERIAL})
        + tables("contact", {"unit_unit": ELASTIC})
        + listed("support", ['on = "low"\nfix = "all"', 'on = "top"\nfix = ["y", "rotation"]'])
        + listed("traction", tractions)
        + listed("gauge", gauges)
        + f"[settle]\nsteps = {steps}\n{more}"
    )


PUSH = 'on = "top.z+"\nstress = {z = "-0.5 MPa"}'
SHEAR = 'on = "top.z+"\nstress = {x = "0.2 MPa"}\nhistory = "sin(2 pi t / 1 s)"\nduration = "1 s"'
PRESS = 'on = "top.z+"\nstress = {z = "-0.3 MPa"}\nhistory = [["0 s", 1], ["0.4 s", 1], ["0.8 s", -2]]'


def stretched(text: str, dt: float, steps: int) -> str:
    """The same histories over so many steps of dt (s)."""
    for seconds in ("1 s", "0.4 s", "0.8 s"):
        text = text.replace(f'"{seconds}"', f'"{float(seconds.split()[0]) * steps * dt!r} s"')
    return text.replace("t / 1 s", f"t / {steps * dt!r} s")


def test_each_load_follows_its_own_history_beside_one_that_stays():
    text = block([PUSH, SHEAR, PRESS])
    dt = laboratory.check(load(text))["time_step_s"]
    result = laboratory.run(load(stretched(text, dt, 20_000)))
    rows = result.history.rows
    t = (rows["step"] - 2000) / 20_000
    after = t > 0.02
    table = load(text).traction[2].path
    press = np.asarray(table.at(np.minimum(t, 0.8)))
    x, z = (rows[f"along {a}"][after] for a in "xz")
    assert x == pytest.approx(0.2e6 / KS * np.sin(2 * np.pi * t[after]), abs=2e-3 * 0.2e6 / KS)
    assert z == pytest.approx(-(0.5e6 + 0.3e6 * press[after]) / KN, abs=2e-3 * 0.8e6 / KN)
    assert rows["stress"] == pytest.approx(np.zeros(len(rows["step"]))), "nothing is driven"
    assert result.summary["energy_imbalance"] < 1e-10, "the work of loads that vary is booked as they act"
    assert result.summary["unbalanced_after_settling"] < 1e-3


def acting(scene, rows: int) -> np.ndarray:
    """Shear (N) on the top block at each step, as the chunks of a run hand it to the step."""
    assembly = assemble(scene)
    loading, body = assembly.plan.loading(assembly.model, rows), assembly.model.bodies.rigid
    found = np.zeros(1)
    while (chunk := loading.next()) is not None:
        stays, comes = np.minimum(chunk.dead_load, 1.0), np.maximum(chunk.dead_load - 1.0, 0.0)
        found = np.append(found, (stays * body.load[1, 0] + comes * body.change[1, 0])[1:])
    return found


def test_a_load_that_varies_fast_is_the_same_however_many_rows_there_are():
    text = block([PUSH, SHEAR], steps=500)
    dt = laboratory.check(load(text))["time_step_s"]
    text = text.replace("2 pi t / 1 s", f"80 pi t / {4000 * dt!r} s").replace('"1 s"', f'"{4000 * dt!r} s"')
    few, many = (acting(load(text), rows) for rows in (9, 1500))
    most = 0.2e6 * AREA
    assert few == pytest.approx(many, abs=1e-9 * most)
    wanted = most * np.sin(80 * np.pi * np.arange(4001) / 4000)
    assert few[501:] == pytest.approx(wanted, abs=2e-3 * most)


@pytest.mark.parametrize("period", [3000.0, 150.0, 40.0])
def test_between_its_knots_no_history_leaves_its_line(period):
    step = np.arange(5001)
    shares = np.array([np.sin(2 * np.pi * np.maximum(step - 300, 0) / period), np.ones(len(step))])
    at = knots(shares, 300, 1e-3)
    assert 300 in at and at[0] == 0 and at[-1] == 5000 and np.diff(at[1:]).max() <= 200
    assert np.interp(step, at, shares[0][at]) == pytest.approx(shares[0], abs=1e-3)
    assert len(at) > 20 * 5000 / period


@pytest.mark.parametrize("pace", [{"drive.steps": 20_000}, {"drive.rate": "20 mm/s"}])
def test_a_drive_one_way_keeps_its_ramp_and_its_speed_beside_a_load_that_varies(pace):
    over = {**pace, "drive.accuracy": None, "drive.ramp": 0.9, "settle.steps": 400}
    beside = {"on": "top.z+", "stress": {"z": "-0.1 MPa"}, "history": [["0 s", 0], ["1 s", 1]]}
    plain = scenes.load("couplet", over)
    varied = scenes.load("couplet", {**over, "traction": [plain.traction[0].model_dump(), beside]})
    one, other = (assemble(scene).plan for scene in (plain, varied))
    assert np.array_equal(one.speed, other.speed) and other.varying.shape == (1, other.steps + 1)
    assert other.varying[0, [0, 400, 401, -1]] == pytest.approx([0.0, 0.0, 0.0, 1.0])


def test_a_joint_still_slides_at_the_end_of_a_drive_beside_a_load_that_varies():
    wave = {"on": "top.z+", "stress": {"z": "-0.5 MPa"}, "history": "1 + 0.2 * sin(2 pi t / 1 s)", "duration": "2 s"}
    over = {"drive.accuracy": None, "drive.steps": 20_000, "traction": [wave]}
    final = laboratory.run(scenes.load("couplet", over)).summary["final_stress_pa"]
    assert final == pytest.approx(0.73 * 0.5e6, rel=5e-3)


def test_a_share_of_one_is_a_load_that_stays():
    still = block([PUSH], steps=500)
    text = block([f'{PUSH}\nhistory = [["0 s", 1], ["1 s", 1]]'], steps=500)
    dt = laboratory.check(load(text))["time_step_s"]
    varying, plain = (laboratory.run(load(one)) for one in (text.replace('"1 s"', f'"{400 * dt!r} s"'), still))
    known = plain.history.rows["step"][-1] == 500
    one, other = (run.history.rows["along z"][run.history.rows["step"] <= 500] for run in (varying, plain))
    assert known and one[-1] == pytest.approx(other[-1], rel=1e-12)


def test_a_load_that_varies_must_be_held_as_any_other():
    free_along_x = [
        one.replace('fix = "all"', 'fix = ["y", "z", "rotation"]') for one in (block([PUSH]), block([SHEAR]))
    ]
    assert laboratory.check(load(free_along_x[0]))["blocks"] == 2, "nothing pushes along x"
    with pytest.raises(SceneError, match="not held along x, where the dead loads push"):
        laboratory.check(load(free_along_x[1]))


def test_a_history_that_takes_too_long_is_refused_before_anything_is_computed():
    text = block([PUSH, SHEAR.replace('duration = "1 s"', 'duration = "1e9 s"')])
    with pytest.raises(SceneError, match="steps of"):
        laboratory.check(load(text))

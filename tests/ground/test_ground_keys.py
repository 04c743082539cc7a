"""The table [ground] of a scene: what it comes to, and what is said of wrong ones."""

import numpy as np
import pytest

from masonry.errors import SceneError
from masonry.laboratory import laboratory
from masonry.scene import load, to_toml
from tests import scenes

BOXES = [
    scenes.box("base", (-1, -1, -0.5), (2, 2, 0.5), "base", 0),
    scenes.box("block", (-0.5, -0.5, 0), (1, 1, 0.2), "units", 1),
]
BLOCK = f"""
law = "friction"
{scenes.specimen(BOXES, 1.0)}
[material.units]
density = "2000 kg/m^3"
[material.base]
density = "2000 kg/m^3"
[contact.base_units]
normal_stiffness = "10 GPa/m"
shear_stiffness = "10 GPa/m"
tan_friction_angle = 0.2
[[support]]
on = "base"
fix = "all"
[gravity]
z = "-9.81 m/s^2"
"""
SINE = {"x": "0.5 g * sin(2 pi t / 1 s)", "duration": "1 s"}


def scene(tmp_path, ground, **more):
    """The block on ground of these keys."""
    (tmp_path / "block.toml").write_text(BLOCK)
    return load(tmp_path / "block.toml", {"ground": ground, **more})


@pytest.fixture
def record(tmp_path):
    (tmp_path / "own.csv").write_text("time,north (g),up (g)\n0,0.1,0\n0.01,-0.2,0.1\n0.02,0.1,0\n")
    return {"record": str(tmp_path / "own.csv"), "x": "north", "z": "up"}


def test_a_record_has_components_a_scale_and_its_duration(tmp_path, record):
    ground = scene(tmp_path, {**record, "scale": -2, "begin": "0.5 s"}).shaken
    assert list(ground.motions) == ["x", "z"] and ground.runs_for == pytest.approx(0.52)
    assert ground.motions["x"].acceleration == pytest.approx(-2 * 9.80665 * np.array([0.1, -0.2, 0.1]))
    peak = scene(tmp_path, {**record, "peak": "0.4 g"}).shaken.motions
    assert peak["x"].peak_acceleration == pytest.approx(0.4 * 9.80665)
    assert peak["z"].peak_acceleration == pytest.approx(0.2 * 9.80665)


def test_a_record_lies_beside_its_scene(tmp_path, record):
    (tmp_path / "own.toml").write_text(BLOCK + '[ground]\nrecord = "own.csv"\nx = "north"\n')
    own = load(tmp_path / "own.toml")
    assert own.shaken.record == str(tmp_path / "own.csv") and own.solver.masses == "real"
    (tmp_path / "again.toml").write_text(to_toml(own))
    assert load(tmp_path / "again.toml").resolved() == own.resolved()
    assert load(tmp_path / "own.toml", {"ground.scale": 2}).shaken.motions["x"].peak_acceleration > 3.9
    assert own.with_({"ground.scale": 2}).shaken.scale == 2.0


def test_a_formula_is_in_the_unit_of_its_quantity(tmp_path):
    assert scene(tmp_path, SINE).shaken.motions["x"].peak_acceleration == pytest.approx(0.5 * 9.80665, rel=1e-4)
    place = "10 mm * (1 - cos(2 pi t / 1 s))"
    moved = scene(tmp_path, {"x": place, "duration": "1 s", "quantity": "displacement"}).shaken.motions["x"]
    assert moved.peak_displacement == pytest.approx(0.02, rel=1e-3)
    with pytest.raises(SceneError, match="ground.x: the expression is an acceleration, and must be a length"):
        scene(tmp_path, {**SINE, "quantity": "displacement"})


@pytest.mark.parametrize(
    ("keys", "says"),
    [
        ({"x": None}, "ground.x: missing; name a column"),
        ({"scale": 2, "peak": "0.4 g"}, "ground.peak: scale and peak exclude each other"),
        ({"scale": 0}, "ground.scale: ground that is scaled by 0 does not move"),
        ({"peak": "0.4 mm"}, "ground.peak: mm is a length; peak is an acceleration"),
        ({"duration": None}, "ground.duration: missing; a formula needs it"),
        ({"unit": "g"}, "ground.unit: belongs to a record"),
        ({"x": "0.4 g * tan(t)"}, "ground.x: at character 9"),
        ({"as": "bases"}, "ground.as: 'bases' is not allowed; did you mean 'base'"),
        ({"base": 1}, "ground.base: unknown key"),
        ({"baseline": "cubic"}, "ground.baseline: 'cubic' is not allowed"),
        ({"begin": "-1 s"}, "ground.begin: '-1 s' is out of range"),
        ({"on": "base"}, "ground.as: supports that move apart have no frame in common: as = 'base'"),
        ({"on": "bas", "as": "base"}, "ground.on: 'bas' is no support; known here: base; did you mean 'base'"),
        ({"quantity": "speed"}, "ground.quantity: 'speed' is not allowed"),
    ],
)
def test_what_is_wrong_with_a_ground_is_said_with_its_key(tmp_path, keys, says):
    ground = {key: value for key, value in {**SINE, **keys}.items() if value is not None}
    with pytest.raises(SceneError, match=says) as error:
        scene(tmp_path, ground)
    assert len(error.value.lines) == 1


def test_a_record_without_times_needs_a_step(tmp_path, record):
    (tmp_path / "alone.csv").write_text("East\n0.1\n-0.2\n0.1\n")
    alone = {"record": str(tmp_path / "alone.csv"), "x": "east", "unit": "g", "scale": 2}
    assert scene(tmp_path, {**alone, "step": "0.02 s"}).shaken.runs_for == pytest.approx(0.04)
    for keys, says in (
        (alone, "ground.record: 'alone.csv' has no column of times: say the time from sample to sample, step"),
        ({**record, "step": "0.01 s", "time": "time"}, "ground.step: the column 'time' says the same"),
        ({**SINE, "step": "0.01 s"}, "ground.step: belongs to a record"),
    ):
        with pytest.raises(SceneError, match=says):
            laboratory.check(scene(tmp_path, keys))


def test_a_check_says_where_nothing_catches_what_falls(tmp_path):
    large = {"displacements": "large", "contact.base_units.tan_friction_angle": 0.5}
    words = "no [floor]: what falls off its supports goes on falling"
    assert words in laboratory.check(scene(tmp_path, SINE, **large)).moved
    assert words not in laboratory.check(scene(tmp_path, SINE)).moved
    assert words not in laboratory.check(load("block-shaken")).moved


def test_scaled_masses_are_refused_with_the_reason(tmp_path):
    with pytest.raises(SceneError, match="solver.masses: ground that moves shakes real masses"):
        scene(tmp_path, SINE, **{"solver.masses": "scaled"})


def test_ground_needs_something_that_stands_on_it(tmp_path):
    (tmp_path / "block.toml").write_text(BLOCK.replace("[[support]]\non", "[[traction]]\nstress = {x = '1 Pa'}\non"))
    text = BLOCK.split("[[support]]")[0] + "[gravity]" + BLOCK.split("[gravity]")[1]
    (tmp_path / "loose.toml").write_text(text)
    with pytest.raises(SceneError, match="ground: nothing stands on the ground"):
        load(tmp_path / "loose.toml", {"ground": SINE})


def test_a_record_that_cannot_be_read_is_told_with_its_file(tmp_path, record):
    for keys, says in (
        ({"record": str(tmp_path / "other.csv")}, "ground.record: .*other.csv"),
        ({"x": "nord"}, "ground.record: 'own.csv' has no column 'nord'; known here: north"),
        ({"x": "time"}, "ground.record: x = 'time' is the column of the times: name one of a motion"),
        ({"unit": "m/s2"}, "ground.record: unit = 'm/s2', but 'own.csv' says"),
    ):
        with pytest.raises(SceneError, match=says):
            laboratory.check(scene(tmp_path, {**record, **keys}))


@pytest.mark.parametrize("name", ["block-shaken", "tower-shaken"])
def test_a_shaken_scene_that_is_written_out_has_the_same_rows(name, tmp_path):
    scene, path = load(name), tmp_path / "scene.toml"
    path.write_text(to_toml(scene), encoding="utf-8")
    assert load(path).sampling == scene.sampling is not None

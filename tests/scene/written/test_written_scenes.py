"""A scene that is written reads back as it was, bit by bit."""

import struct
import tomllib

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from masonry.errors import SceneError
from masonry.scene import load, to_toml
from masonry.scene.schema import SceneKeys
from tests.scene.written import any_scene

BOXES = """
title = "Two boxes"
law = "elastic"
[specimen]
kind = "boxes"
section = "0.01 m^2"
[[specimen.box]]
name = "a"
origin = ["0 m", "0 m", "-100 mm"]
size = ["100 mm", "100 mm", "100 mm"]
[[specimen.box]]
name = "b"
origin = ["0 m", "0 m", "0 m"]
size = ["100 mm", "100 mm", "100 mm"]
divisions = [2, 2, 2]
unit = 1
[material.units]
density = "2 g/cm^3"
[contact.unit_unit]
normal_stiffness = "1 GPa/m"
shear_stiffness = "0 Pa/m"
[[support]]
on = "a"
fix = "all"
[gravity]
z = "-9.81 m/s^2"
[settle]
steps = 10
"""


def written(scene, folder):
    file = folder / "written.toml"
    file.write_text(to_toml(scene), encoding="utf-8")
    return load(file)


def floats(value):
    """Every float of a scene, bit by bit."""
    if isinstance(value, float):
        return [struct.pack("d", value)]
    if hasattr(value, "__dict__") and value.__dict__:
        value = list(value.__dict__.values())
    if isinstance(value, dict):
        value = list(value.values())
    return [bits for item in value for bits in floats(item)] if isinstance(value, (list, tuple)) else []


def test_boxes_without_friction_or_drive_are_a_scene(tmp_path):
    file = tmp_path / "boxes.toml"
    file.write_text(BOXES)
    scene = load(file)
    assert scene.name == "boxes"
    assert scene.specimen.box[0].origin == (0.0, 0.0, -0.1)
    assert scene.contact["unit_unit"].tan_friction is None
    assert scene.material["units"].density == 2000.0
    assert (scene.drive, scene.gravity.vector) == (None, (0.0, 0.0, -9.81))
    assert written(scene, tmp_path) == scene
    file.write_text(BOXES.replace('"b"', '"a"'))
    with pytest.raises(SceneError, match="2 boxes are named 'a'"):
        load(file)


def answers(scene):
    """What a scene says of itself beyond its keys, as some of it depends on which keys a file has."""
    answers = {}
    for name in [name for name, of in vars(SceneKeys).items() if isinstance(of, property)]:
        try:
            answers[name] = getattr(scene, name)
        except SceneError as error:  # of what is looked at as late as a run begins
            answers[name] = str(error)
    return answers


def require_same(scene, folder, name):
    """A scene, written and read twice over, is what it was: every key, every float bit by bit, all that it answers."""
    again = written(scene, folder)
    assert again == scene, name
    assert floats(again) == floats(scene), name
    assert to_toml(again) == to_toml(scene), name
    assert answers(again) == answers(scene), name


@pytest.mark.parametrize("name", any_scene.sources())
def test_a_written_scene_is_toml_in_si_and_reads_back_as_it_was(name, tmp_path):
    scene = load(any_scene.sources()[name])
    assert tomllib.loads(to_toml(scene))["name"] == scene.name == name
    require_same(scene, tmp_path, name)


def test_300_scenes_made_by_chance_read_back_as_they_were(tmp_path):
    made = any_scene.scenes(300)
    for name, scene, _ in made:
        require_same(scene, tmp_path, name)
    put_in = set().union(*(keys for _, _, keys in made))
    rare = {"standard", "scatter"}
    assert {key for key in SceneKeys.model_fields if key not in rare} <= {key.partition(".")[0] for key in put_in}
    assert {"quiet.wave.made", "ground.made.table", "damping.maxwell", "specimen.cells.sites", "gauge.at"} <= put_in


def test_a_written_scene_still_follows_its_law_and_its_confinement(tmp_path):
    file = tmp_path / "written.toml"
    file.write_text(to_toml(load("couplet")))
    new = ["law=polynomial", "confinement=1 MPa"]
    assert load(file, new).contact == load("couplet", new).contact
    assert load(file, new).traction == load("couplet", new).traction


POSITIVE = st.floats(min_value=1e-300, max_value=1e300)
ANGLE = st.floats(min_value=0.0, max_value=89.9)
OVERRIDES = st.fixed_dictionaries(
    {},
    optional={
        "confinement": POSITIVE.map("{!r} psi".format),
        "contact.unit_unit.normal_stiffness": POSITIVE.map("{!r} GPa/m".format),
        "contact.unit_unit.friction_angle": ANGLE.map("{!r} deg".format),
        "contact.unit_unit.dilation_angle": ANGLE.map("{!r} deg".format),
        "contact.unit_unit.fracture_energy_mode_2_slope": POSITIVE.map("{!r} N/m/MPa".format),
        "contact.within_units.law": st.sampled_from(["elastic", "brittle", "linear", "polynomial", "exponential"]),
        "specimen.plates": POSITIVE.map("{!r} in".format),
        "specimen.mortar.thickness": POSITIVE.map("{!r} mm".format),
        "traction.0.stress.x": st.floats(-1e300, 1e300).map("{!r} kPa".format),
        "gravity.z": st.floats(-1e300, 1e300).map("{!r} m/s^2".format),
        "drive.rate": POSITIVE.map("{!r} mm/s".format),
        "drive.direction": st.sampled_from(["x", "-y", "-z"]),
        "solver.time_step": POSITIVE.map("{!r} us".format),
        "solver.damping": st.floats(0.0, 0.999),
        "solver.rotation_limit": st.floats(0.001, 89.0).map("{!r} deg".format),
        "kinematics.units": st.sampled_from(["rigid", "affine", "tets"]),
        "title": st.text(max_size=20).map(lambda text: "a " + text),
        "assumptions": st.fixed_dictionaries({"drive.ramp": st.text(max_size=20)}),
        "solver.rows": st.integers(2, 10**6),
    },
)


@given(OVERRIDES)
@settings(deadline=None, max_examples=200)
def test_any_scene_survives_writing_bit_by_bit(tmp_path_factory, overrides):
    try:
        scene = load("couplet", overrides)
    except SceneError as error:
        assert "finite" in str(error) or "out of range" in str(error)
        return
    again = written(scene, tmp_path_factory.mktemp("scene"))
    assert again == scene
    assert floats(again) == floats(scene)
    assert again.resolved() == scene.resolved()

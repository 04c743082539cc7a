"""A scene is changed by settings into another one, by the rules of the command line."""

import re

import numpy as np
import pytest

import masonry
from masonry.errors import SceneError

SETTINGS = [
    {"law": "linear", "confinement": "0.1 MPa"},
    {"law": "polynomial", "confinement": "1.0 MPa"},
    {"kinematics": "affine", "contact.unit_unit.cohesion": "0.6 MPa"},
    {"drive.rate": "0.1 mm/s"},
    {"drive": {"on": "top", "direction": "x", "displacement": "2 mm", "steps": 500}},
    {"contact.unit_unit.residual_friction_angle": "30 deg", "specimen.divisions": [2, 1, 1]},
    {"support.1.fix": ["y"], "solver.rows": 50},
]


@pytest.mark.parametrize("settings", SETTINGS, ids=[", ".join(s) for s in SETTINGS])
def test_a_changed_scene_is_the_one_that_is_loaded_with_the_same_settings(settings):
    scene = masonry.load("couplet")
    assert scene.with_(settings) == masonry.load("couplet", settings)
    assert scene == masonry.load("couplet")


@pytest.mark.parametrize("name", masonry.scenes())
def test_every_packaged_scene_stays_itself_where_nothing_is_changed(name):
    scene = masonry.load(name)
    assert scene.with_() == scene
    assert scene.with_({"solver.frames": 77}) == masonry.load(name, {"solver.frames": 77})


def test_one_change_after_another_is_as_good_as_both_at_once():
    scene = masonry.load("wallette-mode-1")
    both = scene.with_({"specimen.cells.total": 218, "specimen.cells.seed": 3})
    assert scene.with_({"specimen.cells.total": 218}).with_({"specimen.cells.seed": 3}) == both


def test_keys_at_the_top_may_stand_by_themselves():
    scene = masonry.load("couplet")
    assert scene.with_(law="linear") == scene.with_({"law": "linear"})
    assert scene.with_({"drive.accuracy": "2 %"}, law="linear").drive.accuracy == 0.02
    with pytest.raises(SceneError, match="law is given twice"):
        scene.with_({"law": "linear"}, law="brittle")


def test_numbers_of_numpy_are_numbers():
    scene = masonry.load("wallette-mode-1")
    (seed,), (damping,) = np.arange(3, 4), np.linspace(0.5, 0.6, 1)
    found = scene.with_({"specimen.cells.total": 218, "specimen.cells.seed": seed, "solver.damping": damping})
    assert (found.specimen.cells.seed, found.solver.damping) == (3, 0.5)
    assert type(found.specimen.cells.seed) is int and type(found.solver.damping) is float


@pytest.mark.parametrize(
    ("settings", "says"),
    [
        ({"law": "liner"}, "did you mean 'linear'"),
        ({"drive.rat": "1 mm/s"}, "did you mean 'rate'"),
        ({"confinement": "1 mm"}, "confinement is a stress"),
        ({"confinement": 1e5}, "has no unit"),
        ({"support.7.fix": "all"}, "no item '7' in support; items are 0, 1"),
        ({"a..b": 1}, "not a dotted key"),
    ],
)
def test_what_does_not_fit_is_refused_by_its_key_without_words_of_the_command_line(settings, says):
    (key,) = settings
    for change in (masonry.load("couplet").with_, lambda given: masonry.load("couplet", given)):
        with pytest.raises(SceneError, match=f"^{re.escape(key)}: (?!{re.escape(key)})") as refused:
            change(settings)
        assert says in str(refused.value) and "--set" not in str(refused.value)


def test_what_is_missing_after_a_change_is_said_of_the_scene_and_not_of_a_line_that_nobody_wrote():
    with pytest.raises(SceneError) as refused:
        masonry.load("couplet").with_({"traction": []})
    assert str(refused.value).startswith("couplet") and "settle" in str(refused.value)
    assert ", line" not in str(refused.value)


def test_a_scene_shows_itself_on_less_than_a_screen_and_nothing_of_it_is_taken_for_html():
    scene = masonry.load("couplet").with_({"title": "<script>a & b</script>", "name": "mine"})
    text = repr(scene)
    assert text == str(scene) and len(text.splitlines()) <= 24 and max(map(len, text.splitlines())) <= 120
    for words in ("mine", "length 200 mm", "young_modulus 16.7 GPa", "law exponential", "cohesion 870 kPa"):
        assert words in text
    html = scene._repr_html_()
    assert "<script>" not in html and "&lt;script&gt;a &amp; b" in html and "length 200 mm" in html


@pytest.mark.parametrize("name", masonry.scenes())
def test_every_packaged_scene_shows_itself(name):
    scene = masonry.load(name)
    assert name in repr(scene) and len(repr(scene).splitlines()) <= 24


def test_the_names_of_packaged_scenes_come_with_their_titles():
    assert masonry.scenes()["couplet"] == "Couplet under confinement and shear"


def test_a_check_prints_as_the_command_does_and_is_a_dictionary(capsys):
    from masonry.cli.main import main

    report = masonry.check(masonry.load("couplet"))
    assert report["blocks"] == 2 and dict(report)["contact_points"] == 4
    assert main(["check", "couplet"]) == 0
    assert capsys.readouterr().out == f"{report!r}\n"
    assert "<td" in report._repr_html_() and "&lt;" not in report._repr_html_()


def test_a_name_or_a_path_is_as_good_as_a_scene(tmp_path):
    path = tmp_path / "short.toml"
    path.write_text('base = "couplet"\n[drive]\nsteps = 50\n[settle]\nsteps = 50\n', encoding="utf-8")
    whole = masonry.run(masonry.load(path)).summary["peak_stress_pa"]
    assert masonry.run(path).summary["peak_stress_pa"] == masonry.run(str(path)).summary["peak_stress_pa"] == whole
    assert masonry.check("couplet") == masonry.check(masonry.load("couplet"))
    with pytest.raises(SceneError, match="did you mean 'couplet'"):
        masonry.run("cuplet")

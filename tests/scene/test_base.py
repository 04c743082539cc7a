"""`base`: a scene that says only in what it differs from another."""

import tomllib

import pytest

from masonry.errors import SceneError
from masonry.scene import changed, load, to_toml


def scene(folder, text, name="own.toml"):
    file = folder / name
    file.write_text(text, encoding="utf-8")
    return load(file)


def refusal(folder, text):
    with pytest.raises(SceneError) as error:
        scene(folder, text)
    return str(error.value).replace(str(folder), "here")


def test_a_scene_on_a_base_has_all_its_values_but_those_it_changes(tmp_path):
    own = scene(tmp_path, 'base = "couplet"\n[contact.unit_unit]\ncohesion = "0.6 MPa"\n')
    below = load("couplet")
    assert own.name == "own"
    assert own.contact["unit_unit"].cohesion == 0.6e6
    assert own.contact["unit_unit"].model_copy(update={"cohesion": 0.87e6}) == below.contact["unit_unit"]
    assert own.model_copy(update={"name": "couplet", "contact": below.contact}) == below


def test_a_list_takes_the_place_of_the_whole_list_below_and_of_what_was_assumed_of_it(tmp_path):
    own = scene(tmp_path, 'base = "couplet"\n[[support]]\non = "bottom"\nfix = "all"\n')
    assert len(own.support) == 1
    assert "support.1.fix" in load("couplet").assumptions
    assert "support.1.fix" not in own.assumptions


def test_a_key_takes_the_place_of_its_rival_below(tmp_path):
    own = scene(tmp_path, 'base = "couplet"\n[drive]\nrate = "1 mm/s"\n')
    assert (own.drive.accuracy, own.drive.rate) == (None, 1e-3)
    assert "drive.accuracy" in load("couplet").assumptions
    assert "drive.accuracy" not in own.assumptions


def test_a_specimen_of_another_kind_takes_the_place_of_the_whole_specimen_and_of_what_was_assumed_of_it(tmp_path):
    below = 'base = "couplet"\n[specimen]\nmesh_size = "10 mm"\n[assumptions]\n"specimen.length" = "guessed"\n'
    (tmp_path / "below.toml").write_text(below, encoding="utf-8")
    prism = '[specimen]\nkind = "prism"\nunits = 3\nlength = "0.3 m"\nwidth = "0.1 m"\nheight = "0.1 m"\n'
    own = scene(tmp_path, f'base = "below.toml"\n{prism}')
    assert (own.specimen.kind, own.specimen.mesh_size) == ("prism", None)
    assert "specimen.length" not in own.assumptions
    same = scene(tmp_path, 'base = "below.toml"\n[specimen]\nkind = "couplet"\nlength = "0.3 m"\n')
    assert (same.specimen.length, same.specimen.mesh_size) == (0.3, 0.01)


def test_an_assumption_about_a_changed_key_goes_unless_it_is_made_anew(tmp_path):
    text = 'base = "couplet"\n[contact.unit_unit]\ntensile_strength = "0.5 MPa"\n'
    key = "contact.unit_unit.tensile_strength"
    assert key not in scene(tmp_path, text).assumptions
    assert scene(tmp_path, f'{text}[assumptions]\n"{key}" = "guessed"\n').assumptions[key] == "guessed"


AXLES = {"vehicle.axles": ["50 kN", "50 kN"], "vehicle.spacings": ["1.5 m"]}
MADE_UP = load("bridge-single-span").assumptions["vehicle"]
TWO_AXLES = 'base = "bridge-single-span"\n[vehicle]\naxles = ["50 kN", "50 kN"]\nspacings = ["1.5 m"]\n'


def test_an_assumption_about_a_table_names_the_keys_of_it_that_were_changed(tmp_path):
    bridge = load("bridge-single-span")
    scenes = [
        scene(tmp_path, TWO_AXLES),
        load("bridge-single-span", AXLES),
        load("bridge-single-span", ['vehicle.axles=["50 kN", "50 kN"]', 'vehicle.spacings=["1.5 m"]']),
        bridge.with_(AXLES),
        bridge.with_(AXLES).with_(AXLES),
    ]
    for own in scenes:
        assert own.assumptions["vehicle"] == f"{MADE_UP} (before a change of axles, spacings)"
        assert own.assumptions["specimen"] == bridge.assumptions["specimen"]
    (tmp_path / "two.toml").write_text(TWO_AXLES)
    third = scene(tmp_path, 'base = "two.toml"\nvehicle.patch = "0.2 m"\n', "third.toml")
    assert third.assumptions["vehicle"] == f"{MADE_UP} (before a change of axles, spacings, patch)"
    mine = scene(tmp_path, f'{TWO_AXLES}[assumptions]\nvehicle = "a lorry"\n')
    assert mine.assumptions["vehicle"] == "a lorry"
    replaced = load("bridge-single-span", {"vehicle": {"on": "voussoirs", "level": "1.8 m", "axles": ["1 kN"]}})
    assert replaced.assumptions["vehicle"].endswith("by the user")


def test_a_record_in_place_of_a_made_motion_is_said_beside_what_was_assumed_of_it(tmp_path):
    (tmp_path / "own.txt").write_text("".join(f"{0.1 * n:.1f} {n % 3}\n" for n in range(40)))
    own = scene(tmp_path, 'base = "wall-out-of-plane-shaken"\n[ground]\nrecord = "own.txt"\nunit = "m/s^2"\n')
    assert own.ground[0].made is None
    assert own.assumptions["ground"].endswith("(before a change of record, unit)")


def test_a_list_that_is_set_for_one_run_takes_what_was_assumed_of_its_items_with_it():
    own = load("couplet", ['support=[{on = "bottom", fix = "all"}]'])
    assert "support.1.fix" not in own.assumptions


def test_the_resolved_scene_is_whole_and_names_no_base(tmp_path):
    own = scene(tmp_path, 'base = "couplet"\nconfinement = "1 MPa"\n')
    assert "base" not in to_toml(own)
    assert scene(tmp_path, to_toml(own), "resolved.toml") == own
    assert own.traction[0].stress.z == -1e6


def test_bases_may_stand_on_each_other_and_beside_each_other_in_a_folder(tmp_path):
    (tmp_path / "one.toml").write_text('base = "couplet"\nname = "one"\ntitle = "One"\nlaw = "linear"\n')
    two = scene(tmp_path, 'base = "one.toml"\nconfinement = "0.1 MPa"\n', "two.toml")
    assert (two.name, two.title, two.law, two.confinement) == ("two", "One", "linear", 1e5)


def test_cells_that_are_set_for_one_run_take_the_place_of_a_grid_and_what_was_assumed_of_it():
    own = load("wallette-mode-1", ["specimen.cells.total=218"])
    assert own.specimen.divisions == (1, 1)
    assert own.specimen.cells.total == 218
    assert "specimen.divisions" not in own.assumptions
    other = load("wallette-mode-1-218", ["specimen.cells.per_unit=20"])
    assert (other.specimen.cells.total, other.specimen.cells.per_unit) == (None, 20)


TIMED = """base = "wallette-mode-1"
[drive]
steps = 100
history = "0.1 mm * t / 1 s"
duration = "4 s"
[settle]
steps = 10
[[traction]]
on = "left"
stress = { x = "1 kPa" }
history = "t / 1 s"
duration = "4 s"
[assumptions]
"drive.duration" = "guessed"
"""
LISTS = [
    ("drive", "displacement", '"1 mm"'),
    ("drive", "history", '["20 um", "-8 um"]'),
    ("drive", "history", '[["0 s", "0 mm"], ["1 s", "2 mm"]]'),
    ("traction.0", "history", '[["0 s", 0], ["1 s", 1]]'),
]


@pytest.mark.parametrize(("table", "key", "value"), LISTS)
def test_a_duration_goes_with_the_expression_that_it_belonged_to(tmp_path, table, key, value):
    before = scene(tmp_path, TIMED, "timed.toml")
    ways = [
        load(tmp_path / "timed.toml", [f"{table}.{key}={value}"]),
        changed(before, {f"{table}.{key}": tomllib.loads(f"v = {value}")["v"]}),
    ]
    if table == "drive":
        ways.append(scene(tmp_path, f'base = "timed.toml"\n[drive]\n{key} = {value}\n'))
    for found in ways:
        part = found.drive if table == "drive" else found.traction[0]
        assert part.duration is None and getattr(part, key) not in (None, getattr(before.drive, key))
        assert ("drive.duration" in found.assumptions) == (table != "drive")


def test_a_duration_that_is_given_with_a_list_is_refused_and_one_with_an_expression_stays(tmp_path):
    scene(tmp_path, TIMED, "timed.toml")
    with pytest.raises(SceneError, match="--set drive.duration: .*leave it out"):
        load(tmp_path / "timed.toml", ["drive.displacement=1 mm", "drive.duration=2 s"])
    assert load(tmp_path / "timed.toml", ["drive.history=2 mm * t / 1 s"]).drive.duration == 4.0


def test_a_file_that_lacks_only_its_ending_is_the_nearest(tmp_path, monkeypatch):
    (tmp_path / "wcyc.toml").write_text('base = "wallette-cyclic"\n')
    with pytest.raises(SceneError, match="did you mean 'wcyc.toml'"):
        scene(tmp_path, 'base = "wcyc"\n')
    monkeypatch.chdir(tmp_path)
    with pytest.raises(SceneError, match="did you mean 'wcyc.toml'"):
        load("wcyc")
    with pytest.raises(SceneError, match="did you mean 'wallette-cyclic'"):
        load("walette-cyclic")


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (
            'base = "cuplet"',
            "here/own.toml, line 1: base: no scene 'here/cuplet': no such file; did you mean 'couplet'",
        ),
        ("base = 5", "here/own.toml, line 1: base: must be the name of a packaged scene or a file, not 5"),
        ('base = "own.toml"', "own.toml is this scene, or is based on it"),
        (
            'base = "couplet"\n[drive]\nstpes = 5',
            "here/own.toml, line 3: drive.stpes: unknown key; did you mean 'steps'",
        ),
        (
            'base = "couplet"\n[specimen]\nkind = "boxes"',
            "here/own.toml, line 2: specimen.section: missing",
        ),
    ],
)
def test_what_is_wrong_is_told_where_it_stands(tmp_path, text, words):
    assert words in refusal(tmp_path, text)


def test_what_is_wrong_in_the_scene_below_is_told_where_it_stands_there(tmp_path):
    (tmp_path / "below.toml").write_text('base = "couplet"\n[specimen]\nlength = "5 K"\n', encoding="utf-8")
    assert "here/below.toml, line 3: specimen.length" in refusal(tmp_path, 'base = "below.toml"')

"""What a user may get wrong about a contact: one message with what is allowed or the nearest word, and exit code 2."""

import pytest

import masonry
from masonry.cli.main import main
from masonry.errors import SceneError

HEIGHTS = {"unit_height": "65 mm", "joint": "10 mm"}
CODE = {"unit": "clay", "unit_strength": "20 MPa", "mortar": "M5", **HEIGHTS}
MODULI = {"unit_modulus": "16.7 GPa", "mortar_modulus": "2.9 GPa", **HEIGHTS}


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"mortar_modulus": "2.9 MPa"}, r"mortar_modulus = 2.9 MPa: looks wrong.*did you mean '2.9 GPa'"),
        ({"unit_modulus": "16700 GPa"}, r"looks wrong.*did you mean '16.7 GPa'"),
        ({"unit_modulus": "16700"}, "has no unit"),
        ({"unit_modulus": 16.7e9}, "has no unit"),
        ({"unit_modulus": "-3 GPa"}, "is negative"),
        ({"unit_modulus": "0 GPa"}, "looks wrong"),
        ({"unit_modulus": "3 kN"}, "kN is a force"),
        ({"unit_modulus": "3 gpa"}, "did you mean 'GPa'"),
        ({"unit_modulus": "3,5 GPa"}, "decimal point"),
        ({"unit_modulus": "nan GPa"}, "not a number and a unit"),
        ({"unit_height": "65 m"}, r"looks wrong.*did you mean '65 mm'"),
        ({"joint": "10 m"}, r"looks wrong.*did you mean '10 mm'"),
        ({"joint": "50 mm", "unit_height": "10 mm"}, "exchanged"),
        ({"cohesion": "300 MPa"}, r"looks wrong.*did you mean '0.3 MPa'"),
        ({"cohesion": "0.3 kPa", "friction": 31.0}, r"friction = 31: looks wrong.*'31 deg'"),
        ({"cohesion": "0.3 MPa", "friction": "95 deg"}, "below 89 deg"),
        ({"cohesion": "0.3 MPa", "friction": -0.2}, "is negative"),
        ({"cohesion": "0.3 MPa", "friction": "steep"}, "give a tangent such as 0.6"),
        ({"cohesion": "0.3 MPa", "friction": 0.6, "residual_friction": 0.8}, "never grows on sliding"),
        ({"cohesion": "0.3 MPa", "triplets": [("0.2 MPa", "0.4 MPa")] * 3}, "give one of the two"),
        ({"triplets": [("0.2 MPa", "0.4 MPa")] * 3}, "at 1 pressures"),
        ({"triplets": [("0.2 MPa", "0.4 MPa")]}, "EN 1052-3 asks for"),
        ({"triplets": [(0.2, 0.4), (0.6, 0.7), (1.0, 1.0)], "law": "bilinear"}, "did you mean 'linear'"),
        ({"triplets": [("0.4 MPa", "0.2 MPa"), ("0.7 MPa", "0.6 MPa"), ("1 MPa", "1 MPa")]}, "in this order"),
        ({"triplets": [("1 MPa", "0.2 MPa"), ("0.6 MPa", "0.7 MPa"), ("0.2 MPa", "1 MPa")]}, "neither may be negative"),
        ({"triplets": 3}, "give pairs"),
        ({"triplets": []}, "give pairs"),
        ({"triplets": [None, None]}, "give pairs"),
        ({"triplets": [(None, "0.2 MPa")] * 3}, "no pair of stresses"),
        ({"triplets": "nowhere.csv"}, "does not exist"),
        ({"bond_strength": "0.3 MPa", "tensile_strength": "0.3 MPa", "cohesion": "0.3 MPa"}, "give one of the two"),
        ({}, "cohesion: missing"),
        ({"unit": "brick"}, "known here: aac"),
        ({"unit": "cley"}, "did you mean 'clay'"),
        ({"unit": "clay", "group": 5}, "from 1 to 4"),
        ({"unit": "clay", "mortar": "M0.5"}, "table 3.4 begins at M1"),
        ({"mortar": "thin-layr"}, "did you mean 'thin-layer'"),
        ({"mortar": "5"}, "has no unit"),
        ({"mortar": 5}, "give a class such as M5"),
        ({"mortar": "M5000"}, "looks wrong"),
        ({"mortar": "none"}, "has no thickness"),
        ({"mortar": "none", "joint": None}, "friction: missing"),
        ({"mortar": "none", "joint": None, "law": "linear", "friction": 0.6}, "friction alone"),
        ({"law": "polynomial"}, "known here"),
        ({"kinematics": "afine"}, "did you mean 'affine'"),
        ({"divisions": 0}, "from 1 to 1000"),
        ({"divisions": "many"}, "from 1 to 1000"),
        ({"contact": "unit unit"}, "name of a contact group"),
        ({"contact": 'a"]\n[x'}, "name of a contact group"),
        ({"basis": "mena"}, "did you mean 'mean'"),
        ({"crushing": "cap", "cohesion": "0.3 MPa"}, "needs the strength of masonry"),
        ({"crushing": "cap", "cohesion": "0.3 MPa", "masonry_strength": "60 MPa"}, "closing_at_peak: missing"),
        ({"crushing": "cap", "law": "elastic"}, "law elastic has no strength"),
        ({"poisson": 0.6}, "looks wrong"),
        ({"mortar_stiffness": "3 GPa"}, "did you mean"),
        ({"unit_height": None}, "unit_height: missing"),
        ({"joint": None}, "joint: missing"),
        ({"mortar_modulus": None}, "mortar_modulus: missing beside unit_modulus"),
        ({"unit_modulus": None}, "unit_modulus: missing beside mortar_modulus"),
        ({"unit_modulus": None, "mortar_modulus": None}, "no modulus is known"),
        ({"unit_modulus": None, "masonry_modulus": "9 GPa", "kinematics": "affine"}, "kinematics affine needs it"),
        ({"unit_modulus": None, "masonry_modulus": "9 GPa", "divisions": 3}, "divisions 3 needs it"),
        (
            {
                "unit_modulus": None,
                "mortar_modulus": None,
                "unit": "aac",
                "group": 3,
                "unit_strength": "4 MPa",
                "mortar": "M5",
            },
            "no f_k for aac of group 3",
        ),
    ],
)
def test_wrong_data_are_one_sentence(change, message, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(SceneError, match=message):
        masonry.contact(**{**MODULI, **change})


@pytest.mark.parametrize(
    ("scene", "change", "message"),
    [
        ("couplet", {"unit_height": "65 mm"}, "make courses of 75 mm; those of scene 'couplet' are 50 mm high"),
        ("couplet", {"kinematics": "affine"}, "scene 'couplet' has rigid"),
        ("couplet", {"divisions": 2}, "scene 'couplet' has 1"),
        ("bending-0", {}, "are cells"),
        ("couplet-meso-coarse", {}, "mortar is made of blocks"),
        ("arch", {"unit_height": None}, "scene 'arch' has no courses"),
    ],
)
def test_what_does_not_fit_the_scene_is_said(scene, change, message):
    data = {**CODE, "unit_height": None}
    with pytest.raises(SceneError, match=message):
        masonry.contact(scene, **{**data, **change})


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "is empty"),
        ("pressure,strength\n", "no tests"),
        ("0.2,0.4\n0.6,abc\n", "line 2"),
        ("0.2,0.4,7\n", "line 1"),
        ("200000,400000\n", "look wrong"),
        ("0.2,-0.4\n", "look wrong"),
        ("0.2,nan\n", "look wrong"),
        ("No;p [kPa];tau [kPa]\n1;200;400\n", "line 2: 3 columns in place of two"),
        ("A1;0,2;0,4\n", "line 1: 3 columns in place of two"),
        ("0,2 0,4\n", "line 1: 4 columns in place of two"),
        ("pressure [kN];strength [kPa]\n200;400\n", "line 1: 'kN' is no unit of a stress"),
        ("pressure (mm), strength (mm)\n200,400\n", "'mm' is no unit of a stress"),
        ("0.2 [MPa], 0.41 [MPa]\n", "line 1: 4 columns"),
        ("p [mPa], tau [mPa]\n200,400\n", "did you mean 'MPa'"),
        ("p [Mpa], tau [Mpa]\n0.2,0.4\n", "did you mean 'MPa'"),
        ("pressure, strength [kPa]\n200,400\n", "1 units for two columns"),
        ("p [], tau []\n200,400\n", "'' is no unit of a stress"),
        ("20;36\n60;64\n100;92\n", "look wrong; .* names other units"),
        ("20;36\n30;43\n40;50\n", "cohesion of 22 MPa, which looks wrong"),
    ],
)
def test_a_file_of_tests_that_is_wrong_is_one_sentence(text, message, tmp_path):
    (tmp_path / "tests.csv").write_text(text)
    with pytest.raises(SceneError, match=message):
        masonry.contact(triplets=str(tmp_path / "tests.csv"), **MODULI)


@pytest.mark.parametrize(
    "text", ["p,tau\n0.2,0.4\n0.6,0.7\n1,1\n", "# MPa\n0,2;0,4\n0,6;0,7\n1;1\n", "0.2 0.4\n\n0.6 0.7\n1 1"]
)
def test_files_of_tests_have_commas_semicolons_or_spaces(text, tmp_path):
    (tmp_path / "tests.csv").write_text(text)
    table = masonry.contact(triplets=tmp_path / "tests.csv", **MODULI)
    assert table["contact.unit_unit"]["cohesion"] == "0.25 MPa"


@pytest.mark.parametrize(
    ("heading", "pressure", "strength"),
    [
        ("pressure [kPa];shear strength [kPa]", 1e3, 1e3),
        ("pressure (N/cm2), shear strength (MPa)", 100.0, 1.0),
        ("p [N/mm²]\ttau [kN/m^2]", 1.0, 1e3),
        ("sigma in kPa; tau_kPa", 1e3, 1e3),
        ("pressure of 3 levels [kPa]; shear strength [kPa]", 1e3, 1e3),
        ("pressure;shear strength\nkPa;kPa", 1e3, 1e3),
        ("p (normal) [psi], tau (peak) [psi]", 1e6 / 6894.757293168361, 1e6 / 6894.757293168361),
    ],
)
def test_the_heading_of_a_file_of_tests_names_the_units_of_its_columns(heading, pressure, strength, tmp_path):
    tests = [(p, 0.24 + 0.7 * p) for p in (0.2, 0.6, 1.0) for _ in range(3)]
    lines = [f"{p * pressure!r} {tau * strength!r}" for p, tau in tests]
    (tmp_path / "tests.csv").write_text("\n".join([heading, *lines]), encoding="utf-8")
    table = masonry.contact(triplets=tmp_path / "tests.csv", **MODULI)
    joint = table["contact.unit_unit"]
    assert joint["cohesion"] == "0.24 MPa" and joint["tan_friction_angle"] == pytest.approx(0.7)
    assert not any("triplets" in note or "cohesion" in note for note in table.notes)


def test_units_that_are_not_named_few_tests_and_a_high_cohesion_are_noted(tmp_path):
    (tmp_path / "tests.csv").write_text("p,tau\n0.2,3.2\n0.6,3.4\n1,3.6\n")
    table = masonry.contact(triplets=tmp_path / "tests.csv", **MODULI)
    notes = "\n".join(table.notes)
    assert (
        "names no units, and MPa are taken" in notes
        and "3 tests at 3 pressures" in notes
        and "3.1 MPa is high" in notes
    )
    pairs = [(p, 0.24e6 + 0.7 * p) for p in (0.2e6, 0.6e6) for _ in range(5)]
    assert any("10 tests at 2 pressures" in note for note in masonry.contact(triplets=pairs, **MODULI).notes)


def words(data):
    return [word for key, value in data.items() for word in (f"--{key.replace('_', '-')}", value)]


def test_the_command_prints_a_table_and_writes_a_scene(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["contact", *words(CODE)]) == 0
    assert capsys.readouterr().out == f"{masonry.contact(**CODE)}\n"
    data = [*words({key: value for key, value in CODE.items() if key != "unit_height"}), "--scene", "couplet"]
    assert main(["contact", *data, "--out", "own.toml"]) == 0
    assert main(["check", "own.toml"]) == 0
    assert masonry.load("own.toml").contact["unit_unit"].cohesion == 0.25e6
    assert main(["contact", *words(CODE), "--out", "table.toml"]) == 0
    capsys.readouterr()
    assert main(["contact", *data, "--out", "own.toml"]) == 2
    assert "exists already" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ([], "say what is known"),
        (["--mortar-modulus", "2.9 MPa"], "--mortar-modulus = 2.9 MPa: looks wrong"),
        (["--mortr", "M5"], "did you mean '--mortar'"),
        (["--unit", "clay"], "--unit-height: missing"),
        ([*words(CODE), "--out", "own.csv"], "is a .toml file"),
        ([*words(CODE), "--out", "nowhere/own.toml"], "cannot write"),
        ([*words(CODE), "--scene", "cuplet"], "did you mean 'couplet'"),
    ],
)
def test_wrong_words_of_the_command_end_with_exit_code_2(arguments, message, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    try:
        assert main(["contact", *arguments]) == 2
    except SystemExit as error:
        assert error.code == 2
    shown = capsys.readouterr()
    assert message in shown.err and shown.err.count("\n") == 1 and shown.out == ""
    assert list(tmp_path.iterdir()) == []
